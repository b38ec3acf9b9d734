"""One MCAP file, read from front to back as far as it goes: a file that a crash left without an end is a recording too.

Neither the reader of `mcap` nor that of `rosbags` does this: both want the index at the end of the file, both order by
log time (a step of the computer's clock would then shuffle the samples), and the stream reader of `mcap`, which needs
no index, gives up a cut chunk as a whole and takes ten times as long per message.
"""

import struct
import zlib
from collections.abc import Callable, Container, Iterable, Iterator
from io import BytesIO
from pathlib import Path
from typing import BinaryIO, TypeVar

import lz4.frame  # type: ignore[import-untyped]
import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.reader import make_reader
from mcap.records import Channel, Chunk, Metadata, Schema
from mcap.writer import MCAP0_MAGIC

from motor_identification.bag.contents import Contents, Span
from motor_identification.bag.topic import Topic, load_profiles
from motor_model.errors import RecordingError

Stored = tuple[Topic, int, bytes]  # topic, log time [ns], serialised message
Record = TypeVar("Record")

_RECORD_HEAD = struct.Struct("<BQ")  # opcode, length
_MESSAGE_HEAD = struct.Struct("<HIQQ")  # channel, sequence, log time, publish time
_DECOMPRESS: dict[str, Callable[[bytes], bytes]] = {  # each returns what is there when the input is cut
    "": lambda data: data,
    "zstd": lambda data: zstandard.ZstdDecompressor().decompressobj().decompress(data),
    "lz4": lambda data: bytes(lz4.frame.LZ4FrameDecompressor().decompress(data)),
}
_DAMAGE = (
    McapError, struct.error, UnicodeDecodeError, KeyError, OverflowError, zstandard.ZstdError, RuntimeError
)  # fmt: skip


class _Cut(Exception):
    """Nothing behind this point of the file can be read."""


class McapFile:
    """A file of a bag. After `messages` has come to its end, `topics` is complete and `cut` says whether it was."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.cut = True  # until the end of the data has been seen
        self.topics: dict[int, Topic] = {}  # by channel
        self.noted: dict[str, str] = {}  # by record and key: what its recorder said about the recording
        self._schemas: dict[int, Schema] = {}

    def messages(self, wanted: Container[str] | None = None) -> Iterator[Stored]:
        """Messages of the wanted topics (None: of all) in the order of the file.

        Raises:
            RecordingError: this is not an MCAP file.
        """
        size = self.path.stat().st_size
        with self.path.open("rb") as stream:
            magic = stream.read(len(MCAP0_MAGIC))
            if not MCAP0_MAGIC.startswith(magic):
                raise RecordingError(f"{self.path} is not an MCAP file: give a bag made by record or ros2 bag.")
            try:
                yield from self._read(stream, size, wanted)
            except (_Cut, struct.error):
                return  # `cut` says so

    def contents(self) -> Contents | None:
        """What the index at the end of the file says is in it; None where there is no index."""
        with self.path.open("rb") as stream:
            try:
                reader = make_reader(stream)
                summary = reader.get_summary()
                noted = _noted(reader.iter_metadata() if summary and summary.metadata_indexes else ())
            except (*_DAMAGE, OSError):
                return None
        if summary is None or summary.statistics is None:
            return None
        statistics = summary.statistics
        counts = statistics.channel_message_counts
        topics = [
            _topic(channel, summary.schemas.get(channel.schema_id), counts.get(channel.id, 0))
            for channel in summary.channels.values()
        ]
        span = Span(statistics.message_start_time, statistics.message_end_time) if statistics.message_count else None
        return Contents(tuple(topics), span, custom_data=noted)

    def _read(self, stream: BinaryIO, size: int, wanted: Container[str] | None) -> Iterator[Stored]:
        for opcode, content, ended in _records(stream, size):
            if opcode == Opcode.MESSAGE:
                channel, _, log_time, _ = _MESSAGE_HEAD.unpack_from(content)
                topic = self.topics.get(channel)
                if topic is not None and (wanted is None or topic.name in wanted):
                    yield topic, log_time, content[_MESSAGE_HEAD.size :]
            elif opcode == Opcode.CHUNK:
                data = _unpack(content, ended)
                yield from self._read(BytesIO(data), len(data), wanted)
                if not ended:
                    raise _Cut
            elif opcode == Opcode.SCHEMA:
                schema = _parse(Schema.read, content)
                self._schemas[schema.id] = schema
            elif opcode == Opcode.CHANNEL:
                found = _parse(Channel.read, content)
                self.topics[found.id] = _topic(found, self._schemas.get(found.schema_id))
            elif opcode == Opcode.METADATA:
                self.noted |= _noted([_parse(Metadata.read, content)])
            elif opcode == Opcode.DATA_END:
                self.cut = False
                return


def _records(stream: BinaryIO, size: int) -> Iterator[tuple[int, bytes, bool]]:
    """Opcode and content of every record, and whether that is all of it; only a chunk may come shorter than it was."""
    while head := stream.read(_RECORD_HEAD.size):
        if len(head) < _RECORD_HEAD.size:
            raise _Cut
        opcode, length = _RECORD_HEAD.unpack(head)
        content = stream.read(min(length, size))  # a damaged length must not ask for more memory than there is file
        ended = len(content) == length
        if not ended and opcode != Opcode.CHUNK:
            raise _Cut
        yield opcode, content, ended


def _unpack(content: bytes, ended: bool) -> bytes:
    """The records in a chunk, as far as they are there: of one that has not ended, what can be decompressed."""
    chunk = _parse(Chunk.read, content)
    try:
        data = _DECOMPRESS[chunk.compression](chunk.data)
    except _DAMAGE as error:
        raise _Cut from error
    whole = len(data) == chunk.uncompressed_size
    if (ended and not whole) or (whole and chunk.uncompressed_crc not in (0, zlib.crc32(data))):
        raise _Cut  # damaged, not cut: any part of it may be wrong
    return data


def _parse(read: Callable[[ReadDataStream], Record], content: bytes) -> Record:
    try:
        return read(ReadDataStream(BytesIO(content)))
    except _DAMAGE as error:
        raise _Cut from error


def _noted(records: Iterable[Metadata]) -> dict[str, str]:
    """Metadata records as `name.key`; that of rosbag2 repeats metadata.yaml."""
    return {
        f"{record.name}.{key}": value
        for record in records
        if record.name != "rosbag2"
        for key, value in record.metadata.items()
    }


def _topic(channel: Channel, schema: Schema | None, message_count: int = 0) -> Topic:
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
