"""A motor's messages, whatever their padding; and others than they claim to be."""

from dataclasses import replace
from pathlib import Path

from motor_bags import SAMPLES, assert_is, refusal, write_bag
from rclpy.serialization import serialize_message

from motor_identification.bag import BagWriter, read_recording
from motor_msgs.msg import MotorVoltage


def test_frame_ids_of_any_length_are_read_whatever_padding_they_cause(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES[:200], frame=lambda k: "wheel number seventeen"[: k % 20])
    assert_is(read_recording(bag), SAMPLES[:200])


def test_no_current_sensor_is_nan(tmp_path: Path) -> None:
    bare = [replace(sample, current=float("nan"), supply_voltage=float("nan")) for sample in SAMPLES[:10]]
    assert_is(read_recording(write_bag(tmp_path / "bag", bare)), bare)


def test_the_topic_of_another_type(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "other") as writer:
        channel = writer.topic("/motor/speed", "motor_msgs/msg/MotorVoltage")
        writer.write(channel, 1, serialize_message(MotorVoltage()))
    assert "motor_msgs/msg/MotorVoltage, not motor_msgs/msg/MotorSpeed" in refusal(tmp_path / "other")


def test_messages_that_are_not_what_they_say(tmp_path: Path) -> None:
    bad = [b"", b"\x00\x01\x00\x00" + bytes(30), b"\x07\x07" + bytes(90), b"\x00\x01" + b"\xff" * 90]
    for number, data in enumerate(bad):
        with BagWriter(tmp_path / f"bad{number}") as writer:
            writer.write(writer.topic("/motor/speed", "motor_msgs/msg/MotorSpeed"), 1, data)
        assert "cannot be read: a message" in refusal(tmp_path / f"bad{number}")
