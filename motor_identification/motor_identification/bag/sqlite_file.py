"""One sqlite3 file of a bag, read by `rosbags`."""

from collections.abc import Container, Iterator
from pathlib import Path

import apsw
from rosbags.interfaces import Connection, ConnectionExtRosbag2, MessageDefinitionFormat
from rosbags.rosbag2 import Reader, ReaderError

from motor_identification.bag.contents import Contents, Span
from motor_identification.bag.topic import Topic, from_stored
from motor_model import yaml_file
from motor_model.errors import RecordingError
from motor_model.regular_file import check_regular

_PROGRAMS = ("VIRTUAL TABLE", "GENERATED", " AS ")
# What `rosbags` raises where rows are not what their columns say.
_DAMAGE = (
    ReaderError, apsw.Error, ValueError, TypeError, KeyError, AttributeError, RuntimeError, OverflowError, IndexError,
    MemoryError, AssertionError,
)  # fmt: skip
Stored = tuple[Topic, int, bytes]  # topic, log time [ns], serialised message


class SqliteFile:
    """A file of a bag. After `messages` has come to its end, `topics` is complete and `cut` says whether it was."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.cut = True  # until the last row has been read
        self.damaged = self.lost = 0  # rows cannot be skipped
        self.topics: dict[int, Topic] = {}  # by connection
        self.noted: dict[str, str] = {}  # nothing: what a recorder noted stands in metadata.yaml

    def messages(self, wanted: Container[str] | None = None) -> Iterator[Stored]:
        """Messages of the wanted topics (None: of all) in the order of their log times.

        Raises:
            RecordingError: this is not a bag's database, or it is damaged from the start.
        """
        check_regular(self.path)
        try:
            _check(self.path)
            with Reader(self.path) as reader:
                self.topics = {connection.id: _topic(connection) for connection in reader.connections}
                chosen = [row for row in reader.connections if wanted is None or row.topic in wanted]
                # No connections would mean all of them to `rosbags`.
                for connection, log_time, data in reader.messages(chosen) if chosen else ():
                    yield self.topics[connection.id], log_time, bytes(data)
                self.cut = False
        except _DAMAGE as error:
            if not self.topics:
                raise _unreadable(self.path, error) from error

    def contents(self) -> Contents | None:
        """What the database says is in it; None where it is damaged."""
        check_regular(self.path)
        try:
            _check(self.path)
            with Reader(self.path) as reader:
                span = Span(reader.start_time, reader.end_time - 1) if reader.message_count else None
                return Contents(tuple(_topic(connection) for connection in reader.connections), span)
        except _DAMAGE:
            return None


def _quoted(path: Path) -> str:
    """A path inside of a URI."""
    text = str(path.absolute())
    for character in "%?#":
        text = text.replace(character, f"%{ord(character):02x}")
    return text


def _check(path: Path) -> None:
    """Refuse what no recorder makes: a database can have programs in it, and texts that stand for gigabytes.

    Raises:
        ReaderError: it has some.
        apsw.Error: it is no database.
    """
    place = f"file:{_quoted(path)}?mode=ro&immutable=1"
    connection = apsw.Connection(place, flags=apsw.SQLITE_OPEN_READONLY | apsw.SQLITE_OPEN_URI)
    try:
        for kind, text in connection.execute("SELECT type, sql FROM sqlite_master"):
            words = str(text or "").upper()
            if kind not in ("table", "index") or any(word in words for word in _PROGRAMS):
                raise ReaderError("it has views, triggers or computed columns")
        columns = [row[1] for row in connection.execute("SELECT * FROM pragma_table_info('topics')")]
        if "offered_qos_profiles" in columns:
            for (profiles,) in connection.execute("SELECT offered_qos_profiles FROM topics"):
                yaml_file.parse(str(profiles))
    except yaml_file.NotYaml as error:
        raise ReaderError(f"a QoS in it {error}") from error
    finally:
        connection.close()


def _topic(connection: Connection) -> Topic:
    definition = connection.msgdef.data if connection.msgdef.format == MessageDefinitionFormat.MSG else ""
    profiles = connection.ext.offered_qos_profiles if isinstance(connection.ext, ConnectionExtRosbag2) else []
    return Topic(
        connection.topic, connection.msgtype, definition, from_stored(profiles), connection.msgcount, connection.digest
    )


def _unreadable(path: Path, error: Exception) -> RecordingError:
    return RecordingError(
        f"{path} cannot be read as a recording ({error}): record it again, or restore it from a copy."
    )
