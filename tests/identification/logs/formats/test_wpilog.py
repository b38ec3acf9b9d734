"""WPILib's data log: what a robot writes is found again; what is damaged is read up to there."""

from pathlib import Path
from struct import pack

import numpy as np
import pytest
from wpilib_log import KA, KS, KV, Log, record, write_routine

from motor_identification.identify import Request, identify
from motor_identification.logs.columns.said import Pair, Said
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
    assert source.format == "WPILOG" and source.said == Said(
        split="test", motors=(Pair("", "voltage-left-drive [V]", "position-left-drive [rev]"),)
    )
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
    table = read_wpilog(cut).table
    assert 450 < len(table) < 520 and "is damaged or cut off: what follows byte" in table.notes[-1]
    assert len(read_wpilog(routine).table.notes) == 2


def test_values_that_come_only_when_they_change_are_held(tmp_path: Path) -> None:
    log, path = Log("an extra header"), tmp_path / "log"
    voltage, angle = log.start("u", "double"), log.start("angle", "int64", "Degree")
    log.put(voltage, 3.0, 999)  # 1 us before the second row
    for k in range(9):
        log.put(angle, -k, 500 * k)
    log.put(voltage, 5.0, 1040)  # within a tenth of a row's time behind the third
    log.put(voltage, 6.0, 1060)
    path.write_bytes(log.data + record(99, 1100, pack("<d", 1.0)) + record(voltage, 1200, b"abc"))
    log = read_wpilog(path)
    table = log.table
    assert log.split is None and log.motors == () and table.names == ["time [s]", "u", "angle [deg]"]
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
    read = read_wpilog(tmp_path / "log")
    table = read.table
    assert read.split == "test" and read.motors == () and "Tests of 2 mechanisms" in table.notes[1]
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
    table = read_wpilog(tmp_path / "log").table
    assert table.names == ["test", "time [s]", "test (2)", "time [s] (2)", "u", "u (2)"]
    assert table.numbers("time [s]") == pytest.approx(np.arange(5) * 1e-3)
    assert [table.numbers(name)[0] for name in table.names[2:]] == [2.0, 3.0, 4.0, 5.0]


def _robot(path: Path, motors: tuple[str, ...], state: str = "sysid-test-state-arm") -> None:
    """A robot's log: what SysId's routine writes every 20 ms of its tests, beside a dashboard that writes as often."""
    log = Log()
    shown = [log.start(f"NT:/SmartDashboard/Wrist/{name}", "double") for name in ("Position", "Voltage", "angle")]
    test = log.start(state, "string")
    entries = [
        [log.start(f"{what}-{motor}-arm", "double", unit) for what, unit in _ROUTINE.items()] for motor in motors
    ]
    for k in range(400):
        for entry in shown:
            log.put(entry, 1e-3 * (k % 7), 10_000 * k)
        if k % 2:
            log.put(test, "none" if k % 200 > 190 else "dynamic-forward" if k < 200 else "dynamic-reverse", 10_000 * k)
            for number, one in enumerate(entries, start=1):
                for entry, value in zip(one, (3.0, number * 0.01 * k, number * 1.0), strict=True):
                    log.put(entry, value, 10_000 * k + 40)
    path.write_bytes(log.data)


_ROUTINE = {"voltage": "Volt", "position": "Rotation", "velocity": "Rotation per Second"}


def test_a_routine_tells_which_of_a_robots_numbers_are_its_motors(tmp_path: Path) -> None:
    _robot(tmp_path / "log", ("roll",))
    imported = import_log(tmp_path / "log", Said())
    assert [motor.label for motor in imported.motors] == [""]
    assert "Motion: position-roll-arm [rev], a position in rev." in imported.findings
    assert [imported.motors[0].log.runs[0].samples[k].voltage for k in (3, 50)] == [3.0, 3.0]
    assert [run.label for run in imported.motors[0].log.runs] == ["dynamic-forward", "dynamic-reverse"]
    assert len(imported.motors[0].log.runs[0].samples) == 95  # the routine's rows, not the dashboard's 190
    dashboard = import_log(
        tmp_path / "log", Said(voltage="NT:/SmartDashboard/Wrist/Voltage", motion="position-roll-arm [rev]")
    )
    assert any("Voltage: NT:/SmartDashboard/Wrist/Voltage" in line for line in dashboard.findings)


def test_each_motor_of_a_routine_is_one_with_its_name_fit_for_a_file(tmp_path: Path) -> None:
    _robot(tmp_path / "log", ("left", "../r ight"))
    read = read_wpilog(tmp_path / "log")
    assert [motor.label for motor in read.motors] == ["left", ".._r_ight"]
    assert read.motors[1].motion == "position-../r ight-arm [rev]"
    assert len(import_log(tmp_path / "log", Said()).motors) == 2


def test_tests_are_known_by_their_words_whatever_the_series_is_called(tmp_path: Path) -> None:
    _robot(tmp_path / "log", ("roll",), "/RealOutputs/Drive/SysIdState")
    read = read_wpilog(tmp_path / "log")
    assert read.split == "test" and read.motors == ()
    assert set(read.table.column("test")) == {"dynamic-forward", "dynamic-reverse"}


def test_where_a_routine_logged_no_position_the_speed_is_its_motion(tmp_path: Path) -> None:
    log = Log()
    test = log.start("sysid-test-state-arm", "string")
    entries = [log.start(f"{what}-roll-arm", "double", unit) for what, unit in _ROUTINE.items()]
    for k in range(20):
        log.put(test, "dynamic-forward", 20_000 * k)
        for entry, value in zip(entries, (3.0, 0.0, 0.1 * k), strict=True):
            log.put(entry, value, 20_000 * k)
    (tmp_path / "log").write_bytes(log.data)
    assert read_wpilog(tmp_path / "log").motors[0].motion == "velocity-roll-arm [rev/s]"


def test_each_of_several_mechanisms_has_its_own_tests(tmp_path: Path) -> None:
    log = Log()
    states = {name: log.start(f"sysid-test-state-{name}", "string") for name in ("drive", "arm")}
    series = {
        name: [log.start(f"{what}-{motor}-{name}", "double", unit) for what, unit in _ROUTINE.items()]
        for name, motor in (("drive", "left"), ("arm", "roll"))
    }
    for name, begin in (("drive", 0), ("arm", 4_000_000)):
        for k in range(150):
            log.put(states[name], "none" if k > 140 else "dynamic-forward", begin + 20_000 * k)
            for entry, value in zip(series[name], (3.0, 0.02 * k * k, 0.04 * k), strict=True):
                log.put(entry, value, begin + 20_000 * k + 30)
    (tmp_path / "log").write_bytes(log.data)
    motors = import_log(tmp_path / "log", Said()).motors
    assert [motor.label for motor in motors] == ["left_drive", "roll_arm"]
    assert [[run.label for run in motor.log.runs] for motor in motors] == [
        ["drive_dynamic-forward"],
        ["arm_dynamic-forward"],
    ]
    assert all(139 <= len(motor.log.runs[0].samples) <= 141 for motor in motors)
