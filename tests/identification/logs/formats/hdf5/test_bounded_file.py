"""Nothing is read beyond a file's end, and nothing grows without bound."""

import pytest

from motor_identification.logs.formats.hdf5.bounded_file import BoundedFile
from motor_identification.logs.formats.mat_elements import (
    MOST_BYTES,
    MOST_ELEMENTS,
    BrokenFileError,
    TooLargeError,
)


def test_addresses_within_the_file() -> None:
    file = BoundedFile(memoryview(bytes(range(16))), base=4)
    assert file.read("BB", 0) == (4, 5) and bytes(file.bytes(10, 2)) == b"\x0e\x0f"
    for read in (lambda: file.read("B", 12), lambda: file.read("B", -1), lambda: file.bytes(11, 2)):
        with pytest.raises(BrokenFileError, match="an address"):
            read()


def test_what_is_unpacked_and_entered_is_bounded() -> None:
    file = BoundedFile(memoryview(b""), base=0)
    file.grow(MOST_BYTES)
    with pytest.raises(TooLargeError, match="512 MiB"):
        file.grow(1)
    file.objects = 5 * MOST_ELEMENTS - 1
    file.enter()
    with pytest.raises(TooLargeError, match="objects"):
        file.enter()
