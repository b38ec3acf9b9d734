"""A file whose addresses and sizes are checked before anything is read by them, and whose growth is bounded."""

from dataclasses import dataclass
from struct import error as StructError
from struct import unpack_from
from typing import Any

from motor_identification.logs.formats.mat_elements import MOST_BYTES, MOST_ELEMENTS, BrokenFileError, TooLargeError

DEEPEST = 24  # groups in groups, and nodes of a tree


@dataclass
class BoundedFile:
    """What is read of, and how much was unpacked and entered so far."""

    data: memoryview
    base: int
    unpacked: int = 0
    objects: int = 0

    def read(self, layout: str, address: int) -> tuple[Any, ...]:
        """Numbers at an address."""
        try:
            if address < 0:
                raise BrokenFileError("an address cannot be")
            return unpack_from("<" + layout, self.data, self.base + address)
        except StructError as error:
            raise BrokenFileError("an address is beyond its end") from error

    def bytes(self, address: int, size: int) -> memoryview:
        """So many bytes at an address."""
        begin = self.base + address
        if address < 0 or size < 0 or begin + size > len(self.data):
            raise BrokenFileError("an address is beyond its end")
        return self.data[begin : begin + size]

    def grow(self, size: int) -> None:
        """Count what is unpacked."""
        self.unpacked += size
        if self.unpacked > MOST_BYTES:
            raise TooLargeError(f"more than {MOST_BYTES >> 20} MiB unpacked")

    def enter(self) -> None:
        """Count an object or a node."""
        self.objects += 1
        if self.objects > 5 * MOST_ELEMENTS:
            raise TooLargeError(f"more than {5 * MOST_ELEMENTS} objects")
