"""Records are read within bounds: a bomb is damage, and a cut chunk gives what is there."""

import struct
from io import BytesIO

import lz4.frame
import pytest
import zstandard

from motor_identification.bag.mcap.records import (
    LARGEST_RATIO,
    LARGEST_RECORD,
    SMALL,
    Damaged,
    records,
    unpack,
    unpack_zstd,
)

TEXT = bytes(range(256)) * 100


def chunk(kind: str, data: bytes, size: int, crc: int = 0) -> bytes:
    """The content of a chunk's record."""
    name = kind.encode()
    return struct.pack(f"<QQQII{len(name)}sQ", 0, 1, size, crc, len(name), name, len(data)) + data


@pytest.mark.parametrize(("kind", "pack"), [("zstd", zstandard.compress), ("lz4", lz4.frame.compress), ("", bytes)])
def test_what_was_packed_comes_out_and_of_half_of_it_a_beginning(kind: str, pack: object) -> None:
    data = pack(TEXT)  # type: ignore[operator]
    assert unpack(chunk(kind, data, len(TEXT)), True) == TEXT
    part = unpack(chunk(kind, data, len(TEXT))[:-10], False)
    assert TEXT.startswith(part)


@pytest.mark.parametrize(
    ("kind", "data", "size", "crc"),
    [
        ("zstd", zstandard.compress(bytes(SMALL + 1)), SMALL + 1, 0),  # ten thousand times as much
        ("zstd", zstandard.compress(bytes(1 << 22)), 1 << 20, 0),  # more than it says
        ("lz4", lz4.frame.compress(bytes(1 << 22)), 1 << 20, 0),
        ("zstd", zstandard.compress(TEXT), 2**63, 0),
        ("zstd", zstandard.compress(TEXT), len(TEXT), 1),
        ("zstd", b"no zstd", 10, 0),
        ("lzma", b"", 0, 0),
        ("", b"abc", 4, 0),
    ],
)
def test_what_is_not_what_it_says_is_damaged(kind: str, data: bytes, size: int, crc: int) -> None:
    with pytest.raises(Damaged):
        unpack(chunk(kind, data, size, crc), True)


def test_the_largest_that_is_unpacked() -> None:
    data = zstandard.compress(bytes(SMALL))
    assert len(data) < SMALL / LARGEST_RATIO and len(unpack(chunk("zstd", data, SMALL), True)) == SMALL
    assert len(unpack_zstd(data, 1000)) == 1001  # one more than the most says that there is more
    assert LARGEST_RECORD == 2**28


@pytest.mark.parametrize(
    "data", [bytes(100), b"\x05" + struct.pack("<Q", 2**62) + b"x", b"\x05\x01", struct.pack("<BQ", 5, 10) + b"12345"]
)
def test_no_record_and_a_cut_one_are_damage(data: bytes) -> None:
    with pytest.raises(Damaged):
        list(records(BytesIO(data), len(data)))


def test_records_say_where_they_are() -> None:
    data = struct.pack("<BQ3s", 5, 3, b"abc") + struct.pack("<BQ", 200, 0)
    assert [(read.opcode, read.content, read.offset) for read in records(BytesIO(data), len(data))] == [
        (5, b"abc", 0),
        (200, b"", 12),
    ]
