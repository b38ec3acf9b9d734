"""Writes a rosbag2 directory with MCAP storage that `ros2 bag`, PlotJuggler and Foxglove read; serialised messages in.

The stock `mcap` writer is used, not the one of `rosbags`: only the former can finish a chunk and flush the file while
recording (`rosbags` keeps up to 1 MiB, half a minute of a motor, in memory and would lose it to a kill -9), and it
compresses its chunks. What it lacks, `metadata.yaml` and the QoS, is added here.
"""

import shutil
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from types import TracebackType
from typing import BinaryIO

from mcap.writer import CompressionType, Writer

from motor_identification.bag.definition import installed
from motor_identification.bag.metadata import Span, bag_metadata, profiles_text, yaml_text
from motor_identification.bag.topic import Qos, Topic
from motor_model.errors import RecordingError

FLUSH_EVERY = 0.5  # [s] what a kill -9 loses at most, if `flush` is called as often when no messages come
_CHUNK_SIZE = 256 * 1024  # [bytes] about 10 s of a motor's topics


@dataclass(frozen=True, slots=True)
class _Channel:
    number: int
    topic: Topic
    type_hash: str


class BagWriter:
    """A new bag, open for messages until `close`; a context manager.

    Raises:
        RecordingError: something exists at the path already (it stays untouched), or it cannot be created or written.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        self.counts: Counter[str] = Counter()  # messages by topic
        self._stream = _create(self.path)
        self._writer = Writer(self._stream, chunk_size=_CHUNK_SIZE, compression=CompressionType.ZSTD)
        self._writer.start(profile="ros2", library=f"motor_identification (mcap {version('mcap')})")
        self._schemas: dict[str, int] = {}
        self._channels: dict[str, _Channel] = {}  # by topic name
        self._names: dict[int, str] = {}  # of topics, by channel
        self._span: Span | None = None
        self._flushed = time.monotonic()
        self._closed = False

    def topic(self, name: str, type_name: str, qos: tuple[Qos, ...] = ()) -> int:
        """The channel of a topic for `write`; a name that is known already keeps its channel."""
        if name in self._channels:
            return self._channels[name].number
        definition = installed(type_name)
        if type_name not in self._schemas:
            encoding = "ros2msg" if definition.text else ""
            self._schemas[type_name] = self._writer.register_schema(type_name, encoding, definition.text.encode())
        metadata = {"offered_qos_profiles": profiles_text(qos), "topic_type_hash": definition.type_hash}
        number: int = self._writer.register_channel(name, "cdr", self._schemas[type_name], metadata)
        topic = Topic(name, type_name, definition.text, qos)
        self._channels[name] = _Channel(number, topic, definition.type_hash)
        self._names[number] = name
        return number

    def write(self, channel: int, log_time: int, data: bytes, publish_time: int | None = None) -> None:
        """Append one serialised message (CDR with its encapsulation header); times in ns since 1970."""
        with _told(self.path):
            self._writer.add_message(channel, log_time, data, log_time if publish_time is None else publish_time)
        self.counts[self._names[channel]] += 1
        self._span = (self._span or Span(log_time, log_time)).including(log_time)
        if time.monotonic() - self._flushed >= FLUSH_EVERY:
            self.flush()

    def flush(self) -> None:
        """Hand everything written so far to the operating system, which keeps it even if this process is killed."""
        with _told(self.path):
            self._writer.flush()
        self._flushed = time.monotonic()

    @property
    def message_count(self) -> int:
        """Messages on all topics."""
        return self.counts.total()

    @property
    def duration(self) -> float:
        """[s] from the earliest log time to the latest; 0 without messages."""
        return (self._span.last - self._span.first) * 1e-9 if self._span else 0.0

    def close(self) -> None:
        """Finish the file and write `metadata.yaml`; a second call does nothing."""
        if self._closed:
            return
        self._closed = True
        topics = {channel.topic: channel.type_hash for channel in self._channels.values()}
        metadata = bag_metadata(topics, self.counts, self._span or Span(0, 0), Path(self._stream.name).name)
        with _told(self.path):
            self._writer.add_metadata("rosbag2", {"serialized_metadata": yaml_text(metadata)})
            self._writer.finish()
            self._stream.close()
            # First whole, then under its name: a reader never sees half of it.
            unfinished = self.path / "metadata.yaml.tmp"
            unfinished.write_text(yaml_text({"rosbag2_bagfile_information": metadata}), encoding="utf-8")
            unfinished.replace(self.path / "metadata.yaml")

    def discard(self) -> None:
        """Remove the bag, which this writer made: for when there turned out to be nothing worth keeping."""
        self._closed = True
        self._stream.close()
        shutil.rmtree(self.path)

    def __enter__(self) -> "BagWriter":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _create(path: Path) -> BinaryIO:
    if path.exists() or path.is_symlink():
        raise RecordingError(f"{path} exists already and is left as it is: choose another name, or move it away.")
    with _told(path):
        path.mkdir(parents=True)
        return (path / f"{path.resolve().name}_0.mcap").open("xb")


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """A disk that is full or write-protected, in a sentence."""
    try:
        yield
    except OSError as error:
        raise RecordingError(
            f"{path} cannot be written ({error.strerror}): make room, or choose another place."
        ) from error
