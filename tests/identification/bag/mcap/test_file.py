"""A bag that a crash cut off is read up to the cut; a damaged one never further than it can be trusted."""

import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import motor_bags
import numpy as np
import pytest
import zstandard
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from motor_bags import SAMPLES, assert_is, refusal, rewritten, write_bag
from rosbags.rosbag2 import StoragePlugin

from motor_identification.bag import contents, messages, read_recording, writer
from motor_model.errors import RecordingError

WRITER = """
import sys, time
import motor_bags
from motor_bags import PERIOD, SAMPLES, START
from motor_identification.bag import BagWriter
from motor_ros.messages import speed_message, time_message
from rclpy.serialization import serialize_message
writer = BagWriter(sys.argv[1])
channel = writer.topic("/motor/speed", "motor_msgs/msg/MotorSpeed")
begin = time.monotonic()
for k, sample in enumerate(SAMPLES):
    time.sleep(max(0.0, begin + k * 1e-9 * PERIOD - time.monotonic()))
    stamp = time_message(START + k * PERIOD)
    writer.write(channel, START + k * PERIOD, serialize_message(speed_message(sample, stamp, "wheel")))
    print(k + 1, flush=True)
"""


def cut(bag: Path, size: int) -> Path:
    """The bag with only so many bytes, and without the metadata.yaml that a crash leaves unwritten."""
    (bag / "metadata.yaml").unlink(missing_ok=True)
    file = next(bag.glob("*.mcap"))
    file.write_bytes(file.read_bytes()[:size])
    return bag


def size_of(bag: Path) -> int:
    return next(bag.glob("*.mcap")).stat().st_size


def test_a_bag_cut_at_60_percent_gives_its_first_part_and_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All of it in one chunk, however long a busy machine takes to write it."""
    monkeypatch.setattr(writer, "FLUSH_EVERY", np.inf)
    bag = write_bag(tmp_path / "bag", SAMPLES)
    recording = read_recording(cut(bag, int(0.6 * size_of(bag))))
    count = len(recording)
    assert 700 < count < 1400
    assert_is(recording, SAMPLES[:count])
    (note,) = recording.notes
    assert note == f"{bag} is cut off: {count} samples, {recording.duration:.2f} s up to the cut."


def test_an_uncompressed_bag_loses_only_what_is_cut(tmp_path: Path) -> None:
    bag = rewritten(write_bag(tmp_path / "bag", SAMPLES), tmp_path / "plain", StoragePlugin.MCAP)
    size = size_of(bag)
    assert len(read_recording(cut(bag, size - 100))) == 2000  # in the index: no sample is lost
    for lost in (30_000, 30_001, 30_100):  # a message takes 31 bytes of record, 92 of CDR, 16 in the index
        count = len(read_recording(cut(bag, size - 40_000 - lost)))
        assert 2000 - (40_000 + lost) / 123 < count < 2000 - (lost - 2_000) / 123
    assert_is(read_recording(bag), SAMPLES[:count])


def test_wherever_it_is_cut_there_is_a_prefix_or_a_sentence(tmp_path: Path) -> None:
    whole = write_bag(tmp_path / "bag", SAMPLES[:400])
    size, before = size_of(whole), 0
    for k in range(100):
        bag = cut(Path(shutil.copytree(whole, tmp_path / f"cut{k}")), size * k // 100)
        try:
            recording = read_recording(bag)
        except RecordingError as error:
            assert re.search("empty bag|cut off before the first sample|holds 1 samples", str(error)), error
            assert before == 0
            continue
        assert_is(recording, SAMPLES[: len(recording)])
        assert len(recording) >= before
        before = len(recording)
        assert contents(bag).message_count == before + 1  # and the info
        if before < 400:  # behind the last sample there is only the index
            assert contents(bag).cut and "cut off" in recording.notes[0] and len(recording.notes) == 1
    assert before == 400


def test_a_bag_cut_before_the_first_sample(tmp_path: Path) -> None:
    assert "cut off before the first sample" in refusal(cut(write_bag(tmp_path / "bag", SAMPLES), 200))


def test_a_compressed_file_that_is_cut(tmp_path: Path) -> None:
    bag = rewritten(write_bag(tmp_path / "bag", SAMPLES), tmp_path / "plain", StoragePlugin.MCAP)
    file = next(bag.glob("*.mcap"))
    packed = zstandard.compress(file.read_bytes())
    (tmp_path / "packed.mcap.zstd").write_bytes(packed[: int(0.7 * len(packed))])
    recording = read_recording(tmp_path / "packed.mcap.zstd")
    assert 500 < len(recording) < 2000
    assert_is(recording, SAMPLES[: len(recording)])
    assert "cut off" in recording.notes[0]


@pytest.fixture(scope="module")
def whole_file(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    bag = write_bag(tmp_path_factory.mktemp("whole") / "bag", SAMPLES[:200])
    return next(bag.glob("*.mcap")).read_bytes()


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_a_damaged_file_gives_no_false_sample(tmp_path: Path, whole_file: bytes, data: st.DataObject) -> None:
    damaged = bytearray(whole_file)
    for _ in range(data.draw(st.integers(1, 3))):
        damaged[data.draw(st.integers(8, len(damaged) - 1))] ^= data.draw(st.integers(1, 255))
    file = tmp_path / "damaged.mcap"
    file.write_bytes(damaged)
    try:
        recording = read_recording(file)
    except RecordingError:
        return
    assert_is(recording, SAMPLES[: len(recording)])


def test_a_killed_writer_loses_at_most_a_second(tmp_path: Path) -> None:
    writer = subprocess.Popen(
        [sys.executable, "-c", WRITER, str(tmp_path / "killed")],
        cwd=Path(motor_bags.__file__).parent,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert writer.stdout is not None
    written = 0
    while written < 450:  # 2.25 s
        written = int(writer.stdout.readline())
    writer.send_signal(signal.SIGKILL)
    written = max([written, *map(int, writer.stdout.read().split())])
    writer.wait()
    recording = read_recording(tmp_path / "killed")
    assert_is(recording, SAMPLES[: len(recording)])
    assert written - 200 <= len(recording) <= written
    assert np.all(np.diff([row[2] for row in messages(tmp_path / "killed")]) > 0)
    assert "cut off" in recording.notes[0]


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
