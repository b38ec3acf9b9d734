"""The index at the end of an MCAP file: topics, counts, times, and where each chunk begins."""

import struct
import zlib
from dataclasses import dataclass, field
from io import BytesIO
from typing import BinaryIO

from mcap.opcode import Opcode
from mcap.records import Channel, ChunkIndex, Metadata, MetadataIndex, Schema, Statistics
from mcap.writer import MCAP0_MAGIC

from motor_identification.bag.contents import Contents, Span
from motor_identification.bag.mcap.records import LARGEST_RECORD, Damaged, noted, parse, records, topic

_FOOTER = struct.Struct("<BQQQI")  # opcode, length, start of the summary, start of its offsets, CRC
_CRC = 4  # bytes


@dataclass
class Summary:
    """What the index says; by identifiers of the file."""

    schemas: dict[int, Schema] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)
    chunks: list[ChunkIndex] = field(default_factory=list)
    statistics: Statistics | None = None
    noted: dict[str, str] = field(default_factory=dict)

    def next_chunk(self, offset: int) -> int | None:
        """Where the first chunk behind an offset begins."""
        return min(
            (chunk.chunk_start_offset for chunk in self.chunks if chunk.chunk_start_offset > offset), default=None
        )

    def contents(self) -> Contents | None:
        """What is in the file; None where the index does not count."""
        if self.statistics is None:
            return None
        counts = self.statistics.channel_message_counts
        topics = tuple(
            topic(channel, self.schemas.get(channel.schema_id), counts.get(channel.id, 0))
            for channel in self.channels.values()
        )
        times = sorted((self.statistics.message_start_time, self.statistics.message_end_time))
        span = Span(*times) if self.statistics.message_count else None
        return Contents(topics, span, custom_data=self.noted)


def read_summary(stream: BinaryIO, size: int) -> Summary | None:
    """Read the index of a file of so many bytes; None where there is none, or a damaged one."""
    try:
        return _read(stream, size)
    except (Damaged, struct.error, OSError):
        return None


def _read(stream: BinaryIO, size: int) -> Summary | None:
    end = size - len(MCAP0_MAGIC) - _FOOTER.size
    stream.seek(max(end, 0))
    footer = stream.read(_FOOTER.size)
    opcode, length, start, _, crc = _FOOTER.unpack(footer)
    if opcode != Opcode.FOOTER or length != _FOOTER.size - 9 or not 0 < start <= end:
        return None
    if end - start > LARGEST_RECORD:
        return None
    stream.seek(start)
    content = stream.read(end - start)
    if crc not in (0, zlib.crc32(content + footer[:-_CRC])):
        return None
    return _summary(content, stream, size)


def _summary(content: bytes, stream: BinaryIO, size: int) -> Summary:
    summary = Summary()
    for record in records(BytesIO(content), len(content)):
        if record.opcode == Opcode.SCHEMA:
            schema = parse(Schema.read, record.content)
            summary.schemas[schema.id] = schema
        elif record.opcode == Opcode.CHANNEL:
            channel = parse(Channel.read, record.content)
            summary.channels[channel.id] = channel
        elif record.opcode == Opcode.CHUNK_INDEX:
            summary.chunks.append(parse(ChunkIndex.read, record.content))
        elif record.opcode == Opcode.STATISTICS:
            summary.statistics = parse(Statistics.read, record.content)
        elif record.opcode == Opcode.METADATA_INDEX:
            stream.seek(min(parse(MetadataIndex.read, record.content).offset, size))
            for found in records(stream, size):
                if found.opcode == Opcode.METADATA:
                    summary.noted |= noted([parse(Metadata.read, found.content)])
                break
    return summary
