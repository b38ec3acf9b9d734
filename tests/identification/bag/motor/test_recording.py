"""Any bag of a motor is read exactly; any other is refused in a sentence."""

import shutil
from dataclasses import replace
from pathlib import Path

import pytest
from motor_bags import INFO, SAMPLES, assert_is, refusal, rewritten, write_bag
from rosbags.rosbag2 import CompressionMode, StoragePlugin

from motor_identification.bag import BagWriter, contents, messages, read_recording, topics
from motor_identification.bag.metadata import read_metadata, write_metadata
from motor_model.errors import RecordingError
from motor_model.sample import Info, Measurement


def test_what_was_written_is_read_bit_for_bit(tmp_path: Path) -> None:
    recording = read_recording(write_bag(tmp_path / "bag", SAMPLES))
    assert_is(recording, SAMPLES)
    assert recording.info == INFO
    assert recording.notes == ()


@pytest.mark.parametrize(
    ("entry", "value"),
    [
        ("topics_with_message_count", [{"topic_metadata": {"name": "/motor/speed", "type": "os/x"}}]),
        ("storage_identifier", "sqlite3"),
        ("compression_mode", "FILE"),
        ("compression_format", "zstd"),
        ("duration", {"nanoseconds": -(10**18)}),
        ("starting_time", "yesterday"),
        ("message_count", 10**30),
        ("custom_data", [{"experiment.profile": 1}]),
        ("relative_file_paths", None),
        ("version", "nine"),
    ],
)
def test_the_files_are_believed_and_not_what_metadata_claims_of_them(tmp_path: Path, entry: str, value: object) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES[:50])
    write_metadata(bag, {**read_metadata(bag), entry: value})
    recording = read_recording(bag)
    assert_is(recording, SAMPLES[:50])
    assert recording.notes == () and contents(bag).message_count == contents(bag / "bag_0.mcap").message_count


def test_of_many_missing_files_a_few_are_named(tmp_path: Path) -> None:
    """20,000 names in metadata.yaml were a line of 200 kB."""
    bag = write_bag(tmp_path / "bag", SAMPLES[:50])
    names = ["bag_0.mcap", *(f"/etc/x{k}.mcap" for k in range(12))]
    write_metadata(bag, {**read_metadata(bag), "relative_file_paths": names})
    (note,) = read_recording(bag).notes
    few = ", ".join(f"x{k}.mcap" for k in range(10))
    assert note == f"{bag} lacks {few} and 2 more, which its metadata.yaml lists: those samples are missing."


@pytest.mark.parametrize("namespace", ["left", "/left", "/left/"])
def test_a_namespace_is_said_with_or_without_slashes(tmp_path: Path, namespace: str) -> None:
    assert_is(read_recording(write_bag(tmp_path / "bag", SAMPLES[:50], namespace="/left"), namespace), SAMPLES[:50])


@pytest.mark.parametrize(
    ("plugin", "compression"),
    [
        (StoragePlugin.SQLITE3, CompressionMode.NONE),
        (StoragePlugin.SQLITE3, CompressionMode.MESSAGE),
        (StoragePlugin.SQLITE3, CompressionMode.FILE),
        (StoragePlugin.MCAP, CompressionMode.NONE),
        (StoragePlugin.MCAP, CompressionMode.MESSAGE),
        (StoragePlugin.MCAP, CompressionMode.FILE),
        (StoragePlugin.MCAP, CompressionMode.STORAGE),
    ],
)
@pytest.mark.parametrize("with_metadata", [True, False])
def test_bags_of_other_tools_are_read(
    tmp_path: Path,
    plugin: StoragePlugin,
    compression: CompressionMode,
    with_metadata: bool,
) -> None:
    bag = rewritten(write_bag(tmp_path / "bag", SAMPLES[:300]), tmp_path / "other", plugin, compression)
    if not with_metadata:
        (bag / "metadata.yaml").unlink()
    recording = read_recording(bag)
    assert_is(recording, SAMPLES[:300])
    assert recording.info == INFO and recording.notes == ()
    assert {topic.name: topic.message_count for topic in topics(bag)} == {"/motor/info": 1, "/motor/speed": 300}


def test_a_single_file_is_a_bag_too(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES[:300])
    assert_is(read_recording(next(bag.glob("*.mcap"))), SAMPLES[:300])
    other = rewritten(bag, tmp_path / "other", StoragePlugin.SQLITE3)
    assert_is(read_recording(str(next(other.glob("*.db3")))), SAMPLES[:300])


def test_without_info_the_assumptions_are_told(tmp_path: Path) -> None:
    recording = read_recording(write_bag(tmp_path / "bag", SAMPLES[:50], info=None))
    assert recording.info == Info(sample_period=0.005)
    (note,) = recording.notes
    assert "no /motor/info" in note and "96 stamped edges" in note and "12 V" in note


def test_the_latest_info_counts(tmp_path: Path) -> None:
    first = write_bag(tmp_path / "a", SAMPLES[:10], info=replace(INFO, measurement=Measurement.COUNTS))
    second = write_bag(tmp_path / "b", SAMPLES[10:20], info=replace(INFO, edges_per_revolution=2800))
    (tmp_path / "both").mkdir()
    shutil.copy(next(first.glob("*.mcap")), tmp_path / "both/both_0.mcap")
    shutil.copy(next(second.glob("*.mcap")), tmp_path / "both/both_1.mcap")
    recording = read_recording(tmp_path / "both")
    assert recording.info == replace(INFO, edges_per_revolution=2800)
    assert len(recording.notes) == 1 and "changes" in recording.notes[0]


def test_repeats_are_dropped_and_told(tmp_path: Path) -> None:
    again = [*SAMPLES[:30], replace(SAMPLES[30], sample_time=SAMPLES[29].sample_time), *SAMPLES[30:60]]
    recording = read_recording(write_bag(tmp_path / "bag", again))
    assert_is(recording, SAMPLES[:60])
    assert len(recording.notes) == 1 and "1 samples more than once" in recording.notes[0]


def test_a_message_that_two_recorders_wrote_is_dropped_wherever_it_stands(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", SAMPLES[:60])
    stored = list(messages(bag))
    with BagWriter(tmp_path / "twice") as writer:
        for name, type_name, log_time, data in [*stored, *stored[5:]]:
            writer.write(writer.topic(name, type_name), log_time, data)
    recording = read_recording(tmp_path / "twice")
    assert_is(recording, SAMPLES[:60])
    assert "56 samples more than once" in recording.notes[0]


def test_a_plant_that_restarts_is_not_mended(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match=r"steps back after 0\.495 s"):
        read_recording(write_bag(tmp_path / "bag", [*SAMPLES[:100], *SAMPLES[:100]]))


def test_only_the_part_that_is_asked_for_is_checked(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", [*SAMPLES[:100], replace(SAMPLES[100], voltage=float("nan")), *SAMPLES[101:200]])
    with pytest.raises(RecordingError, match="not numbers"):
        read_recording(bag)
    assert_is(read_recording(bag, stop=0.497), SAMPLES[:100])


# What cannot be used, and the sentence for it.


def test_no_such_bag(tmp_path: Path) -> None:
    assert refusal(tmp_path / "nothing").startswith("There is no bag ")


def test_not_a_bag(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("hello")
    assert "is neither a directory nor" in refusal(tmp_path / "notes.txt")
    assert "no .mcap or .db3 file" in refusal(tmp_path)
    (tmp_path / "text.mcap").write_text("this is not MCAP")
    assert "not an MCAP file" in refusal(tmp_path / "text.mcap")
    (tmp_path / "text.db3").write_text("this is not sqlite3, although it is quite long for that")
    assert "cannot be read" in refusal(tmp_path / "text.db3")


def test_a_motor_that_never_moves(tmp_path: Path) -> None:
    still = [replace(sample, speed=0.0, edge_count=5) for sample in SAMPLES[:50]]
    assert "never moves" in refusal(write_bag(tmp_path / "bag", still))
