"""What an array's elements are, and its shape."""

from struct import pack

import pytest

from motor_identification.logs.formats.hdf5.datatype import read_shape, read_type
from motor_identification.logs.formats.mat_elements import BrokenFileError


@pytest.mark.parametrize(
    ("kind", "bits", "size", "numbers"),
    [(0, 8, 2, "<i2"), (0, 1, 4, ">u4"), (1, 0, 8, "<f8"), (1, 0, 2, ""), (3, 0, 256, "S256"), (3, 0, 257, ""),
     (7, 0, 8, "<u8"), (6, 0, 8, "")],
)  # fmt: skip
def test_types(kind: int, bits: int, size: int, numbers: str) -> None:
    assert read_type(memoryview(pack("<BB2xI", kind, bits, size))).numbers == numbers


def test_a_type_that_is_too_short() -> None:
    with pytest.raises(BrokenFileError, match="a type cannot be"):
        read_type(memoryview(bytes(7)))


def test_shapes() -> None:
    plane = memoryview(pack("<BB6x2Q", 1, 2, 5, 7))
    assert read_shape(plane) == (5, 7)
    assert read_shape(plane[:-1]) is None
    assert read_shape(memoryview(pack("<BB6x9Q", 1, 9, *range(9)))) is None  # too many dimensions
    assert read_shape(memoryview(pack("<BB6xQ", 1, 1, 2**60))) is None  # more than is ever read
