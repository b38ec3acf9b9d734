"""Bags of other robots, identified by a mapping: joint states and commands, and a type that is not installed here."""

import pickle
from dataclasses import replace
from pathlib import Path

import foreign_bags
import numpy as np
import pytest
import yaml
from foreign_bags import KA, KS, KV
from rosbags.rosbag2 import CompressionMode, StoragePlugin
from tiers import mark_slow

from motor_identification.bag import Source, Window
from motor_identification.diagnose import diagnose
from motor_identification.identify import Request, identify
from motor_identification.logs.form import Kind
from motor_identification.mapping import MappedReader, Mapping, parse_origin, read_mapped
from motor_identification.uncertainty.result import Fit
from motor_model.errors import RecordingError
from motor_model.sample import Measurement

COMMAND = parse_origin("/wheels/commands:data[1]*12")
SPEED = Mapping(COMMAND, parse_origin("/joint_states:velocity[right_wheel]"), Kind.SPEED, speed_lag=0.0)
ANGLE = Mapping(COMMAND, parse_origin("/joint_states:position[right_wheel]"), Kind.POSITION)
TICKS = Mapping(
    parse_origin(f"/driver:wheels[right].duty*{12 / 255}"),
    parse_origin("/driver:wheels[right].ticks"),
    Kind.COUNT,
    edges_per_revolution=1440,
)
OMEGA = replace(TICKS, motion=parse_origin("/driver:wheels[right].omega"), kind=Kind.SPEED, edges_per_revolution=None)


@pytest.fixture(scope="module")
def bags(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder, motion = tmp_path_factory.mktemp("foreign"), foreign_bags.move(20.0)
    foreign_bags.write_joint_states(folder / "joints", motion)
    foreign_bags.write_joint_states(folder / "joints_sql", motion, StoragePlugin.SQLITE3)
    foreign_bags.write_driver_states(folder / "driver", motion)
    return folder


def fit(bag: Path, mapping: Mapping) -> Fit:
    return identify([Source((str(bag),), reader=MappedReader(mapping)).read(str(bag))], Request(("coulomb_friction",)))


@pytest.mark.parametrize(
    ("bag", "mapping"),
    [
        ("joints", SPEED),
        mark_slow("joints_sql", ANGLE),
        ("driver", TICKS),
        mark_slow("driver", replace(OMEGA, speed_lag=0.0)),
    ],
)
def test_the_motor_is_found_through_messages_of_others(bags: Path, bag: str, mapping: Mapping) -> None:
    found = fit(bags / bag, mapping).parameters.values
    assert found["kv"] == pytest.approx(KV, rel=0.003)
    assert found["ka"] == pytest.approx(KA, rel=0.02)
    assert found["ks"] == pytest.approx(KS, rel=0.03)


@pytest.mark.parametrize(
    ("storage", "mode", "content"),
    [
        (StoragePlugin.MCAP, CompressionMode.FILE, "packed_0.mcap.zstd"),
        (StoragePlugin.SQLITE3, CompressionMode.FILE, "packed_0.db3.zstd"),
        (StoragePlugin.SQLITE3, CompressionMode.MESSAGE, "packed_0.db3"),
    ],
)
def test_a_bag_that_was_recorded_with_compression_says_the_same(
    tmp_path: Path, storage: StoragePlugin, mode: CompressionMode, content: str
) -> None:
    """`ros2 bag record --compression-mode file|message --compression-format zstd`, laid out as it does."""
    motion = foreign_bags.move(2.0)
    foreign_bags.write_joint_states(tmp_path / "plain", motion)
    foreign_bags.write_joint_states(tmp_path / "packed", motion, storage, compression=mode)
    about_file, written = tmp_path / "packed" / "metadata.yaml", content.replace("_0", "")
    (tmp_path / "packed" / written).rename(tmp_path / "packed" / content)  # the recorder counts its files
    about_file.write_text(about_file.read_text(encoding="utf-8").replace(written, content), encoding="utf-8")
    metadata = yaml.safe_load(about_file.read_text(encoding="utf-8"))
    about = metadata["rosbag2_bagfile_information"]
    assert about["relative_file_paths"] == [content]
    assert (about["compression_format"], about["compression_mode"].upper()) == ("zstd", mode.name)
    plain, packed = (read_mapped(tmp_path / name, ANGLE) for name in ("plain", "packed"))
    assert len(plain) > 190
    for name in ("sample_time", "voltage", "edge_count", "edge_time"):
        assert np.array_equal(getattr(packed, name), getattr(plain, name))


@pytest.mark.slow
def test_a_speed_without_a_word_is_of_when_its_motion_says(bags: Path) -> None:
    """These are of an instant: taken for the mean of a period, half a period early, ka would be 4 % too small."""
    found = fit(bags / "joints", replace(SPEED, speed_lag=None)).parameters.values
    assert found["kv"] == pytest.approx(KV, rel=0.015) and found["ka"] == pytest.approx(KA, rel=0.015)


@pytest.mark.slow
def test_what_is_missing_is_named(bags: Path) -> None:
    found = diagnose([read_mapped(bags / "joints", SPEED)])
    assert [finding.effect for finding in found.findings] == ["coulomb_friction"]


def test_notes_tell_stamps_and_assumptions(bags: Path) -> None:
    recording = read_mapped(bags / "joints", SPEED)
    text = " ".join(recording.notes)
    assert "/joint_states is stamped by its sender; messages arrive 0.4 ms later, ± 0.1" in text
    assert "/wheels/commands has no stamps: times are those of arrival, every 20 ms give or take 0.000 ms." in text
    assert recording.info.measurement is Measurement.SPEED and recording.duration == pytest.approx(19.995)
    ticks = read_mapped(bags / "driver", TICKS)
    assert "wraps at 65536 count" in " ".join(ticks.notes) and np.ptp(ticks.edge_count) > 3000


def test_a_reader_goes_to_other_processes_and_takes_a_window(bags: Path) -> None:
    reader = pickle.loads(pickle.dumps(MappedReader(SPEED)))
    source = Source((str(bags / "joints"),), window=Window(2.0, 5.0), reader=reader)
    assert source.read(str(bags / "joints")).duration == pytest.approx(3.0, abs=0.01)


def test_a_field_cannot_drive_itself() -> None:
    with pytest.raises(RecordingError, match="cannot be both voltage and speed: name two fields"):
        Mapping(COMMAND, COMMAND, Kind.SPEED)
