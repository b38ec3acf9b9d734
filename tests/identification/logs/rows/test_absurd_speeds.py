"""What a speed's filter begins with."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.logs.rows.absurd_speeds import ABSURD, FEWEST, is_of_run_before, mark_absurd_beginning

SPEED = 50.0 * (1.0 - np.exp(-np.arange(400) / 30.0))


def begun(size: float, keeps: float = 0.85) -> np.ndarray:
    return SPEED - size * keeps ** np.arange(400)


def test_a_filter_that_began_with_garbage_is_left_out_until_it_has_faded() -> None:
    speed = begun(1e7)
    marks = mark_absurd_beginning(speed)
    first = int(np.argmin(marks))
    assert marks[:first].all() and not marks[first:].any()
    assert np.max(np.abs(speed[first:] - SPEED[first:])) < 0.05
    assert first < 200


@pytest.mark.parametrize(
    ("speed", "marked"),
    [
        (SPEED, False),
        (-SPEED, False),
        (begun(0.9 * ABSURD * 50.0), False),
        (begun(1.3 * ABSURD * 50.0 / 0.85 ** (FEWEST - 1)), True),
        (np.zeros(400), False),
        (begun(1e7, 0.999), False),  # most of a run is no accident
        (np.where(np.arange(400) == 1, -1e7, SPEED), False),  # one row is told elsewhere
        (begun(1e7)[::-1], False),
        (begun(1e7)[:2], False),
    ],
)
def test_only_beginnings_far_beyond_all_others(speed: np.ndarray, marked: bool) -> None:
    assert mark_absurd_beginning(speed).any() == marked


def test_an_imported_log_keeps_the_sign_of_its_motion(tmp_path: Path) -> None:
    """Garbage of the other sign had it turned round."""
    rows = [f"{0.01 * k:.2f},{6 if k > 2 else 0},{value:.3f}" for k, value in enumerate(begun(1e7))]
    (tmp_path / "log.csv").write_text("\n".join(["time,voltage,rpm", *rows]) + "\n")
    (motor,) = import_log(tmp_path / "log.csv", Said()).motors
    assert not any(line.startswith("Caution") for line in motor.log.findings)
    assert any("as of a filter that began with garbage" in line for line in motor.log.findings)
    speeds = [sample.speed for run in motor.log.runs for sample in run.samples]
    assert min(speeds) > 0.0 and max(speeds) < 50.0 * 2.0 * np.pi / 60.0


SINE = 150.0 * np.sin(np.arange(400) / 12.0)
RISING = np.where(np.abs(SINE) > 40.0, 0.004 * SINE, 0.0)


@pytest.mark.parametrize(
    ("first", "drive", "stale"),
    [
        (-0.39, -129.0, True),
        (-0.39, -110.0, False),  # of steps of 13 in the next rows
        (-0.0009, -129.0, False),  # nearly as in the rows after it
        (0.0, 0.0, False),
    ],
)
def test_a_first_row_of_a_run_before_is_told_by_speed_and_drive(first: float, drive: float, stale: bool) -> None:
    """Its voltages seemed to have held until their rows: friction came out 15 % and inertia 50 % too large."""
    volts, speed = SINE[1:], RISING[1:] + 1e-4
    assert is_of_run_before(np.append(first, speed), np.append(drive, volts)) is stale
    assert not is_of_run_before(np.append(first, 0.0 * speed), np.append(drive, volts))  # nothing moves
    assert not is_of_run_before(np.append(first, speed)[:4], np.append(drive, volts)[:4])


def test_an_import_leaves_a_first_row_of_a_run_before_out_and_says_so(tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    rows = zip(0.02 * np.arange(400), np.append(-129.0, SINE[1:]), np.append(-0.39, RISING[1:]), strict=True)
    path.write_text("t [s],u [V],y [rad/s]\n" + "\n".join(f"{t:.3f},{u:.2f},{y:.3f}" for t, u, y in rows) + "\n")
    motor = import_log(path, Said()).motors[0]
    assert len(motor.log.runs[0].samples) == 399
    assert any(
        "Left out: the first row, with the speed and the drive of a run before" in one for one in motor.log.findings
    )


@pytest.mark.parametrize(
    ("rest", "zero", "begins", "taken"),
    [(1.24, False, True, True), (2.1, False, True, False), (1.24, True, True, False), (1.24, False, False, False)],
)
def test_what_a_sensor_shows_of_a_rest_is_zero(
    tmp_path: Path, rest: float, zero: bool, begins: bool, taken: bool
) -> None:
    """A PIO that waits for an edge shows 1.24 rpm at rest; one count is 38.64 rpm, and a mean of 32 rows."""
    moves = -38.64 * np.rint(SPEED / 6.0)
    speed = np.concatenate((np.zeros(100 if begins else 0), moves, np.zeros(0 if begins else 100)))
    speed = np.where(speed == 0.0, 0.0 if zero else rest, speed)
    speed[3] = 1.24 if zero else speed[3]
    speed = speed if begins else np.delete(speed, np.flatnonzero(speed > 0.0)[:8])
    path = tmp_path / "log.csv"
    rows = (f"{row},{v:g},{-4 if v < 0 else 0}\n" for row, v in enumerate(speed))
    path.write_text("time_ms,speed_rpm,voltage\n" + "".join(rows))
    findings = import_log(path, Said()).motors[0].log.findings
    assert any("are those of a standing motor" in line for line in findings) is taken


@pytest.mark.parametrize(("volts", "taken"), [(0.0, True), (0.63, False)])
def test_a_motor_that_creeps_under_a_voltage_does_not_stand(tmp_path: Path, volts: float, taken: bool) -> None:
    """A step from a slow speed, to leave its breakaway out, was one from rest."""
    speed = np.append(np.full(61, 4.0), np.linspace(140.0, 900.0, 200))
    path = tmp_path / "log.csv"
    rows = (f"{10 * row},{v:g},{volts if v < 5.0 else 6.0:g}\n" for row, v in enumerate(speed))
    path.write_text("time_ms,speed_rpm,voltage\n" + "".join(rows))
    findings = import_log(path, Said()).motors[0].log.findings
    assert any("are those of a standing motor" in line for line in findings) is taken
