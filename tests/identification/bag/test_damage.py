"""Damaged and made-up bags: what is whole is used, the rest is counted, and nothing floods or blocks the reader."""

import os
import sqlite3
from pathlib import Path

import pytest
import zstandard
from motor_bags import COLUMNS, INFO, SAMPLES, START, refusal, rewritten, write_bag
from rclpy.serialization import serialize_message
from rosbags.rosbag2 import StoragePlugin

from motor_identification.bag import BagWriter, messages, read_recording
from motor_identification.bag.mcap.summary import read_summary
from motor_identification.recording import Recording
from motor_model.errors import MotorError
from motor_ros.messages import info_message, speed_message, time_message

CHUNK = 200  # samples


@pytest.fixture(scope="module")
def bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_bag(tmp_path_factory.mktemp("whole") / "bag", SAMPLES, chunk=CHUNK)


def begins(data: bytes, path: Path) -> list[int]:
    """Where the chunks begin."""
    with path.open("rb") as stream:
        summary = read_summary(stream, len(data))
    assert summary is not None
    return sorted(chunk.chunk_start_offset for chunk in summary.chunks)


def flipped(bag: Path, to: Path, chunk: int, offset: int) -> Recording:
    """What is read of the bag with one bit of a chunk's record flipped."""
    (file,) = bag.glob("*.mcap")
    data = bytearray(file.read_bytes())
    data[begins(bytes(data), file)[chunk] + offset] ^= 1
    to.write_bytes(data)
    return read_recording(to)


def assert_are_samples(recording: Recording) -> None:
    """Every sample is one that was recorded, bit for bit."""
    by_time = {one.sample_time: one for one in SAMPLES}
    for k, time in enumerate(recording.sample_time):
        assert [getattr(recording, name)[k] for name in COLUMNS] == [getattr(by_time[time], name) for name in COLUMNS]


@pytest.mark.parametrize("chunk", [0, 1, 5, -1])
@pytest.mark.parametrize("offset", [0, 1, 5, 25, 33, 34, 60, 200])  # opcode, length, size, CRC, name, data
def test_one_flipped_bit_costs_one_chunk(bag: Path, tmp_path: Path, chunk: int, offset: int) -> None:
    recording = flipped(bag, tmp_path / "flipped.mcap", chunk, offset)
    assert len(SAMPLES) - CHUNK - 1 <= len(recording) <= len(SAMPLES)
    assert_are_samples(recording)
    said = [note for note in recording.notes if "is damaged: " in note]
    assert len(said) == 1 if len(recording) < len(SAMPLES) else len(said) <= 1
    if said:
        assert said[0].endswith("cannot be read; what stands behind them is used.")


def test_how_much_was_lost_is_said(bag: Path, tmp_path: Path) -> None:
    heard: list[str] = []
    whole = len(list(messages(bag, None, heard.append)))
    assert heard == []
    recording = flipped(bag, tmp_path / "flipped.mcap", 3, 100)
    (note,) = recording.notes
    assert len(recording) == len(SAMPLES) - CHUNK
    assert note == f"{tmp_path / 'flipped.mcap'} is damaged: 200 messages cannot be read; " + (
        "what stands behind them is used."
    )
    assert len(list(messages(tmp_path / "flipped.mcap", None, heard.append))) == whole - CHUNK
    assert heard == [note.replace(" used.", " read.")]


def test_a_garbled_message_costs_itself(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        channel = writer.topic("/motor/speed", "motor_msgs/msg/MotorSpeed")
        for k, sample in enumerate(SAMPLES[:100]):
            data = serialize_message(speed_message(sample, time_message(START), "wheel"))
            garbled = {7: data[:30], 8: b"", 9: data[:12] + b"\xff" * 4 + data[16:], 10: b"\7\7" + data[2:]}
            writer.write(channel, START + k, garbled.get(k, data))
    recording = read_recording(tmp_path / "bag")
    assert len(recording) == 96 and f"{tmp_path / 'bag'}: 4 messages are garbled and were left out." in recording.notes


def test_three_thousand_infos_that_differ_in_their_stamps_are_one(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        speeds = writer.topic("/motor/speed", "motor_msgs/msg/MotorSpeed")
        infos = writer.topic("/motor/info", "motor_msgs/msg/MotorInfo")
        for k in range(3000):
            writer.write(infos, START + k, serialize_message(info_message(INFO, time_message(START + k))))
            writer.write(speeds, START + k, serialize_message(speed_message(SAMPLES[k % 2000], time_message(k), "")))
            if k == 1999:
                break
        for k in range(2000, 3000):
            writer.write(infos, START + k, serialize_message(info_message(INFO, time_message(START + k))))
    recording = read_recording(tmp_path / "bag")
    assert recording.info == INFO and recording.notes == ()


@pytest.mark.parametrize("name", ["bomb.mcap.zstd", "bomb.db3.zstd"])
def test_a_file_that_unpacks_without_end_is_refused(tmp_path: Path, name: str) -> None:
    compressor = zstandard.ZstdCompressor().compressobj()
    zeros = bytes(1 << 20)
    parts = [compressor.compress(zeros) for _ in range(200)]
    (tmp_path / name).write_bytes(b"".join(parts) + compressor.flush())
    assert "unpacks to more than" in refusal(tmp_path / name)


@pytest.mark.parametrize("name", ["pipe.mcap", "pipe.db3", "pipe.mcap.zstd"])
def test_a_pipe_and_a_device_are_no_bags(tmp_path: Path, name: str) -> None:
    os.mkfifo(tmp_path / name)
    assert "is no regular file" in refusal(tmp_path / name)
    (tmp_path / "bag").mkdir()
    (tmp_path / "bag" / name).symlink_to("/dev/zero")
    assert "is not a bag" in refusal(tmp_path / "bag")


PROGRAMS = [
    "DROP TABLE messages; CREATE VIEW messages AS WITH RECURSIVE c(id, topic_id, timestamp, data) AS "
    "(SELECT 1, 1, 1, x'00' UNION ALL SELECT id + 1, 1, id, x'00' FROM c) SELECT * FROM c",
    "CREATE TRIGGER t AFTER INSERT ON messages BEGIN SELECT 1; END",
    "ALTER TABLE messages ADD COLUMN more BLOB GENERATED ALWAYS AS (zeroblob(1000000000))",
    "UPDATE topics SET offered_qos_profiles = '" + "[" * 5000 + "'",
    "UPDATE topics SET offered_qos_profiles = 'a: &a [1]\nb: *a'",
]


@pytest.mark.parametrize("program", PROGRAMS)
def test_a_database_with_programs_in_it_is_refused(tmp_path: Path, program: str) -> None:
    made = rewritten(write_bag(tmp_path / "bag", SAMPLES[:50]), tmp_path / "sql", StoragePlugin.SQLITE3)
    (file,) = made.glob("*.db3")
    connection = sqlite3.connect(file)
    connection.executescript(program)
    connection.close()
    assert "cannot be read as a recording" in refusal(file)


@pytest.mark.parametrize("value", [1e-9, 0.0, float("nan"), 1e9])
def test_a_sample_period_that_no_plant_has_is_refused(tmp_path: Path, value: float) -> None:
    message = info_message(INFO, time_message(0))
    message.sample_period = value
    with BagWriter(tmp_path / "bag") as writer:
        speeds = writer.topic("/motor/speed", "motor_msgs/msg/MotorSpeed")
        infos = writer.topic("/motor/info", "motor_msgs/msg/MotorInfo")
        writer.write(infos, START, serialize_message(message))
        writer.write(speeds, START, serialize_message(speed_message(SAMPLES[0], time_message(0), "")))
    with pytest.raises(MotorError, match="motor/info says sample_period .*: it must be from 1e-06 to 100"):
        read_recording(tmp_path / "bag")
