"""A disk that refuses costs nothing that was written before; a missing metadata.yaml is written from the files."""

import re
import resource
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from motor_bags import SAMPLES, START, assert_is, fill, write_bag
from read_only import read_only

from motor_identification.bag import BagWriter, contents, read_recording, repair
from motor_model.errors import RecordingError


@contextmanager
def files_up_to(size: int) -> Iterator[None]:
    """No file of this process may grow beyond so many bytes: the same error path as a full disk."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@pytest.mark.parametrize("size", [20_000, 20_100, 37_777])
def test_a_full_disk_keeps_all_that_was_flushed(tmp_path: Path, size: int) -> None:
    writer = BagWriter(tmp_path / "bag")
    with files_up_to(size), pytest.raises(RecordingError) as refusal:
        fill(writer)
    said = re.fullmatch(
        rf"{tmp_path}/bag cannot be written \(File too large\): make room, or choose another place; "
        r"the (\d+) messages recorded until then are kept\.",
        str(refusal.value),
    )
    assert said
    kept = int(said[1])
    assert 100 <= kept < 2000 and kept % 100 == 0
    with pytest.raises(RecordingError) as again:  # there is room now, and still nothing may follow what is missing
        writer.write(1, START, b"")
    assert str(again.value) == str(refusal.value)
    writer.close()
    recording = read_recording(tmp_path / "bag")
    assert_is(recording, SAMPLES[:kept])
    assert "cut off" in recording.notes[0]
    assert not (tmp_path / "bag/metadata.yaml").exists() and repair(tmp_path / "bag")
    assert contents(tmp_path / "bag").message_count == kept


def test_of_a_bag_that_can_be_written_anew_none_is_said_to_be_kept(tmp_path: Path) -> None:
    """As of an import, or a simulation: what was begun is taken away."""
    writer = BagWriter(tmp_path / "bag", part=False)
    with files_up_to(20_000), pytest.raises(RecordingError, match=r"make room, or choose another place\.$"):
        fill(writer)
    writer.discard()
    assert not (tmp_path / "bag").exists()


def test_a_full_disk_at_the_end_keeps_everything(tmp_path: Path) -> None:
    size = next(write_bag(tmp_path / "whole", SAMPLES).glob("*.mcap")).stat().st_size
    writer = BagWriter(tmp_path / "bag")
    assert fill(writer) == 2000
    with files_up_to(size // 2), pytest.raises(RecordingError, match="the 2000 messages recorded until then are kept"):
        writer.close()
    assert_is(read_recording(tmp_path / "bag"), SAMPLES)


def test_a_place_that_is_not_ours_is_a_sentence(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES[:10])
    next(bag.glob("*.mcap")).chmod(0)
    with read_only(tmp_path):
        with pytest.raises(RecordingError, match=r"\(Permission denied\): choose a place that you may write to\."):
            BagWriter(tmp_path / "other")
        with pytest.raises(RecordingError, match=r"cannot be read \(Permission denied\): check its owner"):
            read_recording(bag)
    assert [path.name for path in tmp_path.iterdir()] == ["bag"]
