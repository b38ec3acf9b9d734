"""Where a bag has no samples of the motor, a sentence says so, and where there are some."""

from pathlib import Path

from motor_bags import SAMPLES, refusal, write_bag
from rclpy.serialization import serialize_message
from rosbags.rosbag2 import StoragePlugin, Writer

from motor_identification.bag import BagWriter, read_recording
from motor_msgs.msg import MotorSpeed, MotorVoltage


def test_an_empty_bag(tmp_path: Path) -> None:
    BagWriter(tmp_path / "empty").close()
    assert "empty bag" in refusal(tmp_path / "empty")
    with Writer(tmp_path / "empty3", version=9, storage_plugin=StoragePlugin.SQLITE3):
        pass
    assert "empty bag" in refusal(tmp_path / "empty3")


def test_no_motor_in_the_bag(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "other") as writer:
        for k in range(12):
            channel = writer.topic(f"/topic{k:02}", "motor_msgs/msg/MotorVoltage")
            writer.write(channel, 1, serialize_message(MotorVoltage()))
    sentence = refusal(tmp_path / "other")
    assert "has no /motor/speed" in sentence and "/topic00, " in sentence and "and 2 more" in sentence
    assert "--topic-namespace" not in sentence


def test_the_motor_is_in_another_namespace(tmp_path: Path) -> None:
    far = write_bag(tmp_path / "far", SAMPLES[:200], "/left/wheel")
    recording = read_recording(far)  # nobody has said which: there is only one
    assert len(recording) == 200
    assert recording.notes == (f"{far} has one motor, in the namespace /left/wheel: that one is used.",)
    assert read_recording(far, "left/wheel").notes == ()
    for asked in ("right", "/"):
        assert "say --topic-namespace /left/wheel." in refusal(far, asked)
    assert "say --topic-namespace /." in refusal(write_bag(tmp_path / "here", SAMPLES[:20]), "right")


def test_one_of_two_motors_has_to_be_named(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "two") as writer:
        for namespace in ("left", "right"):
            channel = writer.topic(f"/{namespace}/motor/speed", "motor_msgs/msg/MotorSpeed")
            writer.write(channel, 1, serialize_message(MotorSpeed()))
    assert "say --topic-namespace /left or --topic-namespace /right." in refusal(tmp_path / "two")
