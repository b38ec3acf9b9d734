"""Compressed bags are read as if they were not."""

from pathlib import Path

import pytest
from motor_bags import SAMPLES, rewritten, write_bag
from rosbags.rosbag2 import CompressionMode, StoragePlugin

from motor_identification.bag.storage import Bag


@pytest.mark.parametrize("compression", [CompressionMode.FILE, CompressionMode.MESSAGE, CompressionMode.NONE])
def test_compression_is_seen_and_undone(tmp_path: Path, compression: CompressionMode) -> None:
    plain = write_bag(tmp_path / "bag", SAMPLES[:50])
    bag = Bag(rewritten(plain, tmp_path / "other", StoragePlugin.MCAP, compression))
    assert bag.compressed == (compression is not CompressionMode.NONE)
    assert [data for _, _, data in bag.messages()] == [data for _, _, data in Bag(plain).messages()]
