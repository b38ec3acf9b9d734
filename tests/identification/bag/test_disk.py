"""A disk that refuses costs nothing that was written before; a missing metadata.yaml is written from the files."""

import os
import re
import resource
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import yaml
from mcap.reader import make_reader
from motor_bags import PERIOD, SAMPLES, START, assert_is, rewritten, write_bag
from rclpy.serialization import serialize_message
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import CompressionMode, Reader, StoragePlugin

from motor_identification.bag import BagWriter, contents, messages, read_recording, repair, topics
from motor_model.errors import RecordingError
from motor_ros.messages import speed_message, time_message

SPEED = "motor_msgs/msg/MotorSpeed"
NOBODY = 65534


@contextmanager
def files_up_to(size: int) -> Iterator[None]:
    """No file of this process may grow beyond so many bytes: the same error path as a full disk."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def fill(writer: BagWriter) -> int:
    """Write samples, flushing now and then as a recorder does; returns how many had been flushed at the refusal."""
    channel, flushed = writer.topic("/motor/speed", SPEED), 0
    for k, one in enumerate(SAMPLES):
        data = serialize_message(speed_message(one, time_message(START + k * PERIOD), "wheel"))
        writer.write(channel, START + k * PERIOD, data)
        if k % 100 == 99:
            writer.flush()
            flushed = k + 1
    return flushed


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
    tmp_path.chmod(0o555)
    user = os.geteuid()
    if user == 0:
        os.seteuid(NOBODY)
    try:
        with pytest.raises(RecordingError, match=r"\(Permission denied\): choose a place that you may write to\."):
            BagWriter(tmp_path / "other")
        with pytest.raises(RecordingError, match=r"cannot be read \(Permission denied\): check its owner"):
            read_recording(bag)
    finally:
        os.seteuid(user)
        tmp_path.chmod(0o755)
    assert [path.name for path in tmp_path.iterdir()] == ["bag"]


def test_what_was_noted_stands_in_file_and_metadata_and_survives_a_crash(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        writer.note("experiment", {"profile": "step", "voltage": "6.0"})
        fill(writer)
    noted = {"experiment.profile": "step", "experiment.voltage": "6.0"}
    assert contents(tmp_path / "bag").custom_data == noted
    content = yaml.safe_load((tmp_path / "bag/metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert content["custom_data"] == noted
    (tmp_path / "bag/metadata.yaml").unlink()
    assert contents(tmp_path / "bag").custom_data == noted
    file = tmp_path / "bag/bag_0.mcap"
    with file.open("rb") as stream:
        records = {record.name: record.metadata for record in make_reader(stream).iter_metadata()}
    assert records["experiment"] == {"profile": "step", "voltage": "6.0"}
    file.write_bytes(file.read_bytes()[:10_000])
    assert contents(tmp_path / "bag").custom_data == noted and contents(tmp_path / "bag").cut
    with BagWriter(tmp_path / "plain") as writer:
        writer.write(writer.topic("/motor/speed", SPEED), START, b"\x00\x01\x00\x00")
    assert contents(tmp_path / "plain").custom_data == {}


def test_the_metadata_of_a_whole_bag_is_written_as_it_was(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES)
    assert not repair(bag)
    text = (bag / "metadata.yaml").read_text()
    (bag / "metadata.yaml").unlink()
    assert repair(bag) and (bag / "metadata.yaml").read_text() == text
    assert not repair(bag)


def test_a_database_gets_its_metadata_too(tmp_path: Path) -> None:
    bag = rewritten(write_bag(tmp_path / "bag", SAMPLES[:50]), tmp_path / "other", StoragePlugin.SQLITE3)
    (bag / "metadata.yaml").unlink()
    assert repair(bag)
    with Reader(bag) as reader:
        assert reader.message_count == 51 and len(list(reader.messages())) == 51
    content = yaml.safe_load((bag / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert content["storage_identifier"] == "sqlite3" and content["relative_file_paths"] == ["other.db3"]


@pytest.mark.parametrize("compression", [CompressionMode.FILE, CompressionMode.MESSAGE])
def test_a_compressed_bag_is_left_alone(tmp_path: Path, compression: CompressionMode) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES[:50])
    other = rewritten(bag, tmp_path / "other", StoragePlugin.SQLITE3, compression)
    (other / "metadata.yaml").unlink()
    assert not repair(other) and not (other / "metadata.yaml").exists()


def test_a_bag_that_is_being_recorded_is_left_alone(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        fill(writer)
        assert not repair(tmp_path / "bag") and not (tmp_path / "bag/metadata.yaml").exists()
    assert not repair(next((tmp_path / "bag").glob("*.mcap")))  # a single file has none


def test_a_topic_without_qos_has_an_empty_list_of_them(tmp_path: Path) -> None:
    """As rosbag2 writes it."""
    with BagWriter(tmp_path / "bag") as writer:
        writer.write(writer.topic("/motor/speed", SPEED), START, b"\x00\x01\x00\x00")
    with next((tmp_path / "bag").glob("*.mcap")).open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    assert [channel.metadata["offered_qos_profiles"] for channel in summary.channels.values()] == ["[]"]
    assert topics(tmp_path / "bag")[0].qos == ()
    with AnyReader([tmp_path / "bag"]) as reader:
        assert reader.message_count == 1


def chunk_at(file: bytes) -> int:
    """Where the content of the first chunk begins: start, end, size [8 bytes each], CRC [4], compression, data."""
    position = 8
    while file[position] != 6:
        position += 9 + int.from_bytes(file[position + 1 : position + 9], "little")
    return position + 9


@pytest.mark.parametrize("damage", ["size", "length", "huge length"])
def test_nothing_is_taken_from_a_chunk_that_contradicts_itself(tmp_path: Path, damage: str) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES[:200])
    file = next(bag.glob("*.mcap"))
    content = bytearray(file.read_bytes())
    chunk = chunk_at(content)
    place, value = {
        "size": (chunk + 16, 10**6),
        "length": (chunk + 36, 2**20),
        "huge length": (chunk + 36, 2**63 + 5),
    }[damage]
    assert content[chunk + 32 : chunk + 36] == b"zstd"
    content[place : place + 8] = value.to_bytes(8, "little")
    shutil.rmtree(bag)
    (tmp_path / "damaged.mcap").write_bytes(content)
    if damage == "length":  # more than there is: what there is checks out
        assert len(list(messages(tmp_path / "damaged.mcap"))) == 201
    else:
        assert list(messages(tmp_path / "damaged.mcap")) == []
