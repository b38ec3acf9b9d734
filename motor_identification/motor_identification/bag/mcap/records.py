"""The records of an MCAP file, as far as they are there, and within bounds: what bytes mean, not where they lie."""

import struct
import zlib
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from io import BytesIO
from typing import BinaryIO, TypeVar

import lz4.frame  # type: ignore[import-untyped]
import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Channel, Chunk, Metadata, Schema

from motor_identification.bag.topic import Topic, load_profiles

LARGEST_RECORD = 1 << 28  # bytes, unpacked too: recorders end a chunk at a megabyte, or behind one large message
LARGEST_RATIO = 2000  # of what unpacking makes: constant data reach 100, a bomb of zeros 25,000
SMALL = 1 << 24  # bytes that no bomb is made of
_HEAD = struct.Struct("<BQ")  # opcode, length
DAMAGE = (
    McapError, struct.error, UnicodeDecodeError, KeyError, OverflowError, MemoryError, zstandard.ZstdError,
    RuntimeError, EOFError,
)  # fmt: skip
Record = TypeVar("Record")


class Damaged(Exception):
    """A record that is not all there, or not as it was written."""


@dataclass(frozen=True, slots=True)
class Read:
    """A record in a stream; only a chunk may come shorter than it was."""

    opcode: int
    content: bytes
    offset: int  # of its first byte
    ended: bool = True  # all of it is there


def records(stream: BinaryIO, size: int) -> Iterator[Read]:
    """Every record from here on.

    Raises:
        Damaged: what comes is no record, or is cut off.
    """
    while head := stream.read(_HEAD.size):
        offset = stream.tell() - len(head)
        if len(head) < _HEAD.size:
            raise Damaged
        opcode, length = _HEAD.unpack(head)
        if opcode == 0:  # which the format forbids, and a bomb of zeros has a hundred million times
            raise Damaged
        # A damaged length must not ask for more memory than there is file, nor for more than a record can have.
        content = stream.read(min(length, size, LARGEST_RECORD))
        ended = len(content) == length
        if not ended and opcode != Opcode.CHUNK:
            raise Damaged
        yield Read(opcode, content, offset, ended)


def parse(read: Callable[[ReadDataStream], Record], content: bytes) -> Record:
    """Parse a record's fields.

    Raises:
        Damaged: they are not of its kind.
    """
    try:
        return read(ReadDataStream(BytesIO(content)))
    except DAMAGE as error:
        raise Damaged from error


def unpack(content: bytes, ended: bool) -> bytes:
    """Unpack the records in a chunk, as far as they are there: of one that has not ended, what can be decompressed.

    Raises:
        Damaged: they are not what was written, or more than anybody writes.
    """
    chunk = parse(Chunk.read, content)
    if chunk.uncompressed_size > min(LARGEST_RECORD, max(SMALL, LARGEST_RATIO * len(chunk.data))):
        raise Damaged
    try:
        data = _UNPACK[chunk.compression](chunk.data, chunk.uncompressed_size)
    except DAMAGE as error:
        raise Damaged from error
    whole = len(data) == chunk.uncompressed_size
    if (ended and not whole) or (whole and chunk.uncompressed_crc not in (0, zlib.crc32(data))):
        raise Damaged  # not cut: any part of it may be wrong
    return data


def unpack_zstd(data: bytes, most: int) -> bytes:
    """Return what the data stand for, `most` bytes and one at most; of data that are cut, what is there."""
    reader = zstandard.ZstdDecompressor().stream_reader(data)
    parts: list[bytes] = []
    left = most + 1
    while left > 0 and (part := reader.read(min(left, 1 << 20))):
        parts.append(part)
        left -= len(part)
    return b"".join(parts)


def _unpack_lz4(data: bytes, most: int) -> bytes:
    return bytes(lz4.frame.LZ4FrameDecompressor().decompress(data, max_length=most + 1))


_UNPACK: dict[str, Callable[[bytes, int], bytes]] = {
    "": lambda data, most: data,
    "zstd": unpack_zstd,
    "lz4": _unpack_lz4,
}


def noted(found: Iterable[Metadata]) -> dict[str, str]:
    """Metadata records as `name.key`; that of rosbag2 repeats metadata.yaml."""
    return {
        f"{record.name}.{key}": value
        for record in found
        if record.name != "rosbag2"
        for key, value in record.metadata.items()
    }


def topic(channel: Channel, schema: Schema | None, message_count: int = 0) -> Topic:
    """Return the topic of a channel."""
    type_name = schema.name if schema else ""
    return Topic(
        name=channel.topic,
        # Whoever looks for a type must not take another encoding of it for CDR.
        type_name=type_name if channel.message_encoding == "cdr" else f"{type_name} as {channel.message_encoding}",
        definition=schema.data.decode(errors="replace") if schema and schema.encoding == "ros2msg" else "",
        qos=load_profiles(channel.metadata.get("offered_qos_profiles", "")),
        message_count=message_count,
        type_hash=channel.metadata.get("topic_type_hash", ""),
    )
