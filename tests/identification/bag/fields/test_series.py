"""Fields over the time of a bag, of any storage."""

from pathlib import Path

import foreign_bags
import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin

from motor_identification.bag import BagWriter
from motor_identification.bag.fields import parse_path, read_fields, sample_topics
from motor_model.errors import RecordingError

MOTION = foreign_bags.move(2.0)
START = 1_760_000_000_000_000_000


@pytest.mark.parametrize("storage", list(StoragePlugin))
def test_stamps_arrivals_and_values(tmp_path: Path, storage: StoragePlugin) -> None:
    foreign_bags.write_joint_states(tmp_path / "bag", MOTION, storage)
    paths = [parse_path("/joint_states:position[right_wheel]"), parse_path("/wheels/commands:data[1]")]
    angle, command = read_fields(tmp_path / "bag", paths)
    assert angle.values == pytest.approx(MOTION.angle) and angle.has_header and not command.has_header
    assert np.array_equal(angle.stamp, START + np.rint(MOTION.time * 1e9).astype(np.int64))
    late = angle.received - angle.stamp
    assert late.min() >= 2e5 and late.max() <= 6e5 and np.array_equal(command.stamp, command.received)
    assert command.values == pytest.approx(MOTION.voltage[::4] / 12.0)


def test_what_is_not_there_is_told_with_what_is(tmp_path: Path) -> None:
    foreign_bags.write_driver_states(tmp_path / "bag", MOTION)
    for path, complaint in (
        ("/nothing:data", "has no number at /nothing:data: it has the topics /driver"),
        ("/driver:wheels[up].duty", r"has no number at /driver:wheels\[up\].duty: /driver has wheels\[left\].duty, "),
    ):
        with pytest.raises(RecordingError, match=complaint):
            read_fields(tmp_path / "bag", [parse_path(path)])


def test_garbled_messages_are_left_out_and_counted(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        topic = writer.topic("/speed", "std_msgs/msg/Float64")
        for k in range(10):
            data = b"\0\1\0\0" + (b"bad" if k in (3, 7) else np.float64(k).tobytes())
            writer.write(topic, START + k, data)
    (series,) = read_fields(tmp_path / "bag", [parse_path("/speed:data")])
    assert series.garbled == 2 and series.values.tolist() == [0, 1, 2, 4, 5, 6, 8, 9]
    with BagWriter(tmp_path / "bad") as writer:
        topic = writer.topic("/speed", "std_msgs/msg/Float64")
        writer.write(topic, START, b"\0\1\0\0")
    with pytest.raises(RecordingError, match="none of the 1 messages on /speed can be decoded"):
        read_fields(tmp_path / "bad", [parse_path("/speed:data")])


def test_samples_of_every_topic(tmp_path: Path) -> None:
    foreign_bags.write_joint_states(tmp_path / "bag", MOTION)
    states, commands = sample_topics(tmp_path / "bag", 50)
    assert (states.topic.name, len(states.received), len(states.messages)) == ("/joint_states", 400, 50)
    assert (len(commands.received), commands.stamps[0], commands.trouble) == (100, 0, "")
