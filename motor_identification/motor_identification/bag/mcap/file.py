"""One MCAP file, read from front to back as far as it goes: a file that a crash left without an end is a recording too.

Neither the reader of `mcap` nor that of `rosbags` does this: both want the index at the end of the file, both order by
log time (a step of the computer's clock would then shuffle the samples), and the stream reader of `mcap`, which needs
no index, gives up a cut chunk as a whole and takes ten times as long per message. Behind damage it is read on at the
next chunk that the index knows.
"""

import struct
from collections.abc import Container, Iterator
from contextlib import suppress
from io import BytesIO
from pathlib import Path
from typing import BinaryIO

from mcap.opcode import Opcode
from mcap.records import Channel, Metadata, Schema
from mcap.writer import MCAP0_MAGIC

from motor_identification.bag.contents import Contents
from motor_identification.bag.mcap.records import Damaged, Read, noted, parse, records, topic, unpack
from motor_identification.bag.mcap.summary import Summary, read_summary
from motor_identification.bag.topic import Topic
from motor_model.errors import RecordingError
from motor_model.regular_file import check_regular

Stored = tuple[Topic, int, bytes]  # topic, log time [ns], serialised message

LARGEST_BAG = 1 << 34  # bytes of chunks, unpacked: a week of a motor at 1 kHz
MOST_SEARCHES = 1000  # for what is behind damage: a made-up index could send us about for ever
_MESSAGE_HEAD = struct.Struct("<HIQQ")  # channel, sequence, log time, publish time


class McapFile:
    """A file of a bag. After `messages` has come to its end, `topics` is complete and `cut` says whether it was.

    `damaged` then counts places behind which more could be read, and `lost` the messages that could not, as far as the
    index knows.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.cut = True  # until the end of the data has been seen
        self.damaged = self.lost = 0
        self.topics: dict[int, Topic] = {}  # by channel
        self.noted: dict[str, str] = {}  # by record and key: what its recorder said about the recording
        self._schemas: dict[int, Schema] = {}
        self._count = self._unpacked = 0  # messages met, wanted or not; bytes
        self._offset = 0  # of the latest record outside of chunks

    def messages(self, wanted: Container[str] | None = None) -> Iterator[Stored]:
        """Messages of the wanted topics (None: of all) in the order of the file.

        Raises:
            RecordingError: this is not an MCAP file, or it stands for more than anybody records.
        """
        check_regular(self.path)
        size = self.path.stat().st_size
        with self.path.open("rb") as stream, self.path.open("rb") as index:
            magic = stream.read(len(MCAP0_MAGIC))
            if not MCAP0_MAGIC.startswith(magic):
                raise RecordingError(f"{self.path} is not an MCAP file: give a bag made by record or ros2 bag.")
            summary = read_summary(index, size) or Summary()
            yield from self._read_on(stream, size, wanted, summary)
            if summary.statistics is not None:
                self.lost = max(summary.statistics.message_count - self._count, 0)
                self.damaged = max(self.damaged, 1) if self.lost else 0

    def contents(self) -> Contents | None:
        """What the index at the end of the file says is in it; None where there is no index."""
        check_regular(self.path)
        with self.path.open("rb") as stream:
            summary = read_summary(stream, self.path.stat().st_size)
        return summary.contents() if summary else None

    def _read_on(
        self, stream: BinaryIO, size: int, wanted: Container[str] | None, summary: Summary
    ) -> Iterator[Stored]:
        """Messages to the end, or to damage behind which no chunk is known."""
        sought, broken = 0, -1
        for _ in range(MOST_SEARCHES):
            with suppress(Damaged):
                yield from self._read(stream, size, wanted, summary)
            # Behind an end that was none, or a record that was none, the index may know of more.
            behind = summary.next_chunk(max(self._offset, sought))
            if behind is None:
                return
            self.cut = True
            self.damaged += self._offset != broken  # else nothing could be read since
            broken = self._offset
            sought = stream.seek(behind)

    def _read(self, stream: BinaryIO, size: int, wanted: Container[str] | None, summary: Summary) -> Iterator[Stored]:
        """Messages up to the end of the data.

        Raises:
            Damaged: before that.
        """
        for record in records(stream, size):
            self._offset = record.offset
            if record.opcode == Opcode.CHUNK:
                yield from self._chunk(record, wanted, summary)
                if not record.ended:
                    raise Damaged
            elif record.opcode == Opcode.DATA_END:
                self.cut = False
                return
            else:
                yield from self._taken(record, wanted, summary)

    def _chunk(self, record: Read, wanted: Container[str] | None, summary: Summary) -> Iterator[Stored]:
        """The messages in a chunk; none where it is damaged, for any part of it may be wrong."""
        try:
            data = unpack(record.content, record.ended)
        except Damaged:
            if not record.ended:
                raise
            self.damaged += 1
            return
        self._unpacked += len(data)
        if self._unpacked > LARGEST_BAG:
            raise RecordingError(f"{self.path} holds more than {LARGEST_BAG >> 30} GiB: split it into shorter bags.")
        try:
            for inner in records(BytesIO(data), len(data)):
                yield from self._taken(inner, wanted, summary)
        except Damaged:
            if not record.ended:
                raise
            self.damaged += 1

    def _taken(self, record: Read, wanted: Container[str] | None, summary: Summary) -> Iterator[Stored]:
        if record.opcode == Opcode.MESSAGE:
            if len(record.content) < _MESSAGE_HEAD.size:
                raise Damaged
            self._count += 1
            channel, _, log_time, _ = _MESSAGE_HEAD.unpack_from(record.content)
            found = self.topics.get(channel) or self._indexed(channel, summary)
            if found is not None and (wanted is None or found.name in wanted):
                yield found, log_time, record.content[_MESSAGE_HEAD.size :]
        elif record.opcode == Opcode.SCHEMA:
            schema = parse(Schema.read, record.content)
            self._schemas[schema.id] = schema
        elif record.opcode == Opcode.CHANNEL:
            named = parse(Channel.read, record.content)
            self.topics[named.id] = topic(named, self._schemas.get(named.schema_id))
        elif record.opcode == Opcode.METADATA:
            self.noted |= noted([parse(Metadata.read, record.content)])

    def _indexed(self, channel: int, summary: Summary) -> Topic | None:
        """The topic of a channel whose own record was lost, as the index has it."""
        if channel in summary.channels:
            known = summary.channels[channel]
            self.topics[channel] = topic(known, summary.schemas.get(known.schema_id))
        return self.topics.get(channel)
