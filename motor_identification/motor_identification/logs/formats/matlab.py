"""MATLAB files (version 4 to 7.3), Octave's and NumPy's as a table: vectors of one length, columns of matrices."""

import re
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from motor_identification.logs.columns.clock import runs_forward
from motor_identification.logs.csv.table import Table
from motor_identification.logs.formats.hdf5.reader import SIGNATURE
from motor_identification.logs.formats.mat_7_3 import MARK, read_variables_7_3
from motor_identification.logs.formats.mat_elements import BrokenFileError, Cells, TooLargeError, Value, read_variables
from motor_identification.logs.formats.mat_objects import read_objects, spread_iddata
from motor_identification.logs.formats.mat_version_4 import is_version_4, read_matrices
from motor_identification.logs.formats.numpy_arrays import MARK as NUMPY
from motor_identification.logs.formats.numpy_arrays import is_archive_of_arrays, read_arrays
from motor_identification.logs.formats.octave_text import MARK as OCTAVE
from motor_identification.logs.formats.octave_text import read_octave_text
from motor_identification.logs.rows.row_times import tells_how_often
from motor_identification.logs.rows.several_clocks import choose_columns
from motor_model.errors import RecordingError

OBJECTS = "objects of MATLAB (a timeseries, Simulink's output)"
SAVE_THEM = "save their Time and Data as vectors (t = y.Time; y = y.Data)"
_PORT = re.compile(r"(?:In|Out)\d*")
MOST_COLUMNS = 64  # of a matrix of signals: a wider one is a picture or a model


def read_matlab(path: Path, wanted: Collection[str] = (), fewest: int = 2) -> Table:
    """The vectors of one length by name; a struct's fields as `struct.field`.

    Of several lengths, those that the user said (`wanted`), then what `choose_columns` finds: so many (`fewest`).

    Raises:
        RecordingError: the file is damaged, too large, or has no two vectors of one length.
    """
    read: Callable[[bytes], dict[str, Value]] = read_variables
    try:
        data = path.read_bytes()
        read = _reader(data)
        variables = read(data)
        objects = "" in variables  # what MATLAB keeps of them has no name
        if objects and read is read_variables:
            signals = _read_signals(data)
            objects = not signals
            variables.update({name: one for name, one in signals.items() if name not in variables})
        variables, left_out = spread_iddata(variables)
        vectors = _list_vectors(variables, wanted, fewest)
    except TooLargeError as error:
        raise RecordingError(f"{path} is too large ({error}): cut it into parts.") from error
    except MemoryError as error:
        raise RecordingError(f"{path} does not fit the memory: cut it into parts.") from error
    except BrokenFileError as error:
        kind, cure = _KINDS[read]
        raise RecordingError(f"{path} is a damaged {kind} file ({error}): {cure}.") from error
    if objects and len(vectors) < fewest:
        raise RecordingError(f"{path} holds {OBJECTS}, which only MATLAB reads: {SAVE_THEM}.")
    signals = _list_signals(vectors)
    if not signals:
        raise RecordingError(f"{path} has no vectors of numbers: save time, voltage and motion as vectors.")
    groups = _group_by_length(signals)
    fitting = choose_columns(groups, wanted)
    if len(fitting) < fewest:
        raise RecordingError(
            f"{path} has no two vectors of one length: save time, voltage and motion with one; or, where its only one "
            "is the motion under one voltage, say --constant-voltage V, and --sample-period S from row to row."
        )
    length = len(next(iter(fitting.values())))
    told = {name: vector for name, vector in vectors.items() if len(vector) == 1 and tells_how_often(name)}
    fitting.update({name: np.full(length, vector[0]) for name, vector in told.items() if name not in fitting})
    taken = {length for length, group in groups.items() if not group.keys().isdisjoint(fitting)}
    others = [name for name, vector in signals.items() if name and len(vector) not in taken]
    notes = [f"Left out, as they have other lengths: {', '.join(others[:8])}."] if others else []
    notes += left_out
    notes += [f"Not read: {OBJECTS}; {SAVE_THEM}, if the motion is in them."] if objects else []
    return Table(path, np.arange(1, length + 1), fitting, notes=tuple(notes))


def _list_vectors(variables: Mapping[str, Value], wanted: Collection[str], fewest: int) -> dict[str, Any]:
    """The vectors in variables; those in arrays of cells only where one of them is wanted, or too few are elsewhere."""
    plain: dict[str, Any] = {}
    every: dict[str, Any] = {}
    for name, value in variables.items():
        if name:
            _collect(name, value, plain, in_cells=False)
            _collect(name, value, every, in_cells=True)
    groups = _group_by_length(_list_signals(plain))
    enough = bool(groups) and len(choose_columns(groups, wanted)) >= fewest
    return plain if enough and every.keys() & {*wanted} <= plain.keys() else every


def _list_signals(vectors: Mapping[str, Any]) -> dict[str, Any]:
    return {name: vector for name, vector in vectors.items() if len(vector) >= 2}


def _group_by_length(signals: Mapping[str, Any]) -> dict[int, dict[str, Any]]:
    lengths = {len(vector) for vector in signals.values()}
    return {n: _share_clock({name: one for name, one in signals.items() if len(one) == n}) for n in lengths}


def _read_signals(data: bytes) -> dict[str, Value]:
    """The signals in objects; none where they cannot be read, as of a version that nobody knows."""
    try:
        return read_objects(data)
    except BrokenFileError:
        return {}


_KINDS: dict[Callable[[bytes], dict[str, Value]], tuple[str, str]] = {
    **dict.fromkeys((read_variables, read_variables_7_3, read_matrices), ("MATLAB", "save it again with -v7")),
    read_octave_text: ("Octave", "save it again with -text"),
    read_arrays: ("NumPy", "save its arrays again with numpy.savez"),
}


def _reader(data: bytes) -> Callable[[bytes], dict[str, Value]]:
    """What reads a file of this beginning."""
    if data.startswith(OCTAVE):
        return read_octave_text
    if data.startswith(NUMPY) or is_archive_of_arrays(data):
        return read_arrays
    if data.startswith((MARK, SIGNATURE)):
        return read_variables_7_3
    return read_matrices if is_version_4(data) else read_variables


def _share_clock(vectors: dict[str, Any]) -> dict[str, Any]:
    """Keep the times once where several matrices have the same in their first column, as Simulink's with time do.

    A matrix that has one column beside them keeps its own name.
    """
    first = [name for name in vectors if name.endswith(" 1")]
    if len(first) < 2 or any(not np.array_equal(vectors[name], vectors[first[0]]) for name in first):
        return vectors
    if not runs_forward(vectors[first[0]]):
        return vectors
    rest = {name: vector for name, vector in vectors.items() if not np.array_equal(vector, vectors[first[0]])}
    alone = {f"{name[:-2]} 2" for name in first if f"{name[:-2]} 3" not in rest}
    named = {name[:-2] if name in alone and name[:-2] not in rest else name: vector for name, vector in rest.items()}
    return {"time": vectors[first[0]], **named}


def _find_place(signal: dict[str, Value]) -> str:
    """Find what a signal of a capture is called: its block, `Model Root/Speed Out`, `"Model Root"/"Speed"/"Out1"`."""
    texts = {name: text for name in ("Path", "Name") if isinstance(text := signal.get(name), str)}
    places = {name: name == "Path" or text.lstrip().startswith('"') for name, text in texts.items()}
    parts = [part for name, text in texts.items() for part in (_split_place(text) if places[name] else [text])]
    parts = [part.strip(' "') for part in parts]
    return next((part for part in reversed(parts) if part and not _PORT.fullmatch(part)), "")


def _split_place(text: str) -> list[str]:
    """Split the place of a block; a name in it may have a slash, `Speed [rad//s]`."""
    return [part.replace("\0", "/") for part in text.replace("//", "\0").split("/")]


def _collect(name: str, value: Value, vectors: dict[str, Any], in_cells: bool) -> None:
    """Put the vectors in a value into `vectors`, those in arrays of cells only if they are asked for."""
    if isinstance(value, str) or (isinstance(value, Cells) and not in_cells):
        return
    if isinstance(value, dict):
        label = value.get("label")
        if isinstance(label, str) and label.strip() and isinstance(one := value.get("values"), np.ndarray):
            _collect(
                label.strip() if label.strip() not in vectors else f"{name} {label.strip()}", one, vectors, in_cells
            )
            return
        if (place := _find_place(value)) and isinstance(one := value.get("Data"), np.ndarray):
            name = place if place not in vectors else f"{name} {place}"
            if not any(
                isinstance(other, np.ndarray) and other.size > 1 for other in value.values() if other is not one
            ):
                _collect(name, one, vectors, in_cells)
                return
        for inner, one in value.items():
            _collect(f"{name}.{inner}", one, vectors, in_cells)
    elif 1 in value.shape:
        vectors[name] = value.reshape(-1).astype(np.float64)
    else:
        lying = value.shape[0] < value.shape[1]  # a Simulink file has a row for each signal, the times first
        columns = value.T if lying else value
        if columns.shape[1] <= MOST_COLUMNS:
            vectors.update({f"{name} {k + 1}": columns[:, k].astype(np.float64) for k in range(columns.shape[1])})
