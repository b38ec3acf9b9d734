"""A missing metadata.yaml is written from the files; what has one or may not have one is left alone."""

from pathlib import Path

import pytest
import yaml
from motor_bags import SAMPLES, fill, rewritten, write_bag
from rosbags.rosbag2 import CompressionMode, Reader, StoragePlugin

from motor_identification.bag import BagWriter, repair


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
