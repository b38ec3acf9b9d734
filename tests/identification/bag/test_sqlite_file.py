"""A database of a bag: read as the MCAP file of the same messages, and up to a cut."""

from pathlib import Path

import pytest
from motor_bags import SAMPLES, assert_is, rewritten, write_bag
from rosbags.rosbag2 import StoragePlugin

from motor_identification.bag import contents, messages, read_recording
from motor_identification.bag.sqlite_file import SqliteFile
from motor_model.errors import RecordingError


def test_a_cut_database_gives_what_it_can_or_a_sentence(tmp_path: Path) -> None:
    bag = rewritten(write_bag(tmp_path / "bag", SAMPLES), tmp_path / "sqlite", StoragePlugin.SQLITE3)
    file = next(bag.glob("*.db3"))
    file.write_bytes(file.read_bytes()[: int(0.6 * file.stat().st_size)])
    try:
        recording = read_recording(bag)
    except RecordingError as error:
        assert "cannot be read as a recording" in str(error)
    else:
        assert_is(recording, SAMPLES[: len(recording)])
        assert "cut off" in recording.notes[0]


def test_a_database_holds_what_the_mcap_file_holds(tmp_path: Path) -> None:
    plain = write_bag(tmp_path / "bag", SAMPLES[:200])
    file = SqliteFile(next(rewritten(plain, tmp_path / "other", StoragePlugin.SQLITE3).glob("*.db3")))
    stored = [(topic.name, log_time, data) for topic, log_time, data in file.messages()]
    assert stored == [(name, log_time, data) for name, _, log_time, data in messages(plain)] and not file.cut
    found, expected = file.contents(), contents(plain)
    assert found is not None and (found.span, found.message_count) == (expected.span, expected.message_count)
    assert {topic.name for topic, _, _ in file.messages({"/motor/info"})} == {"/motor/info"}
    assert list(file.messages({"/nothing"})) == []


def test_what_is_no_database_is_a_sentence(tmp_path: Path) -> None:
    (tmp_path / "bag.db3").write_bytes(b"not a database at all" * 100)
    file = SqliteFile(tmp_path / "bag.db3")
    assert file.contents() is None
    with pytest.raises(RecordingError, match="bag.db3 cannot be read as a recording"):
        list(file.messages())
