"""Read the real numbers of a MATLAB 5 to 7 file, as its "MAT-File Format" says: tags, sizes, matrices, structs.

SciPy's reader, compiled, is ended by the operating system where a damaged file names a type of numbers that there is
not: every type, size and dimension is checked here before anything is read by it. What holds no real numbers (long
texts, sparse matrices, objects of newer classes) is left out.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from math import prod
from struct import unpack_from
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from motor_model.errors import MotorError

HEADER = 128  # bytes
MATRIX, COMPRESSED = 14, 15
TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
CELL, STRUCT, OBJECT, TEXT, NUMERIC = 1, 2, 3, 4, range(6, 16)
OPAQUE = 17  # an object of newer classes, whose elements are in another order
CLASS = "@"  # before the class of an object, in the place of its fields
COMPLEX = 0x0800  # in the flags
DEEPEST, MOST_FIELDS, MOST_DIMENSIONS = 6, 1000, 32
MOST_ALIKE, LONGEST_TEXT = 64, 100  # structs in one variable, and characters of a label
MOST_BYTES = 2**29  # unpacked, of all
MOST_NUMBERS = 64_000_000  # of all, since each becomes a float64, though it may be packed as a byte: 512 MB
MOST_ELEMENTS = 20_000  # variables and fields of all
Value: TypeAlias = "NDArray[Any] | str | dict[str, Value]"


class Cells(dict[str, Value]):
    """Several values in an array of cells, by 1, 2, …."""


class BrokenFileError(MotorError):
    """What the file says of itself cannot be."""


class TooLargeError(MotorError):
    """The file holds more than fits an ordinary memory."""


@dataclass(frozen=True)
class Element:
    """A tagged piece."""

    type: int
    data: memoryview


@dataclass
class Tally:
    """A file's byte order, and how much of it has been read."""

    order: str
    elements: int = 0
    numbers: int = 0

    def add(self, elements: int = 0, numbers: int = 0) -> None:
        """Count.

        Raises:
            TooLargeError: it is too much.
        """
        self.elements, self.numbers = self.elements + elements, self.numbers + numbers
        if self.elements > MOST_ELEMENTS:
            raise TooLargeError(f"more than {MOST_ELEMENTS} variables and fields")
        if self.numbers > MOST_NUMBERS:
            raise TooLargeError(f"more than {MOST_NUMBERS // 10**6} million numbers")


def read_variables(data: bytes) -> dict[str, Value]:
    """Read matrices of shape (rows, columns) by name, structs as dictionaries of such, several of them by 1, 2, ….

    So are arrays of cells. An object of an older class, such as iddata, is a dictionary of its fields under `@iddata`.

    Raises:
        BrokenFileError: a tag, a size, a type or a dimension cannot be.
        TooLargeError: it is unpacked more than 512 MiB, 64 million numbers or 20,000 variables and fields.
    """
    found: dict[str, Value] = {}
    tally, matrices = list_matrices(data)
    for one in matrices:
        name, value = read_matrix(one, tally, 0)
        if value is not None:
            found[name] = value
    return found


def list_matrices(data: bytes) -> tuple[Tally, Iterator[memoryview]]:
    """List the variables of a file, unpacked one by one; the tally counts what is read of them.

    Raises:
        BrokenFileError: it has no header; a size cannot be.
        TooLargeError: it is unpacked more than 512 MiB.
    """
    if len(data) > MOST_BYTES:
        raise TooLargeError(f"more than {MOST_BYTES >> 20} MiB")
    if len(data) < HEADER or data[126:128] not in (b"IM", b"MI"):
        raise BrokenFileError("it has no header")
    tally = Tally("<" if data[126:128] == b"IM" else ">")
    return tally, _list_matrices(data, tally)


def _list_matrices(data: bytes, tally: Tally) -> Iterator[memoryview]:
    unpacked = len(data)
    for element in split_elements(memoryview(data), HEADER, tally.order):
        tally.add(elements=1)
        if element.type == COMPRESSED:
            inner = _unpack(element.data, MOST_BYTES - unpacked)
            unpacked += len(inner)
            element = next(split_elements(inner, 0, tally.order), element)
        if element.type == MATRIX:
            yield element.data


def _unpack(data: memoryview, most: int) -> memoryview:
    unpacking = zlib.decompressobj()
    try:
        inner = unpacking.decompress(data, most + 1)
    except zlib.error as error:
        raise BrokenFileError("a variable cannot be unpacked") from error
    if len(inner) > most:
        raise TooLargeError(f"more than {MOST_BYTES >> 20} MiB unpacked")
    return memoryview(inner)


def split_elements(data: memoryview, position: int, order: str) -> Iterator[Element]:
    """The pieces one after the other; small ones have type and size in one word."""
    while position + 8 <= len(data):
        kind, size = unpack_from(order + "II", data, position)
        begin = position + 8
        if kind >> 16:
            kind, size, begin = kind & 0xFFFF, kind >> 16, position + 4
            if size > 4:
                raise BrokenFileError("a small element is none")
        if begin + size > len(data):
            raise BrokenFileError("an element is longer than what it is in")
        yield Element(kind, data[begin : begin + size])
        position = (
            begin + size if kind == COMPRESSED else position + 8 if begin == position + 4 else begin + -(-size // 8) * 8
        )


def read_matrix(data: memoryview, tally: Tally, depth: int) -> tuple[str, Value | None]:
    """Name and value of a matrix; None where it has no real numbers."""
    tally.add(elements=1)
    parts = split_elements(data, 0, tally.order)
    head = [part for _, part in zip(range(3), parts, strict=False)]
    if len(head) < 3 or len(head[0].data) < 8:
        return "", None
    flags = unpack_from(tally.order + "I", head[0].data)[0]
    kind = flags & 0xFF
    if kind >= NUMERIC.stop or (kind == TEXT and depth == 0):
        return "", None
    shape = _shape(head[1].data, tally.order)
    name = bytes(head[2].data).decode("latin-1")
    if kind in NUMERIC and not flags & COMPLEX and len(shape) > 2 and is_vector(shape):
        return name, _numbers(next(parts, None), (prod(shape), 1), tally)
    if kind in NUMERIC and not flags & COMPLEX and len(shape) == 2:
        return name, _numbers(next(parts, None), shape, tally)
    if kind == OBJECT and prod(shape) == 1 and depth < DEEPEST:
        text = bytes(next(parts, head[2]).data).decode("latin-1")
        return name, {CLASS + text: _structs(parts, 1, tally, depth)[0]}
    if kind == STRUCT and 1 <= prod(shape) <= MOST_ALIKE and depth < DEEPEST:
        alike = _structs(parts, prod(shape), tally, depth)
        return name, alike[0] if len(alike) == 1 else {str(k): one for k, one in enumerate(alike, start=1)}
    if kind == TEXT and len(shape) == 2 and shape[0] == 1 and 0 < shape[1] <= LONGEST_TEXT:
        return name, _text(next(parts, None))
    if kind == CELL and 1 <= prod(shape) <= MOST_ALIKE and depth < DEEPEST:
        return name, _join_cells([read_matrix(part.data, tally, depth + 1)[1] for part in parts if part.type == MATRIX])
    return name, None


def _join_cells(values: list[Value | None]) -> Value | None:
    """The only value of an array of cells, the lines that its texts are, or those with real numbers by 1, 2, …."""
    if len(values) == 1:
        return values[0]
    texts = [one for one in values if isinstance(one, str)]
    if texts and len(texts) == len(values):
        return "\n".join(texts)
    return Cells({str(k): one for k, one in enumerate(values, start=1) if one is not None}) or None


def read_kind(matrix: memoryview, tally: Tally) -> int:
    """Read the kind of a matrix; 0 where it is none."""
    head = next(split_elements(matrix, 0, tally.order), None)
    return int(unpack_from(tally.order + "I", head.data)[0]) & 0xFF if head is not None and len(head.data) > 3 else 0


def read_numbers(matrix: memoryview, tally: Tally) -> NDArray[Any] | None:
    """Read real numbers of any dimensions; None where a matrix has none."""
    if read_kind(matrix, tally) not in NUMERIC:
        return None
    _, shape, _, *rest = split_elements(matrix, 0, tally.order)
    return _numbers(next(iter(rest), None), _shape(shape.data, tally.order), tally)


def is_vector(shape: tuple[int, ...]) -> bool:
    """Whether a matrix is long in one dimension only, as 1 × 1 × samples: so Simulink logs a matrix of one number."""
    return sum(size != 1 for size in shape) <= 1


def _shape(data: memoryview, order: str) -> tuple[int, ...]:
    count = len(data) // 4
    if len(data) % 4 or not 2 <= count <= MOST_DIMENSIONS:  # a product of many takes minutes
        raise BrokenFileError("a dimension cannot be")
    shape = unpack_from(f"{order}{count}i", data)
    if any(size < 0 for size in shape) or prod(shape) > MOST_BYTES:
        raise BrokenFileError("a dimension cannot be")
    return shape


def _numbers(part: Element | None, shape: tuple[int, ...], tally: Tally) -> NDArray[Any]:
    if part is None or part.type not in TYPES:
        raise BrokenFileError("there is no such type of numbers")
    kind = np.dtype(tally.order + TYPES[part.type])
    if len(part.data) != prod(shape) * kind.itemsize:
        raise BrokenFileError("a matrix has other dimensions than numbers")
    tally.add(numbers=prod(shape))
    return np.frombuffer(part.data, kind).reshape(shape, order="F")


def _text(part: Element | None) -> str | None:
    """One line of characters, in whichever code MATLAB wrote them."""
    codes = {2: "latin-1", 4: "utf-16-le", 16: "utf-8", 17: "utf-16-le"}
    return None if part is None or part.type not in codes else bytes(part.data).decode(codes[part.type], "replace")


def _structs(parts: Iterator[Element], count: int, tally: Tally, depth: int) -> list[dict[str, Value]]:
    sizes, names = next(parts, None), next(parts, None)
    if sizes is None or names is None or len(sizes.data) < 4:
        raise BrokenFileError("a struct has no fields")
    length = unpack_from(tally.order + "i", sizes.data)[0]
    if not 0 < length <= 256 or len(names.data) // length > MOST_FIELDS:
        raise BrokenFileError("a struct's fields cannot be")
    alike: list[dict[str, Value]] = []
    texts = bytes(names.data)
    for _ in range(count):
        found: dict[str, Value] = {}
        for begin, part in zip(range(0, len(texts), length), parts, strict=False):
            value = read_matrix(part.data, tally, depth + 1)[1] if part.type == MATRIX else None
            if value is not None:
                found[texts[begin : begin + length].split(b"\0")[0].decode("latin-1")] = value
        alike.append(found)
    return alike
