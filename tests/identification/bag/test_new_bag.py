"""A new bag replaces a bag where that is wanted, and nothing else ever."""

from pathlib import Path

import pytest

from motor_identification.bag import BagWriter, contents
from motor_model.errors import RecordingError


def test_what_exists_is_refused_and_left_alone(tmp_path: Path) -> None:
    (tmp_path / "bag").mkdir()
    (tmp_path / "bag/precious").write_text("keep me")
    (tmp_path / "file").write_text("me too")
    for name in ("bag", "file"):
        with pytest.raises(RecordingError, match=f"{name} exists already and is left as it is"):
            BagWriter(tmp_path / name)
    assert (tmp_path / "bag/precious").read_text() == "keep me" and (tmp_path / "file").read_text() == "me too"
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["bag", "file", "precious"]
    with pytest.raises(RecordingError, match="cannot be written"):
        BagWriter(tmp_path / "file/inside")


def test_only_a_bag_is_ever_replaced(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        writer.write(writer.topic("/x", "std_msgs/msg/Float64"), 1, b"1234")
    with BagWriter(tmp_path / "bag", replace=True) as writer:
        assert writer.message_count == 0
    assert contents(tmp_path / "bag").message_count == 0
    (tmp_path / "bag/notes.txt").write_text("keep me")
    (tmp_path / "file.mcap").write_text("me too")
    for name in ("bag", "file.mcap"):
        with pytest.raises(RecordingError, match=f"{name} is not a bag and is left as it is: choose another name"):
            BagWriter(tmp_path / name, replace=True)
    assert {path.name for path in (tmp_path / "bag").iterdir()} == {"bag_0.mcap", "metadata.yaml", "notes.txt"}
