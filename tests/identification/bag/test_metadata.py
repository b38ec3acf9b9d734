"""What stands in metadata.yaml, and that it is whole or not there."""

from pathlib import Path

import yaml
from mcap.reader import make_reader
from motor_bags import SPEED, START, fill

from motor_identification.bag import BagWriter, contents
from motor_identification.bag.contents import Contents, Span
from motor_identification.bag.metadata import MOST_CAUTIONS, bag_metadata, read_cautions, read_metadata, write_metadata
from motor_identification.bag.topic import Topic


def test_what_was_noted_stands_in_file_and_metadata_and_survives_a_crash(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        writer.note("experiment", {"profile": "step", "voltage": "6.0"})
        fill(writer)
    noted = {"experiment.profile": "step", "experiment.voltage": "6.0"}
    assert contents(tmp_path / "bag").custom_data == noted
    content = yaml.safe_load((tmp_path / "bag/metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert content["custom_data"] == noted
    (tmp_path / "bag/metadata.yaml").unlink()
    assert contents(tmp_path / "bag").custom_data == noted
    file = tmp_path / "bag/bag_0.mcap"
    with file.open("rb") as stream:
        records = {record.name: record.metadata for record in make_reader(stream).iter_metadata()}
    assert records["experiment"] == {"profile": "step", "voltage": "6.0"}
    file.write_bytes(file.read_bytes()[:10_000])
    assert contents(tmp_path / "bag").custom_data == noted and contents(tmp_path / "bag").cut
    with BagWriter(tmp_path / "plain") as writer:
        writer.write(writer.topic("/motor/speed", SPEED), START, b"\x00\x01\x00\x00")
    assert contents(tmp_path / "plain").custom_data == {}


def test_it_lists_every_file_with_its_times_and_the_bag_as_a_whole() -> None:
    first = Contents((Topic("/a", "T", message_count=2),), Span(100, 150))
    second = Contents((Topic("/a", "T", message_count=3), Topic("/b", "U", message_count=1)), Span(150, 400))
    metadata = bag_metadata({"bag_0.mcap": first, "bag_1.mcap": second}, "mcap")
    assert (metadata["version"], metadata["storage_identifier"], metadata["message_count"]) == (9, "mcap", 6)
    assert metadata["starting_time"] == {"nanoseconds_since_epoch": 100}
    assert metadata["duration"] == {"nanoseconds": 300}
    assert metadata["relative_file_paths"] == ["bag_0.mcap", "bag_1.mcap"]
    assert [file["message_count"] for file in metadata["files"]] == [2, 4]
    counts = {row["topic_metadata"]["name"]: row["message_count"] for row in metadata["topics_with_message_count"]}
    assert counts == {"/a": 5, "/b": 1} and metadata["custom_data"] is None


def test_what_was_written_is_read_and_damage_is_nothing(tmp_path: Path) -> None:
    metadata = bag_metadata({"bag_0.mcap": Contents(custom_data={"experiment.profile": "step"})}, "mcap")
    write_metadata(tmp_path, metadata)
    assert read_metadata(tmp_path) == metadata
    assert [path.name for path in tmp_path.iterdir()] == ["metadata.yaml"]
    for damaged in ("", "[]", "rosbag2_bagfile_information: 7", "{", "other: {}"):
        (tmp_path / "metadata.yaml").write_text(damaged, encoding="utf-8")
        assert read_metadata(tmp_path) == {}, damaged
    assert read_metadata(tmp_path / "nowhere") == {}


def test_of_cautions_that_anybody_may_have_written_a_few_short_ones_are_believed(tmp_path: Path) -> None:
    told = {f"import.caution_{k:02d}": "\x1b[31mx" * 1000 for k in range(100)}
    write_metadata(tmp_path, {"custom_data": {"import.caution_": 3, "experiment.profile": "step", **told}})
    found = read_cautions(tmp_path)
    assert len(found) == MOST_CAUTIONS and len(set(found)) == 1
    assert len(found[0]) < 530 and found[0].startswith("The import cautions: \\x1b[31mx")
    write_metadata(tmp_path, {"custom_data": [told]})
    assert read_cautions(tmp_path) == read_cautions(tmp_path / "none") == ()
