"""`ros2 bag`: what a bag holds, and how recording and playing are handed on."""

import os
import re

import pytest

from motor_identification.bag import BagWriter

METADATA = """\
rosbag2_bagfile_information:
  version: 9
  storage_identifier: mcap
  duration: {nanoseconds: 61000000005}
  starting_time: {nanoseconds_since_epoch: 1762338062000000123}
  message_count: 12201
  topics_with_message_count:
    - topic_metadata: {name: /motor/speed, type: motor_msgs/msg/MotorSpeed, serialization_format: cdr}
      message_count: 12200
    - topic_metadata: {name: /motor/info, type: motor_msgs/msg/MotorInfo, serialization_format: cdr}
      message_count: 1
  relative_file_paths: [run_0.mcap, run_1.mcap]
  ros_distro: jazzy
"""

INFO = """
Files:             run_0.mcap
                   run_1.mcap
Bag size:          3.0 KiB
Storage id:        mcap
ROS Distro:        jazzy
Duration:          61.000000005s
Start:             Nov  5 2025 10:21:02.000000123 (1762338062.000000123)
End:               Nov  5 2025 10:22:03.000000128 (1762338123.000000128)
Messages:          12201
Topic information: Topic: /motor/speed | Type: motor_msgs/msg/MotorSpeed | Count: 12200 | Serialization Format: cdr
                   Topic: /motor/info | Type: motor_msgs/msg/MotorInfo | Count: 1 | Serialization Format: cdr
Service:           0
Service information: 
"""  # noqa: W291


@pytest.fixture
def bag(tmp_path):
    folder = tmp_path / "run"
    folder.mkdir()
    (folder / "metadata.yaml").write_text(METADATA)
    (folder / "run_0.mcap").write_bytes(bytes(3072 - len(METADATA)))
    return folder


def test_info_prints_what_the_real_command_prints(ros2, bag):
    assert ros2("bag", "info", str(bag)).out == INFO
    assert ros2("bag", "info", "-t", str(bag)).out == "/motor/speed\n/motor/info\n"


def test_info_of_an_empty_bag_of_an_older_ros(ros2, bag):
    text = re.sub(
        r"topics_with_message_count:.*\n(?=  relative)", "topics_with_message_count: []\n", METADATA, flags=re.S
    )
    (bag / "metadata.yaml").write_text(text.replace("  ros_distro: jazzy\n", ""))
    out = ros2("bag", "info", str(bag)).out
    assert "\nROS Distro:        unknown\n" in out
    assert "\nTopic information: \nService:           0\n" in out


def test_info_without_metadata_is_a_sentence(ros2, bag, tmp_path):
    (bag / "metadata.yaml").unlink()
    assert ros2("bag", "info", str(bag), status=1).err == (
        f"{bag} has no metadata.yaml: it is not a bag, or was cut off; then `ros2 bag reindex {bag}` helps.\n"
    )
    assert ros2("bag", "info", str(tmp_path / "no"), status=1).err == f"Bag path '{tmp_path / 'no'}' does not exist!\n"


def test_reindex_writes_what_a_crash_left_unwritten(ros2, tmp_path):
    bag = tmp_path / "run"
    with BagWriter(bag) as writer:
        writer.write(writer.topic("/motor/speed", "motor_msgs/msg/MotorSpeed"), 10**18, b"\x00\x01\x00\x00")
    before = ros2("bag", "info", str(bag)).out
    (bag / "metadata.yaml").unlink()
    assert ros2("bag", "reindex", str(bag)).out == f"{bag}: metadata.yaml written.\n"
    assert ros2("bag", "info", str(bag)).out == before and "Count: 1 |" in before
    assert "needs no repair" in ros2("bag", "reindex", "-s", "mcap", str(bag)).out
    assert ros2("bag", "reindex", str(tmp_path / "no"), status=1).err == "Must specify a bag directory\n"


@pytest.mark.parametrize("text", ["", "a: [", "rosbag2_bagfile_information: 5", METADATA.replace("  duration", "  d")])
def test_info_of_broken_metadata_is_a_sentence(ros2, bag, text):
    (bag / "metadata.yaml").write_text(text)
    assert str(bag / "metadata.yaml") in ros2("bag", "info", str(bag), status=1).err


@pytest.fixture
def handed_on(ros2, tmp_path):
    """`ros2`, with a motor_identification whose record and play print their arguments."""
    marker = tmp_path / "share/ament_index/resource_index/packages/motor_identification"
    marker.parent.mkdir(parents=True)
    marker.touch()
    for name in ("record", "play"):
        program = tmp_path / "lib/motor_identification" / name
        program.parent.mkdir(parents=True, exist_ok=True)
        program.write_text(f'#!/bin/sh\necho {name} "$@"\n')
        program.chmod(0o755)
    ros2.env["AMENT_PREFIX_PATH"] = f"{tmp_path}{os.pathsep}{ros2.env['AMENT_PREFIX_PATH']}"
    return ros2


@pytest.mark.parametrize(
    ("words", "command"),
    [
        ("record -o run /motor/speed /motor/info", "record run /motor/speed /motor/info"),
        ("record -s mcap --output run --topics /motor/speed", "record run /motor/speed"),
        ("record -a -o run", "record run --all"),
        ("play run", "play run --rate 1.0 --node-name rosbag2_player"),
        ("play run -r 2.5 -l --topics /a /b", "play run --rate 2.5 --node-name rosbag2_player --loop --topics /a /b"),
        (
            "play run --start-offset 1.5 --remap motor/speed:=old/speed",
            "play run --rate 1.0 --node-name rosbag2_player --remap motor/speed:=old/speed --start-offset 1.5",
        ),
        ("play run -m a:=b c:=d", "play run --rate 1.0 --node-name rosbag2_player --remap a:=b c:=d"),
    ],
)
def test_recording_and_playing_are_handed_on(handed_on, words, command):
    assert handed_on("bag", *words.split()).out == f"{command}\n"


def test_recording_without_a_name_takes_the_time_as_one(handed_on):
    out = handed_on("bag", "record", "--all").out
    assert re.fullmatch(r"record rosbag2_\d{4}_\d\d_\d\d-\d\d_\d\d_\d\d --all\n", out)


def test_recording_nothing_is_a_sentence(handed_on):
    assert handed_on("bag", "record", "-o", "x", status=1).err == (
        "Say what to record: topics, such as /motor/speed, or --all.\n"
    )
    assert "invalid choice: 'sqlite3'" in handed_on("bag", "record", "-a", "-s", "sqlite3", status=2).err
