"""Writes a rosbag2 directory with MCAP storage that `ros2 bag`, PlotJuggler and Foxglove read; serialised messages in.

The stock `mcap` writer is used, not the one of `rosbags`: only the former can finish a chunk and flush the file while
recording (`rosbags` keeps up to 1 MiB, half a minute of a motor, in memory and would lose it to a kill -9), and it
compresses its chunks. What it lacks, `metadata.yaml` and the QoS, is added here.
"""

import os
import shutil
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace as changed
from importlib.metadata import version
from itertools import count
from pathlib import Path
from types import TracebackType

from mcap.writer import CompressionType, Writer

from motor_identification.bag.contents import Contents, Span
from motor_identification.bag.definition import installed
from motor_identification.bag.disk import refused, told
from motor_identification.bag.metadata import bag_metadata, profiles_text, write_metadata, yaml_text
from motor_identification.bag.new_bag import create_bag
from motor_identification.bag.topic import Qos, Topic
from motor_model.errors import RecordingError

FLUSH_EVERY = 0.5  # [s] what a kill -9 loses at most, if `flush` is called as often when no messages come
_CHUNK_SIZE = 256 * 1024  # [bytes] about 10 s of a motor's topics


class BagWriter:
    """A new bag, open for messages until `close`; a context manager.

    Where the disk refuses something, everything up to the last flush stays readable, and nothing is written any more.
    With `replace`, a bag that is there already is removed first; what is no bag never is. Where a `part` of it is of no
    use, because it can be written anew, nobody is told that one is kept: whoever writes it discards it.

    Raises:
        RecordingError: something exists at the path already (it stays untouched), or it cannot be created or written.
    """

    def __init__(self, path: str | Path, replace: bool = False, part: bool = True) -> None:
        self.path = Path(path)
        self.counts: Counter[str] = Counter()  # messages by topic
        self._stream = create_bag(self.path, replace)
        self._schemas: dict[str, int] = {}
        self._channels: dict[str, int] = {}  # by topic name
        self._topics: dict[int, Topic] = {}  # by channel
        self._noted: dict[str, str] = {}
        self._span: Span | None = None
        self._flushed = time.monotonic()
        self._whole, self._kept = 0, 0  # bytes, and messages in them, that the operating system has
        self._refusal: RecordingError | None = None
        self._part = part
        self._closed = False
        self._writer = Writer(self._stream, chunk_size=_CHUNK_SIZE, compression=CompressionType.ZSTD)
        with self._writing():
            self._writer.start(profile="ros2", library=f"motor_identification (mcap {version('mcap')})")

    def topic(self, name: str, type_name: str, qos: tuple[Qos, ...] = ()) -> int:
        """The channel of a topic for `write`; a name that is known already keeps its channel."""
        if name in self._channels:
            return self._channels[name]
        definition = installed(type_name)
        topic = Topic(name, type_name, definition.text, qos, type_hash=definition.type_hash)
        with self._writing():
            if type_name not in self._schemas:
                encoding = "ros2msg" if definition.text else ""
                self._schemas[type_name] = self._writer.register_schema(type_name, encoding, definition.text.encode())
            metadata = {"offered_qos_profiles": profiles_text(qos), "topic_type_hash": definition.type_hash}
            number: int = self._writer.register_channel(name, "cdr", self._schemas[type_name], metadata)
        self._channels[name], self._topics[number] = number, topic
        return number

    def note(self, name: str, values: Mapping[str, str]) -> None:
        """Keep words about the recording: an MCAP metadata record, and `name.key` in the custom_data of the bag."""
        with self._writing():
            self._writer.add_metadata(name, dict(values))
        self._noted.update({f"{name}.{key}": value for key, value in values.items()})
        self.flush()

    def write(self, channel: int, log_time: int, data: bytes, publish_time: int | None = None) -> None:
        """Append one serialised message (CDR with its encapsulation header); times in ns since 1970."""
        with self._writing():
            self._writer.add_message(channel, log_time, data, log_time if publish_time is None else publish_time)
        self.counts[self._topics[channel].name] += 1
        self._span = (self._span or Span(log_time, log_time)).including(log_time)
        if time.monotonic() - self._flushed >= FLUSH_EVERY:
            self.flush()

    def flush(self) -> None:
        """Hand everything written so far to the operating system, which keeps it even if this process is killed."""
        with self._writing():
            self._writer.flush()
            self._whole = self._stream.tell()
        self._kept, self._flushed = self.message_count, time.monotonic()

    @property
    def message_count(self) -> int:
        """Messages on all topics."""
        return self.counts.total()

    @property
    def duration(self) -> float:
        """[s] from the earliest log time to the latest; 0 without messages."""
        return (self._span.last - self._span.first) * 1e-9 if self._span else 0.0

    def close(self) -> None:
        """Finish the file and write `metadata.yaml`; a second call, or one after a refusal, does nothing."""
        if self._closed or self._refusal:
            return
        self._closed = True
        topics = tuple(changed(topic, message_count=self.counts[topic.name]) for topic in self._topics.values())
        contents = Contents(topics, self._span, custom_data=self._noted)
        metadata = bag_metadata({Path(self._stream.name).name: contents}, "mcap")
        self.flush()
        with self._writing():
            self._writer.add_metadata("rosbag2", {"serialized_metadata": yaml_text(metadata)})
            self._writer.finish()
            self._stream.close()
        with told(self.path):
            write_metadata(self.path, metadata)

    def discard(self) -> None:
        """Remove the bag, which this writer made: for when there turned out to be nothing worth keeping."""
        self._closed = True
        self._stream.close()
        shutil.rmtree(self.path)

    def set_aside(self) -> Path | None:
        """Close, and free the bag's name for another attempt; returns where the bag is now, None if it was empty."""
        self.close()
        if self.message_count == 0 and not self._refusal:
            self.discard()
            return None
        names = (f"{self.path.name}_incomplete{f'_{n}' if n > 1 else ''}" for n in count(1))
        aside = next(path for path in map(self.path.with_name, names) if not path.exists())
        with told(self.path):
            self.path.rename(aside)
        return aside

    def __enter__(self) -> "BagWriter":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    @contextmanager
    def _writing(self) -> Iterator[None]:
        if self._refusal:
            raise self._refusal
        try:
            yield
        except OSError as error:
            self._give_up(error)
            assert self._refusal is not None
            raise self._refusal from error

    def _give_up(self, error: OSError) -> None:
        """Leave the file as it was when it was last whole: half a chunk behind it helps nobody."""
        kept = f"; the {self._kept} messages recorded until then are kept" if self._kept and self._part else ""
        self._refusal = refused(self.path, error, kept)
        with suppress(OSError):  # a disk that refuses this too leaves a file that is cut off, which can be read
            os.ftruncate(self._stream.fileno(), self._whole)
        self._stream.raw.close()  # and not the stream, which would write what it still has in memory behind the end
