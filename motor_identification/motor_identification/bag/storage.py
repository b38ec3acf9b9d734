"""A bag as its files: which there are, in which order, and how each is opened."""

import re
from collections import Counter
from collections.abc import Callable, Container, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Protocol

from motor_identification.bag.compression import (
    COMPRESSED,
    decompress_file,
    decompress_message,
    is_compressed,
    plain_name,
)
from motor_identification.bag.contents import Contents, Span
from motor_identification.bag.mcap.file import McapFile
from motor_identification.bag.metadata import read_metadata
from motor_identification.bag.sqlite_file import SqliteFile
from motor_identification.bag.topic import Topic
from motor_model.errors import RecordingError
from motor_model.printable import escape
from motor_model.regular_file import Unfit, check_regular

Stored = tuple[Topic, int, bytes]  # topic, log time [ns], serialised message


class _File(Protocol):
    cut: bool
    damaged: int
    lost: int
    noted: dict[str, str]

    @property
    def topics(self) -> dict[int, Topic]: ...

    def messages(self, wanted: Container[str] | None = None) -> Iterator[Stored]: ...

    def contents(self) -> Contents | None: ...


ROS_1 = b"#ROSBAG V"  # what its bags begin with
OF_ROS_1 = "a bag of ROS 1: convert it (rosbags-convert, of the Python package rosbags), and give that"
_FORMATS: dict[str, Callable[[Path], _File]] = {".mcap": McapFile, ".db3": SqliteFile}


class Messages(Protocol):
    """What messages are read from: a bag, or what was just heard; see `Bag`."""

    uri: str
    cut: bool
    damaged: int
    lost: int
    garbled: int
    topics: dict[str, Topic]
    missing: list[str]

    def messages(self, wanted: Container[str] | None = None) -> Iterator[Stored]:
        """Messages of the wanted topics (None: of all)."""


class Bag:
    """A rosbag2 directory (with or without its metadata.yaml) or a single storage file.

    Raises:
        RecordingError: there is nothing at the path, it is not a bag, or nobody lets us read it.
    """

    def __init__(self, uri: str | Path) -> None:
        self.uri = escape(str(uri), longest=0)  # as it is shown
        self.cut = False  # after `messages`: a file ended before its end
        self.damaged = self.lost = 0  # after `messages`: places that cannot be read, and messages in them if counted
        self.garbled = 0  # messages that whoever decodes them has found to be none
        self._path = Path(uri)
        self.topics: dict[str, Topic] = {}  # after `messages`: all topics met, by name
        self.files = _files(Path(uri))
        self.missing = _missing(Path(uri), self.files)  # names of files that metadata.yaml knows and nobody has

    def messages(self, wanted: Container[str] | None = None) -> Iterator[Stored]:
        """Messages of the wanted topics (None: of all), file after file, each from its beginning to its end or cut."""
        self.damaged = self.lost = self.garbled = 0
        for path in self.files:
            with _opened(path) as file:
                for topic, log_time, data in file.messages(wanted):
                    yield topic, log_time, decompress_message(data) if is_compressed(data) else data
                self.cut |= file.cut
                self.damaged += file.damaged
                self.lost += file.lost
                self.topics.update({topic.name: topic for topic in file.topics.values()})

    def contents(self) -> Contents:
        """Topics, counts and times: from the files' indices where there are any, else by reading through the files."""
        contents = Contents()
        for path in self.files:
            contents = contents.joined(self.contents_of(path))
        noted = read_metadata(self._path).get("custom_data")
        return replace(contents, custom_data=noted) if isinstance(noted, dict) else contents

    def contents_of(self, path: Path) -> Contents:
        """The same of one of the files."""
        with _opened(path) as file:
            return file.contents() or _counted(file)

    @property
    def compressed(self) -> bool:
        """Whether its files or its messages are; chunks compressed inside a file do not count."""
        if any(path.suffix == COMPRESSED for path in self.files):
            return True
        for path in self.files:
            with _opened(path) as file:
                for _, _, data in file.messages():
                    return is_compressed(data)
        return False


def tell_damage(bag: Messages, uri: str, done: str = "used") -> str:
    """Return what a bag that was read has lost, and what was done with the rest; empty where nothing is."""
    if not (bag.damaged or bag.lost):
        return ""
    lost = f"{bag.lost} messages" if bag.lost else "some messages"
    return f"{uri} is damaged: {lost} cannot be read; what stands behind them is {done}."


def _files(path: Path) -> list[Path]:
    with _readable(path):
        if not path.exists():
            raise RecordingError(f"There is no bag {path}: check the path.")
        if not path.is_dir():
            check_regular(path)
        candidates = list(path.iterdir()) if path.is_dir() else [path]
    # Where a crash left a file beside the beginning of its compressed copy, the file itself comes later, and stays.
    compressed_first = sorted(filter(_is_storage, candidates), key=lambda file: file.suffix != COMPRESSED)
    found = {plain_name(file): file for file in compressed_first}
    if not found:
        if path.is_file() and _begins_with(path, ROS_1):
            raise RecordingError(f"{path} is {OF_ROS_1}.")
        inside = (
            "has no .mcap or .db3 file in it" if path.is_dir() else "is neither a directory nor a .mcap or .db3 file"
        )
        raise RecordingError(f"{path} is not a bag (it {inside}): give a bag made by record or ros2 bag.")
    return [found[name] for name in sorted(found, key=_by_number)]


def _begins_with(path: Path, magic: bytes) -> bool:
    with _readable(path), path.open("rb") as file:
        return file.read(len(magic)) == magic


def _is_storage(path: Path) -> bool:
    return path.is_file() and Path(plain_name(path)).suffix in _FORMATS


def _by_number(name: str) -> list[tuple[int, str]]:
    """bag_2 comes before bag_10."""
    return [(int(part), "") if part.isdecimal() else (-1, part) for part in re.split(r"(\d+)", name)]


def _missing(path: Path, files: list[Path]) -> list[str]:
    """Files that metadata.yaml lists and that are not there; the listing itself may be missing or damaged."""
    listed = read_metadata(path).get("relative_file_paths")
    there = {plain_name(file) for file in files}
    names = [Path(str(name)).name for name in (listed if isinstance(listed, list) else [])]
    return [name for name in names if name.removesuffix(COMPRESSED) not in there]


@contextmanager
def _readable(path: Path) -> Iterator[None]:
    try:
        yield
    except Unfit as error:
        raise RecordingError(str(error)) from error
    except OSError as error:
        raise RecordingError(
            f"{path} cannot be read ({error.strerror}): check its owner and permissions, and that its disk is mounted."
        ) from error


@contextmanager
def _opened(path: Path) -> Iterator[_File]:
    with _readable(path), decompress_file(path) as plain:
        yield _FORMATS[plain.suffix](plain)


def _counted(file: _File) -> Contents:
    """The contents of a file without an index, by reading all of it."""
    counts: Counter[str] = Counter()
    span: Span | None = None
    for topic, log_time, _ in file.messages():
        counts[topic.name] += 1
        span = (span or Span(log_time, log_time)).including(log_time)
    topics = tuple(replace(topic, message_count=counts[topic.name]) for topic in file.topics.values())
    return Contents(topics, span, file.cut, file.noted)
