"""Read the arrays of NumPy's files, .npy and .npz: numbers only, of which no more is read than the file has."""

import zipfile
import zlib
from io import BytesIO
from math import prod
from typing import IO, Any

import numpy as np
from numpy.lib import format as npy

from motor_identification.logs.formats.mat_elements import MOST_BYTES, BrokenFileError, TooLargeError, Value

MARK = b"\x93NUMPY"
ALONE = "data"  # the name of an array that has none
MOST_ARRAYS = 1000
FARTHEST = 1e100  # in any unit: the squares of larger numbers are no numbers
_LONGEST_HEAD = 10_000  # bytes
_DAMAGES = (ValueError, OSError, EOFError, zipfile.BadZipFile, zlib.error, NotImplementedError, KeyError, SyntaxError)


def is_archive_of_arrays(data: bytes) -> bool:
    """Whether a ZIP archive holds arrays of NumPy."""
    try:
        with zipfile.ZipFile(BytesIO(data)) as archive:
            names = archive.namelist()
    except _DAMAGES:
        return False
    return bool(names) and all(name.endswith(".npy") for name in names)


def read_arrays(data: bytes) -> dict[str, Value]:
    """Read arrays by name, of shape (rows, columns); objects, texts and arrays of more dimensions are left out.

    Raises:
        BrokenFileError: an array is damaged.
        TooLargeError: they are more than 512 MiB, or more than 1,000.
    """
    found: dict[str, Value] = {}
    try:
        if data.startswith(MARK):
            _add(ALONE, _array(BytesIO(data), len(data)), found)
            return found
        with zipfile.ZipFile(BytesIO(data)) as archive:
            parts = archive.infolist()
            if len(parts) > MOST_ARRAYS or sum(part.file_size for part in parts) > MOST_BYTES:
                raise TooLargeError(f"more than {MOST_BYTES >> 20} MiB or {MOST_ARRAYS} arrays")
            for part in parts:
                with archive.open(part) as stream:
                    _add(part.filename.removesuffix(".npy"), _array(stream, part.file_size), found)
    except _DAMAGES as error:
        raise BrokenFileError("an array cannot be read") from error
    return found


def _array(stream: IO[bytes], size: int) -> Any:
    read_head: Any = npy.read_array_header_2_0
    if npy.read_magic(stream) == (1, 0):  # type: ignore[no-untyped-call]
        read_head = npy.read_array_header_1_0
    shape, by_columns, dtype = read_head(stream, max_header_size=_LONGEST_HEAD)
    count = prod(shape)
    if dtype.hasobject or dtype.itemsize == 0 or count < 0 or count * dtype.itemsize > size:
        raise ValueError("objects, or more than the file has")
    values = np.frombuffer(stream.read(count * dtype.itemsize), dtype, count)
    return values.reshape(shape, order="F" if by_columns else "C")


def _add(name: str, array: Any, found: dict[str, Value]) -> None:
    """Put an array, or the fields of a structured one, among those that were found."""
    for field in array.dtype.names or ():
        _add(field if name == ALONE else f"{name}.{field}", array[field], found)
    if array.dtype.kind in "fiub" and 1 <= array.ndim <= 2:
        values = (array if array.ndim == 2 else array.reshape(-1, 1)).astype(np.float64)
        found[name] = np.where(np.abs(values) < FARTHEST, values, np.nan)
