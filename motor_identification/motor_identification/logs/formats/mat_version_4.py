"""Read the real matrices of a MATLAB 4 file, as Simulink's block To File and Octave's -v4 write it: sizes, no header.

Each variable is five whole numbers (type MOPT, rows, columns, whether complex, length of the name), the name with a
zero behind it, and the numbers column by column, as MathWorks' "MAT-File Format", chapter version 4, says.
"""

from struct import unpack_from
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.formats.mat_elements import MOST_NUMBERS, BrokenFileError, TooLargeError, Value

HEAD = 20  # bytes
MOST_VARIABLES = 1000
LONGEST_NAME = 64  # bytes: MATLAB 4 had 19 letters, what writes such files today has up to 63
TYPES = ("f8", "f4", "i4", "i2", "u2", "u1")


def is_version_4(data: bytes) -> bool:
    """Whether a file's first bytes are a variable of version 4, which has no mark of its own: all of it has to fit."""
    return any(_head(data, 0, order) is not None for order in "<>")


def read_matrices(data: bytes) -> dict[str, Value]:
    """Read matrices of shape (rows, columns) by name; texts, sparse and imaginary parts are left out.

    Raises:
        BrokenFileError: a variable is longer than the file, or none.
        TooLargeError: they hold more than 64 million numbers, or are more than 1,000.
    """
    order = next(order for order in "<>" if _head(data, 0, order) is not None)
    found: dict[str, Value] = {}
    place = numbers = 0
    while place < len(data):
        head = _head(data, place, order)
        if head is None:
            raise BrokenFileError("a variable has no head")
        kind, is_number, rows, columns, imaginary, length = head
        name = data[place + HEAD : place + HEAD + length - 1].decode("latin-1")
        begin = place + HEAD + length
        size = rows * columns
        numbers += size
        if numbers > MOST_NUMBERS or len(found) >= MOST_VARIABLES:
            raise TooLargeError(f"more than {MOST_NUMBERS // 10**6} million numbers or {MOST_VARIABLES} variables")
        dtype = np.dtype(order + TYPES[kind])
        place = begin + size * dtype.itemsize * (2 if imaginary else 1)
        if place > len(data):
            raise BrokenFileError("a variable is longer than the file")
        if is_number and not imaginary:
            matrix: NDArray[Any] = np.frombuffer(data, dtype, size, begin)
            found[name] = matrix.reshape((rows, columns), order="F")
    return found


def _head(data: bytes, place: int, order: str) -> tuple[int, bool, int, int, int, int] | None:
    """Kind of numbers, whether they are (no text), rows, columns, imaginary, length of the name; None if it is none."""
    if len(data) < place + HEAD:
        return None
    mopt, rows, columns, imaginary, length = unpack_from(order + "5i", data, place)
    machine, zero, kind, what = mopt // 1000, mopt // 100 % 10, mopt // 10 % 10, mopt % 10
    if not (0 <= mopt < 5000 and machine == (order == ">") and zero == 0 and kind < len(TYPES) and what < 3):
        return None
    if rows < 0 or columns < 0 or imaginary not in (0, 1) or not 1 < length <= LONGEST_NAME:
        return None
    name = data[place + HEAD : place + HEAD + length]
    if len(name) < length or name[-1] or not name[:-1].replace(b"_", b"a").isalnum():
        return None
    return kind, what == 0, rows, columns, imaginary, length
