"""Variables of a MATLAB 7.3 file, an HDF5 file: numbers, structs, and the signals that Simulink wrote as it ran."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.formats.hdf5.reader import Array, Hdf5, read_hdf5
from motor_identification.logs.formats.mat_elements import MOST_NUMBERS, Cells, TooLargeError, Value, is_vector

MARK = b"MATLAB 7.3"
_NUMERIC = {
    "double": "f8", "single": "f4", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4",
    "uint32": "u4", "int64": "i8", "uint64": "u8", "logical": "u1", "boolean": "u1",
}  # fmt: skip
_CLASS, _EMPTY, _OBJECT = "MATLAB_class", "MATLAB_empty", "MATLAB_object_decode"
_REFERENCES, _STREAMS = "#refs#", "#sigstream#"
MOST_MEMBERS = 64  # of an array of structs: a longer one is no recording's signals


def read_variables_7_3(data: bytes) -> dict[str, Value]:
    """Read matrices of shape (rows, columns) by name, structs as dictionaries of such; "" stands for objects.

    Raises:
        BrokenFileError: an address, a size or a type cannot be.
        TooLargeError: it is unpacked more than 512 MiB, or has too many objects or numbers.
    """
    file = read_hdf5(data)
    found: dict[str, Value] = {"": {}} if any(map(_is_object, _list_own(file).values())) else {}
    numbers = 0
    for path, value in (*_list_matrices(file), *_list_members(file), *_list_cells(file)):
        values = value.values() if isinstance(value, Cells) else [value]
        numbers += sum(one.size for one in values if isinstance(one, np.ndarray))
        if numbers > MOST_NUMBERS:
            raise TooLargeError(f"more than {MOST_NUMBERS // 10**6} million numbers")
        _put(found, path, value)
    signals = dict(_streamed(file))
    if signals:
        found.pop("", None)
    return {**found, **{name: signal for name, signal in signals.items() if name not in found}}


def _list_own(file: Hdf5) -> dict[str, Array]:
    """List the arrays by path that are variables or parts of such."""
    return {path: array for path, array in file.arrays.items() if not path.startswith("#")}


def _is_object(array: Array) -> bool:
    return _OBJECT in array.attributes


def _list_matrices(file: Hdf5) -> Iterator[tuple[tuple[str, ...], Value]]:
    """List the matrices of numbers by their path of structs."""
    for path, array in _list_own(file).items():
        value = None if _is_object(array) else _numbers(array)
        if value is not None:
            yield tuple(path.split("/")), value


def _list_members(file: Hdf5) -> Iterator[tuple[tuple[str, ...], Value]]:
    """List the matrices and texts in arrays of structs, numbered: their fields are arrays of references.

    An array of cells has references, too, and says that it is one.
    """
    for path, array in _list_own(file).items():
        *place, field = path.split("/")
        if not array.references or _CLASS in array.attributes or not place:
            continue
        for number, value in _list_references(file, array):
            yield (*place, number, field), value


def _list_cells(file: Hdf5) -> Iterator[tuple[tuple[str, ...], Value]]:
    """List the arrays of several cells that hold matrices of numbers."""
    for path, array in _list_own(file).items():
        if not array.references or array.attributes.get(_CLASS) != "cell":
            continue
        cells = Cells(_list_references(file, array))
        if any(isinstance(value, np.ndarray) for value in cells.values()):
            yield tuple(path.split("/")), cells["1"] if array.values.size == 1 else cells


def _list_references(file: Hdf5, array: Array) -> Iterator[tuple[str, Value]]:
    """List the matrices and texts that an array has references to, by 1, 2, …."""
    for number, address in enumerate(array.values.ravel()[:MOST_MEMBERS], 1):
        target = file.arrays.get(file.paths.get(int(address), ""))
        value = None if target is None else _numbers(target)
        if value is not None:
            yield str(number), value
        elif _text(target):
            yield str(number), _text(target)


def _put(found: dict[str, Value], path: tuple[str, ...], value: Value) -> None:
    """Put a value where its path of structs says."""
    name, *rest = path
    if not rest:
        found[name] = value
        return
    inner = found.setdefault(name, {})
    if isinstance(inner, dict):
        _put(inner, tuple(rest), value)


def _numbers(array: Array) -> NDArray[np.float64] | None:
    """A matrix of shape (rows, columns); None where it is empty, or no matrix of numbers."""
    if array.references or array.attributes.get(_CLASS) not in _NUMERIC or _EMPTY in array.attributes:
        return None
    if array.values.dtype.kind not in "iuf":
        return None
    if array.values.ndim > 2 and is_vector(array.values.shape):
        return np.asarray(array.values.reshape(-1, 1), dtype=np.float64)
    return np.asarray(array.values.T, dtype=np.float64) if array.values.ndim == 2 else None


def _streamed(file: Hdf5) -> Iterator[tuple[str, NDArray[np.float64]]]:
    """The signals of a Simulink data set that was logged to a file, and `time`, of those with one clock.

    Each has a struct with its clock as first, step and number, and the number of its record among the streams.
    """
    clock: tuple[float, ...] | None = None
    suffix = "/Values/CompressedTime"
    for path in [path[: -len(suffix)] for path in file.arrays if path.endswith(suffix)]:
        times = file.arrays[path + suffix].values.ravel()
        record = file.arrays.get(f"{path}/Values/DataR2")
        if len(times) != 3 or record is None or record.values.size != 1 or record.values.dtype.kind != "f":
            continue
        stream = file.arrays.get(f"{_STREAMS}/{int(record.values.ravel()[0])}/#data#")
        kind = _NUMERIC.get(_text(file.arrays.get(f"{path}/Values/SignalAttributes/ClassName")), "")
        first, step, count = (float(one) for one in times)
        if stream is None or stream.values.dtype != np.uint8 or not kind or not 2 <= count <= MOST_NUMBERS:
            continue
        raw = stream.values.tobytes()
        width = np.dtype(kind).itemsize
        if step <= 0.0 or len(raw) != int(count) * width or (clock is not None and clock != (first, step, count)):
            continue
        if clock is None:
            clock = (first, step, count)
            yield "time", np.asarray(first + step * np.arange(int(count)), dtype=np.float64)[:, None]
        with np.errstate(invalid="ignore"):  # values that are no numbers are told of later
            values = np.frombuffer(raw, f"<{kind}").astype(np.float64)
        yield _signal_name(file, path), values[:, None]


def _signal_name(file: Hdf5, path: str) -> str:
    """What the signal is called: by its own name, that of what it comes from, or that of its block and port."""
    for name in ("Name", "PropagatedName", "Values/Name"):
        text = _text(file.arrays.get(f"{path}/{name}"))
        if text:
            return text
    block = file.arrays.get(f"{path}/BlockPath")
    place = file.paths.get(int(block.values.ravel()[0])) if block is not None and block.references else None
    text = _text(file.arrays.get(place)) if place else ""
    own = text.replace("//", "\0").rsplit("/", 1)[-1].replace("\0", "/")  # a block's name may have a slash: rad//s
    return own.replace("\n", " ") or path.rsplit("/", 1)[-1]


def _text(array: Array | None) -> str:
    """A text; empty where it is none."""
    if array is None or array.attributes.get(_CLASS) != "char" or _EMPTY in array.attributes:
        return ""
    return "".join(chr(int(code)) for code in array.values.ravel()[:200] if int(code) < 0xD800).strip()
