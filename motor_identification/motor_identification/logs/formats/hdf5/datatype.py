"""Read what an HDF5 array's elements are, and its shape."""

from dataclasses import dataclass
from math import prod
from struct import unpack_from

from motor_identification.logs.formats.mat_elements import MOST_BYTES, BrokenFileError

REFERENCE = 7  # class of a type
_MOST_DIMENSIONS = 8


@dataclass(frozen=True)
class Type:
    """What each element of an array is."""

    kind: int  # class
    size: int
    numbers: str  # of numpy; empty where there is none


def read_type(body: memoryview) -> Type:
    """Read a message of a type.

    Raises:
        BrokenFileError: it is too short.
    """
    if len(body) < 8:
        raise BrokenFileError("a type cannot be")
    first, bits, size = unpack_from("<BB2xI", body)
    kind, order = first & 0x0F, ">" if bits & 1 else "<"
    if kind == 0 and size in (1, 2, 4, 8):
        return Type(kind, size, f"{order}{'i' if bits & 8 else 'u'}{size}")
    if kind == 1 and size in (4, 8):
        return Type(kind, size, f"{order}f{size}")
    if kind == REFERENCE and size == 8:
        return Type(kind, size, "<u8")
    return Type(kind, size, f"S{size}" if kind == 3 and 0 < size <= 256 else "")


def read_shape(body: memoryview) -> tuple[int, ...] | None:
    """The dimensions; None where there are none, or too many."""
    version, rank = body[0], body[1]
    begin = {1: 8, 2: 4}.get(version)
    if begin is None or rank > _MOST_DIMENSIONS or len(body) < begin + 8 * rank:
        return None
    shape = unpack_from(f"<{rank}Q", body, begin)
    return shape if prod(shape) * 1.0 <= MOST_BYTES else None
