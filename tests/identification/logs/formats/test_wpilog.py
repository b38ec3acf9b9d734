"""WPILib's data log: what a robot writes is found again; what is damaged is read up to there."""

from pathlib import Path
from struct import pack

import numpy as np
import pytest
from wpilib_log import KA, KS, KV, Log, record, write_routine

from motor_identification.identify import Request, identify
from motor_identification.logs.columns.said import Said
from motor_identification.logs.formats.source import read_source
from motor_identification.logs.formats.wpilog import read_wpilog
from motor_identification.logs.imported import import_log
from motor_identification.recording import check, recording_of
from motor_model.errors import RecordingError


@pytest.fixture(scope="module")
def routine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("wpilog") / "routine.wpilog"
    write_routine(path)
    return path


def test_a_routine_is_four_runs_of_one_motor(routine: Path) -> None:
    source = read_source(routine)
    assert source.format == "WPILOG" and source.said == Said(split="test")
    names = ["test", "time [s]", "voltage-left-drive [V]", "position-left-drive [rev]", "velocity-left-drive [rev/s]"]
    assert source.table.names == [*names, "/battery"] and len(source.table) == 1000
    assert source.table.numbers("time [s]")[:2] == pytest.approx([1.000007, 1.020007])
    assert source.table.numbers("voltage-left-drive [V]")[:3] == pytest.approx([0.0, 0.02, 0.04])
    assert set(source.table.column("test")) == {
        f"{a}-{b}" for a in ("quasistatic", "dynamic") for b in ("forward", "reverse")
    }


def test_its_motor_is_identified(routine: Path) -> None:
    log = import_log(routine, Said()).motors[0].log
    recordings = [check(recording_of(run.samples, log.info, run.label)) for run in log.runs]
    assert len(recordings) == 4
    values = identify(recordings, Request(("coulomb_friction",))).parameters.values
    assert values["kv"] == pytest.approx(KV, rel=0.01) and values["ka"] == pytest.approx(KA, rel=0.05)
    assert values["ks"] == pytest.approx(KS, rel=0.1)


def test_a_log_that_was_cut_off_is_read_up_to_there(routine: Path, tmp_path: Path) -> None:
    whole, cut = routine.read_bytes(), tmp_path / "cut.wpilog"
    cut.write_bytes(whole[: len(whole) // 2])
    table, _ = read_wpilog(cut)
    assert 450 < len(table) < 520 and "is damaged or cut off: what follows byte" in table.notes[1]
    assert len(read_wpilog(routine)[0].notes) == 1


def test_values_that_come_only_when_they_change_are_held(tmp_path: Path) -> None:
    log, path = Log("an extra header"), tmp_path / "log"
    voltage, angle = log.start("u", "double"), log.start("angle", "int64", "Degree")
    log.put(voltage, 3.0, 999)  # 1 us before the second row
    for k in range(9):
        log.put(angle, -k, 500 * k)
    log.put(voltage, 5.0, 1040)  # within a tenth of a row's time behind the third
    log.put(voltage, 6.0, 1060)
    path.write_bytes(log.data + record(99, 1100, pack("<d", 1.0)) + record(voltage, 1200, b"abc"))
    table, split = read_wpilog(path)
    assert split is None and table.names == ["time [s]", "u", "angle [deg]"]
    assert table.numbers("u") == pytest.approx([5.0, *[6.0] * 6])
    assert np.all(np.diff(table.numbers("angle [deg]")) == -1.0)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"WPILOG\x00\x02" + bytes(4), "of another version than 1"),
        (b"WPILOG\x00\x01\xff\0\0\0", "is damaged: its header says that it is longer than the file"),
        (b"WPILOG\x00", "of another version than 1"),
        (b"WPILOG\x00\x01" + bytes(4), "has no two series of numbers"),
        (b"WPILOG\x00\x01" + bytes(4) + b"\xff" * 40, "has no two series of numbers"),
    ],
)
def test_what_is_none_is_a_sentence(data: bytes, words: str, tmp_path: Path) -> None:
    (tmp_path / "log").write_bytes(data)
    with pytest.raises(RecordingError, match=words):
        read_wpilog(tmp_path / "log")


def test_two_mechanisms_have_their_tests_both(tmp_path: Path) -> None:
    log = Log()
    drive, arm = (log.start(f"sysid-test-state-{name}", "string") for name in ("drive", "arm"))
    voltage, angle = log.start("u", "double"), log.start("angle", "double")
    for k in range(30):
        log.put(drive, "dynamic-forward" if k < 10 else "none", 1000 * k)
        log.put(arm, "dynamic-forward" if k >= 20 else "none", 1000 * k)
        log.put(voltage, 1.0, 1000 * k)
        log.put(angle, float(k), 1000 * k)
    (tmp_path / "log").write_bytes(log.data)
    table, split = read_wpilog(tmp_path / "log")
    assert split == "test" and "Tests of 2 mechanisms" in table.notes[1]
    assert list(table.column("test")) == ["drive dynamic-forward"] * 10 + ["arm dynamic-forward"] * 10
    assert table.numbers("angle").tolist() == [*range(10), *range(20, 30)]


def test_columns_of_one_name_are_told_apart(tmp_path: Path) -> None:
    log = Log()
    log.start("sysid-test-state-drive", "string")
    entries = [log.start(*of) for of in (("test", "double"), ("time [s]", "double"), ("u", "double"), ("u", "int64"))]
    for k in range(5):
        log.put(1, "quasistatic-forward", 1000 * k)
        for entry in entries:
            log.put(entry, entry, 1000 * k)
    (tmp_path / "log").write_bytes(log.data)
    table, _ = read_wpilog(tmp_path / "log")
    assert table.names == ["test", "time [s]", "test (2)", "time [s] (2)", "u", "u (2)"]
    assert table.numbers("time [s]") == pytest.approx(np.arange(5) * 1e-3)
    assert [table.numbers(name)[0] for name in table.names[2:]] == [2.0, 3.0, 4.0, 5.0]
