"""MATLAB files (version 5 to 7) as a table: vectors of one length, columns of matrices, fields of structs."""

import zlib
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import loadmat, whosmat
from scipy.io.matlab import MatReadError

from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError

LARGEST = 2**27  # numbers in a file: 1 GiB
_BROKEN = (
    MatReadError,
    ValueError,
    TypeError,
    KeyError,
    OSError,
    EOFError,
    NotImplementedError,
    IndexError,
    zlib.error,
)


def read_matlab(path: Path) -> Table:
    """The vectors of the length that most have, by name; a struct's fields as `struct.field`.

    Raises:
        RecordingError: the file is damaged, too large, or has no two vectors of one length.
    """
    try:
        announced = sum(int(np.prod([int(n) for n in shape], dtype=object)) for _, shape, _ in whosmat(str(path)))
        if announced > LARGEST:
            raise RecordingError(f"{path} announces {announced} numbers, and {LARGEST} is the most: cut it into parts.")
        content = loadmat(str(path), squeeze_me=False, struct_as_record=True)
    except MemoryError as error:
        raise RecordingError(f"{path} does not fit the memory: cut it into parts.") from error
    except _BROKEN as error:
        raise RecordingError(f"{path} is a damaged MATLAB file: save it again with -v7.") from error
    vectors: dict[str, Any] = {}
    for name, value in content.items():
        if not name.startswith("__"):
            _collect(name, np.asarray(value), vectors, depth=0)
    lengths = [len(vector) for vector in vectors.values() if len(vector) >= 2]
    if not lengths:
        raise RecordingError(f"{path} has no vectors of numbers: save time, voltage and motion as vectors.")
    length = max(set(lengths), key=lambda n: (lengths.count(n), n))
    fitting = {name: vector for name, vector in vectors.items() if len(vector) == length}
    if len(fitting) < 2:
        raise RecordingError(f"{path} has no two vectors of one length: save time, voltage and motion with one.")
    others = [name for name, vector in vectors.items() if 2 <= len(vector) != length]
    notes = (f"Left out, as they have other lengths: {', '.join(others[:8])}.",) if others else ()
    return Table(path, np.arange(1, length + 1), fitting, notes=notes)


def _collect(name: str, value: Any, vectors: dict[str, Any], depth: int) -> None:
    """Put the vectors in a value into `vectors`."""
    if value.dtype.names and depth < 4 and value.size == 1:
        for inner in value.dtype.names:
            _collect(f"{name}.{inner}", np.asarray(value.reshape(-1)[0][inner]), vectors, depth + 1)
    elif value.dtype == object and value.size == 1 and depth < 4:
        _collect(name, np.asarray(value.reshape(-1)[0]), vectors, depth + 1)
    elif value.dtype.kind in "fiub" and value.ndim == 2:
        if 1 in value.shape:
            vectors[name] = value.reshape(-1).astype(np.float64)
        elif value.shape[1] <= 64:
            vectors.update({f"{name} {k + 1}": value[:, k].astype(np.float64) for k in range(value.shape[1])})
