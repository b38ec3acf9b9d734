"""A bag as its files: their order, their contents, and what is not one."""

import shutil
from pathlib import Path

import pytest
from motor_bags import SAMPLES, assert_is, write_bag

from motor_identification.bag import contents, read_recording
from motor_identification.bag.storage import Bag
from motor_model.errors import RecordingError


def test_the_files_of_a_split_bag_follow_by_number(tmp_path: Path) -> None:
    split = tmp_path / "split"
    split.mkdir()
    for k in range(11):
        part = write_bag(tmp_path / f"part{k}", SAMPLES[k * 20 : k * 20 + 20])
        shutil.copy(next(part.glob("*.mcap")), split / f"split_{k}.mcap")
    assert_is(read_recording(split), SAMPLES[:220])
    assert contents(split).message_count == 220 + 11


def test_a_lost_file_of_a_split_bag_is_told(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES[:20])
    metadata = bag / "metadata.yaml"
    metadata.write_text(metadata.read_text().replace("- bag_0.mcap", "- bag_0.mcap\n  - bag_1.mcap"))
    (note,) = read_recording(bag).notes
    assert "bag_1.mcap" in note and "bag_0.mcap" not in note


def test_files_are_ordered_by_their_numbers_and_a_whole_file_goes_before_its_compressed_copy(tmp_path: Path) -> None:
    for name in ("bag_10.mcap", "bag_2.mcap.zstd", "bag_2.mcap", "bag_1.mcap.zstd", "notes.txt", "metadata.yaml"):
        (tmp_path / name).write_bytes(b"")
    assert [file.name for file in Bag(tmp_path).files] == ["bag_1.mcap.zstd", "bag_2.mcap", "bag_10.mcap"]


def test_contents_are_counted_where_the_file_has_no_index(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES)
    whole = Bag(bag).contents()
    file = next(bag.glob("*.mcap"))
    content = file.read_bytes()
    file.write_bytes(content[:-200])  # all messages are there
    assert Bag(bag).contents().message_count == whole.message_count == 2001 and not whole.cut
    file.write_bytes(content[: len(content) // 2])
    counted = Bag(bag).contents()
    assert counted.cut and 100 < counted.message_count < 2001
    assert {topic.name for topic in counted.topics} == {topic.name for topic in whole.topics}


def test_a_bag_of_ros_1_is_told_how_to_become_one(tmp_path: Path) -> None:
    (tmp_path / "old.bag").write_bytes(b"#ROSBAG V2.0\n" + bytes(20))
    with pytest.raises(RecordingError, match=r"old\.bag is a bag of ROS 1: convert it \(rosbags-convert"):
        Bag(tmp_path / "old.bag")


def test_a_path_that_is_no_bag(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="There is no bag .*nowhere: check the path"):
        Bag(tmp_path / "nowhere")
    with pytest.raises(RecordingError, match=r"is not a bag \(it has no \.mcap or \.db3 file in it\)"):
        Bag(tmp_path)
    (tmp_path / "log.csv").write_text("t,u,y\n")
    with pytest.raises(RecordingError, match=r"is neither a directory nor a \.mcap or \.db3 file"):
        Bag(tmp_path / "log.csv")
