"""Logs of one step that have no column of what drove the motor."""

from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

from motor_identification.logs.columns.said import Said
from motor_identification.logs.csv.table import Table
from motor_identification.logs.imported import import_log
from motor_identification.logs.rows.drive.constant_voltage import (
    CONSTANT,
    count_standing_rows,
    give_voltage,
)
from motor_model.errors import RecordingError

TIME = np.arange(200) * 0.01
SPEED = np.round(300.0 * (1.0 - np.exp(-TIME / 0.1)))


def test_every_row_has_it() -> None:
    table = give_voltage(Table(Path("log.csv"), np.arange(3), {"t": np.arange(3.0)}), -7.4)
    np.testing.assert_array_equal(table.numbers(CONSTANT), [-7.4] * 3)


def test_time_and_speed_alone(tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    path.write_text(
        "\n".join(["time_ms,speed_rpm", *(f"{1000 * t:.0f},{v:g}" for t, v in zip(TIME, SPEED, strict=True))])
    )
    with pytest.raises(
        RecordingError, match="no column is the voltage or duty: .*--constant-voltage V for a log of one"
    ):
        import_log(path, Said())
    imported = import_log(path, Said(constant_voltage=9.0))
    (run,) = imported.motors[0].log.runs
    assert {sample.voltage for sample in run.samples} == {9.0} and len(run.samples) == 200
    assert "Voltage: (constant voltage) is 9 V in every row, as said." in imported.findings
    assert imported.findings[0].endswith("with the columns time_ms, speed_rpm.")


def test_without_names_the_position_is_found_beside_its_speed(tmp_path: Path) -> None:
    """As small computers write it: time, position, speed."""
    path = tmp_path / "data_100.txt"
    degrees = np.floor(np.cumsum(SPEED * 6.0 * 0.01))
    rows = [f"{t:.4f} {p:.4f} {v:.4f}" for t, p, v in zip(TIME, degrees, SPEED * 6.0, strict=True)]
    path.write_text("\n".join(rows))
    imported = import_log(path, Said(constant_voltage=-8.0, unit="deg"))
    assert "Motion: column 2, a position in deg." in imported.findings


@pytest.mark.parametrize(
    ("standing", "rise", "counted"),
    [(100, 0.1, 100), (40, 0.1, 40), (25, 0.1, 0), (9, 0.02, 0), (12, 0.02, 12), (0, 0.1, 0)],
)
def test_rows_before_a_motor_moves(standing: int, rise: float, counted: int) -> None:
    """Rows are 10 ms apart: a motor that rises in 0.1 s may have a delay of less than 0.3 s."""
    speed = np.concatenate([np.zeros(standing), 300.0 * (1.0 - np.exp(-TIME[1:] / rise))])
    assert abs(count_standing_rows(speed) - counted) <= 1
    assert count_standing_rows(-speed) == count_standing_rows(speed)
    assert count_standing_rows(np.zeros(50)) == 0


@pytest.mark.parametrize("position", [False, True])
def test_a_log_that_begins_before_its_step(tmp_path: Path, position: bool) -> None:
    speed = np.concatenate([np.zeros(100), SPEED])
    name, motion = ("pos_deg", np.cumsum(6.0 * speed * 0.01)) if position else ("speed_rpm", speed)
    path = tmp_path / "log.csv"
    path.write_text("\n".join([f"time_ms,{name}", *(f"{10 * k},{v:g}" for k, v in enumerate(motion))]))
    imported = import_log(path, Said(constant_voltage=9.0))
    (run,) = imported.motors[0].log.runs
    volts = np.array([sample.voltage for sample in run.samples])
    came = int(np.argmax(volts))
    assert set(volts) == {0.0, 9.0} and 98 <= came <= 101 and np.all(volts[came:] == 9.0)
    assert any("stands in the first 10" in line for line in imported.motors[0].log.findings)


@pytest.mark.parametrize("rest_until", [None, 0.0])
@pytest.mark.parametrize("position", [False, True])
def test_an_oscilloscope_that_was_triggered(tmp_path: Path, rest_until: float | None, position: bool) -> None:
    """Its clock begins before 0 s, and its noise while the motor stands is no motion that comes to rest."""
    time = 0.0002 * np.arange(-490, 2010)
    noise = -0.8 * (np.random.default_rng(3).random(len(time)) < 0.25)
    speed = np.round(75.0 * (1.0 - np.exp(-np.maximum(time, 0.0) / 0.09)) / 0.8) * 0.8 + noise
    name, motion = ("pos_deg", np.round(np.cumsum(speed))) if position else ("speed", speed)
    path = tmp_path / "log.csv"
    path.write_text("\n".join([f"time_s,{name}", *(f"{t:.4f},{v:g}" for t, v in zip(time, motion, strict=True))]))
    said = Said(constant_voltage=60.8, rest_until=rest_until, unit="deg" if position else "rad/s")
    imported = import_log(path, said)
    (run,) = imported.motors[0].log.runs
    volts = np.array([sample.voltage for sample in run.samples])
    findings = " ".join((*imported.findings, *imported.motors[0].log.findings))
    assert "comes to rest" not in findings and "turned round" not in findings and "both ways" not in findings
    if rest_until is None:
        assert "the motor stands until then, 490 rows" in findings
        assert np.count_nonzero(volts) == 2010 and not np.any(volts[:490])
    else:
        assert "Left out: the first 490 rows, in which the motor stands until 0 s" in findings
        assert len(volts) == 2010 and set(volts) == {60.8}


def test_a_motor_that_moves_before_the_rest_ends_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    path.write_text("\n".join(["time_s,speed_rpm", *(f"{t:g},{v:g}" for t, v in zip(TIME, SPEED, strict=True))]))
    with pytest.raises(RecordingError, match=r"before --rest-until 0\.5"):
        import_log(path, Said(constant_voltage=9.0, rest_until=0.5))


@pytest.mark.parametrize(("late", "stands"), [(0.03, False), (1.0, True)])
def test_a_slow_motor_of_coarse_counts_has_not_risen_with_its_first(tmp_path: Path, late: float, stands: bool) -> None:
    """Less than a count a row, a time constant of 60 ms: rows are 4 ms apart, and 30 ms may be a delay."""
    time = 0.004 * np.arange(500)
    since = np.maximum(time - late, 0.0)
    position = np.floor(150.0 * (since - 0.06 * (1.0 - np.exp(-since / 0.06))))
    path = tmp_path / "log.csv"
    path.write_text("\n".join(["time_s,pos_deg", *(f"{t:g},{p:g}" for t, p in zip(time, position, strict=True))]))
    findings = import_log(path, Said(constant_voltage=1.5)).motors[0].log.findings
    assert any("stands in the first" in line for line in findings) is stands


@pytest.mark.parametrize("stale", [False, True])
def test_a_motor_that_moves_from_the_first_row_does_not_stand_because_rows_are_missing(
    tmp_path: Path, stale: bool
) -> None:
    """What it went meanwhile is more than twenty rows' way; it may be read before the pause, and stamped behind it."""
    time = np.concatenate([3.0 * np.arange(30), 300.0 + 3.0 * np.arange(300)])
    position = np.round(0.5 * time)
    position[30] = position[29] + 2.0 if stale else position[30]
    path = tmp_path / "log.csv"
    path.write_text("\n".join(["time_ms,pos_deg", *(f"{t:g},{p:g}" for t, p in zip(time, position, strict=True))]))
    imported = import_log(path, Said(constant_voltage=4.8))
    assert not any("stands in the first" in line for line in imported.motors[0].log.findings + imported.findings)
    assert {sample.voltage for run in imported.motors[0].log.runs for sample in run.samples} == {4.8}


def test_the_motion_alone_is_a_log_of_one_voltage(tmp_path: Path) -> None:
    path = tmp_path / "log.mat"
    savemat(path, {"MotorA": 50.0 * (1.0 - np.exp(-np.arange(100) / 20.0))})
    with pytest.raises(RecordingError, match="no two vectors of one length.* say --constant-voltage V, and --sample-"):
        import_log(path, Said())
    asked = r"MotorA moves under one voltage, and no column is its times: say --time COL, or --sample-period S"
    with pytest.raises(RecordingError, match=asked):
        import_log(path, Said(constant_voltage=5.5, unit="rpm"))
    (motor,) = import_log(path, Said(constant_voltage=5.5, sample_period=0.01, unit="rpm")).motors
    (run,) = motor.log.runs
    assert len(run.samples) == 100 and {sample.voltage for sample in run.samples} == {5.5}
