"""What a position and a speed of the same shaft tell of each other."""

from dataclasses import replace
from math import pi, radians
from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.guess import guess_forms
from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.motion.speed_beside import (
    Counted,
    find_counted_position,
    find_driven_speed,
    find_summed_counts,
    tell_position_unit,
    tell_speed_unit,
)
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import Kind
from motor_model.errors import RecordingError

PERIOD = 0.01
STAMPS = np.arange(500) * PERIOD
DRIVE = np.where(np.random.default_rng(3).integers(0, 2, 50).repeat(10) > 0, 0.8, -0.6)
SPEED = np.zeros(500)
for k in range(499):
    SPEED[k + 1] = SPEED[k] + (200.0 * DRIVE[k] - SPEED[k]) * 0.18
ANGLE = np.cumsum(SPEED) * PERIOD  # [rad]
PER = {"rad/s": 1.0, "deg/s": 1.0 / radians(1.0), "rpm": 30.0 / pi, "rev/s": 0.5 / pi}


def log(unit: str, slip: float = 1.0, counts: int = 1024) -> dict[str, np.ndarray]:
    """Degrees in steps of counts, and the noisy, late speed that a board made of them, in some unit."""
    degrees = np.floor(ANGLE / (2.0 * pi) * counts) * 360.0 / counts
    noise = np.random.default_rng(1).normal(0.0, 5.0, 500)
    return {"t": STAMPS, "u": DRIVE, "alpha": degrees, "vel": slip * PER[unit] * (np.roll(SPEED, 1) + noise)}


def table(cells: dict[str, np.ndarray], **names: str) -> Table:
    renamed = {names.get(name, name): column for name, column in cells.items()}
    return Table(Path("log.csv"), np.arange(2, 502), renamed)


@pytest.mark.parametrize("unit", ["rad/s", "deg/s", "rpm", "rev/s"])
def test_a_counted_angle_is_taken_before_a_speed_of_any_unit(unit: str) -> None:
    found = guess_forms(table(log(unit)), Said())
    (form,) = found.forms
    assert (form.motion, form.kind, form.unit) == ("alpha", Kind.POSITION, "deg")
    said = "Motion: alpha, a position in deg (steps of 0.3516 are 1024 counts a turn in deg"
    assert any(line.startswith(said) and line.endswith("--speed vel).") for line in found.findings)


def test_a_systems_output_is_a_speed_where_a_counted_angle_says_so() -> None:
    """A position that begins somewhere else once is still that of its shaft."""
    cells = log("rpm")
    count = 360.0 / 1024
    jump = count * np.rint(0.14 * np.ptp(cells["alpha"]) / count)
    jumped = {**cells, "alpha": cells["alpha"] - jump * (STAMPS > 0.3)}
    for one in (cells, jumped):
        (form,) = guess_forms(table(one, vel="y"), Said()).forms
        assert (form.motion, form.kind, form.unit) == ("alpha", Kind.POSITION, "deg")


@pytest.mark.parametrize(
    ("said", "motion"), [(Said(motion="vel", kind=Kind.SPEED, unit="rpm"), "vel"), (Said(unit="rpm"), "vel")]
)
def test_the_speed_where_it_is_said(said: Said, motion: str) -> None:
    assert guess_forms(table(log("rpm")), said).forms[0].motion == motion


@pytest.mark.parametrize(("slip", "told"), [(1.05, True), (0.95, True), (1.1, False), (0.9, False), (3.0, False)])
def test_both_are_of_one_shaft(slip: float, told: bool) -> None:
    pair, taken = Pair("", "u", "vel"), frozenset({"t"})
    assert (find_counted_position(table(log("rpm", slip)), pair, taken, STAMPS) == Counted("alpha", "vel")) is told
    named = find_counted_position(table(log("rpm", slip), vel="vel_rpm"), Pair("", "u", "vel_rpm"), taken, STAMPS)
    assert (named is not None) is told
    assert find_counted_position(table(log("rpm"), vel="vel_dps"), Pair("", "u", "vel_dps"), taken, STAMPS) is None


def test_a_column_that_goes_another_way_is_no_position() -> None:
    cells = log("rpm")
    pair, taken = Pair("", "u", "vel"), frozenset({"t"})
    noisy = cells["alpha"] + np.random.default_rng(4).normal(0.0, 0.3, 500)  # nothing tells its unit
    for other in (np.cumsum(DRIVE), np.flip(cells["alpha"]), np.zeros(500), noisy):
        assert find_counted_position(table({**cells, "alpha": other}), pair, taken, STAMPS) is None
    assert find_counted_position(table(cells), pair, frozenset({"t", "alpha"}), STAMPS) is None
    assert find_counted_position(table(cells), Pair("", "u", "alpha"), taken, STAMPS) is None


@pytest.mark.parametrize(("unit", "size"), [("rad", 1.0), ("deg", 180.0 / pi), ("rev", 0.5 / pi)])
def test_a_known_speed_tells_the_unit_of_a_position(unit: str, size: float) -> None:
    rng = np.random.default_rng(2)
    cells = {**log("rpm"), "alpha": size * (ANGLE + rng.normal(0.0, 1e-3, 500))}
    found = tell_position_unit(table(cells, vel="rpm"), read_heading("alpha"), STAMPS)
    assert found is not None and found.name == unit and found.why == "as rpm in rpm says; otherwise: --unit"
    assert tell_position_unit(table(cells), read_heading("alpha"), STAMPS) is None  # of an unknown unit itself
    assert tell_position_unit(table(cells, vel="left_rpm"), read_heading("alpha"), STAMPS) is None
    (form,) = guess_forms(table(cells, vel="rpm", alpha="position"), Said()).forms
    assert (form.motion, form.unit) == ("position", unit)


@pytest.mark.parametrize("unit", sorted(PER))
def test_an_angle_tells_the_unit_of_its_derivative(unit: str) -> None:
    """Yaw goes to 180° and on from -180°; a number of degrees beyond 2π is no radians."""
    cells = {**log(unit), "alpha": (np.degrees(ANGLE) + 180.0) % 360.0 - 180.0}
    found = tell_speed_unit(table(cells, alpha="yaw"), read_heading("vel"), STAMPS)
    assert found is not None and found.name == unit
    assert found.why == "as yaw in deg says, whose derivative it is; otherwise: --unit"
    for other in ("yaw_error", "left_yaw", "alpha"):
        assert tell_speed_unit(table(cells, alpha=other), read_heading("vel"), STAMPS) is None
    (form,) = guess_forms(table(cells, alpha="yaw", vel="yaw_velocity"), Said(motion="yaw_velocity")).forms
    assert (form.kind, form.unit) == (Kind.SPEED, unit)


@pytest.mark.parametrize(("most", "told"), [(6.0, False), (6.5, True)])
def test_an_orientation_beyond_a_turn_in_radians_is_in_degrees(most: float, told: bool) -> None:
    cells = {**log("deg/s"), "alpha": ANGLE * most / np.max(np.abs(ANGLE))}
    cells["vel"] = np.gradient(cells["alpha"], STAMPS)
    found = tell_speed_unit(table(cells, alpha="yaw"), read_heading("vel"), STAMPS)
    assert (found.name if found else None) == ("deg/s" if told else None)


@pytest.mark.parametrize(("slip", "told"), [(0.77, True), (0.73, False)])
def test_a_gyro_may_be_tilted(slip: float, told: bool) -> None:
    cells = {**log("deg/s"), "vel": np.degrees(SPEED) / slip}
    assert (tell_speed_unit(table(cells, alpha="theta_deg"), read_heading("vel"), STAMPS) is not None) is told


def test_drives_of_axes_are_of_their_motors() -> None:
    """A turret's two axes, each with a duty and a speed in deg/s beside an angle that is no motor's shaft."""
    one = {"t": STAMPS, "yaw": np.degrees(ANGLE), "pitch": np.degrees(ANGLE[::-1].copy())}
    speeds = {"yaw_velocity": np.degrees(SPEED), "pitch_velocity": np.degrees(-SPEED[::-1])}
    drives = {"yaw_duty_cycle": DRIVE, "pitch_duty_cycle": -DRIVE[::-1]}
    both = Table(Path("log.csv"), np.arange(2, 502), {**one, **speeds, **drives})
    forms = guess_forms(both, Said(supply_voltage=12.0)).forms
    assert {(form.label, form.voltage, form.motion, form.unit, form.voltage_scale) for form in forms} == {
        (axis, f"{axis}_duty_cycle", f"{axis}_velocity", "deg/s", 12.0) for axis in ("yaw", "pitch")
    }
    with pytest.raises(RecordingError, match=r"yaw_duty_cycle as a duty of ±1 .*--supply-voltage V"):
        guess_forms(both, Said(voltage="yaw_duty_cycle", motion="yaw_velocity"))
    for said in (Said(voltage="pitch_duty_cycle"), Said(motion="pitch_velocity")):  # of the axis that is named
        (form,) = guess_forms(both, replace(said, supply_voltage=12.0)).forms
        assert (form.voltage, form.motion) == ("pitch_duty_cycle", "pitch_velocity")


def test_whole_positions_beside_a_speed_are_counts() -> None:
    cells = {**log("rpm"), "alpha": np.floor(ANGLE / (2.0 * pi) * 540), "vel": SPEED * PER["rpm"]}
    found = guess_forms(table(cells, vel="rpm", alpha="position"), Said())
    (form,) = found.forms
    assert (form.motion, form.kind, form.unit, form.edges_per_revolution) == ("position", Kind.COUNT, "count", 540)
    assert not form.increments


def test_whole_speeds_of_no_unit_may_be_counts_of_each_row() -> None:
    cells = {**log("rpm"), "alpha": np.zeros(500)}
    for speed, offered in ((np.rint(SPEED / 9.7), True), (np.round(SPEED / 9.7, 1), False)):
        with pytest.raises(RecordingError, match="vel in .* which the numbers do not tell: say --unit") as complaint:
            guess_forms(table({**cells, "vel": speed}), Said())
        counts = "--unit, or --count vel and --edges-per-revolution N where they are the counts of each row."
        assert (counts in str(complaint.value)) is offered


@pytest.mark.parametrize(("wrong", "found"), [(0.0, True), (0.05, True), (0.2, False)])
def test_counts_of_each_row_are_told_by_their_sum(wrong: float, found: bool) -> None:
    """As where a board prints `mStep` and `mVel`, which is what the row added, and nothing tells of a unit."""
    rows = np.rint(SPEED / 9.7)
    off = np.where(np.random.default_rng(1).uniform(size=500) < wrong, 1.0, 0.0)
    cells = {**log("rpm"), "alpha": np.cumsum(rows), "vel": rows + off}
    counted = find_summed_counts(table(cells), Pair("", "u", "vel"), frozenset({"t"}))
    assert counted == (Counted("alpha", "vel", whole=True) if found else None)
    asked = r"alpha in count: say how many counts" if found else "vel in .* say --unit"
    with pytest.raises(RecordingError, match=asked):
        guess_forms(table(cells), Said())
    (form,) = guess_forms(table(cells), Said(edges_per_revolution=160, unit=None if found else "rpm")).forms
    assert (form.motion, form.kind) == (("alpha", Kind.COUNT) if found else ("vel", Kind.SPEED))


PENDULUM = 3.0 * np.sin(STAMPS * 9.0) + np.cumsum(np.random.default_rng(2).normal(0.0, 0.3, 500))


@pytest.mark.parametrize(
    ("position", "found"),
    [
        (PENDULUM, "omega"),  # of an arm that the motor's propeller moves
        (ANGLE, ""),
        (-ANGLE, ""),  # counted the other way
        (np.floor(ANGLE * 40.0) % 4096.0, ""),  # begins again at a register's size
        (np.floor(ANGLE * 4.0), ""),
    ],
)
def test_a_position_of_something_else_than_what_the_drive_turns(position: np.ndarray, found: str) -> None:
    cells = {"t": STAMPS, "u": DRIVE, "theta": position, "omega": SPEED}
    headings = [read_heading(name) for name in ("theta", "omega")]
    for time in ("t", None):
        assert find_driven_speed(table(cells), Pair("", "u", "theta"), headings, time) == found
    assert find_driven_speed(table(cells), Pair("", "u", "theta"), [*headings, read_heading("speed")], "t") == ""
    steps = table({**cells, "ticks": np.diff(np.floor(ANGLE * 4.0), prepend=0.0)})
    assert find_driven_speed(steps, Pair("", "u", "ticks"), headings, "t") == ""  # counts of each row


def test_the_speed_is_read_and_the_position_said_to_be_left_out() -> None:
    cells = {"t": STAMPS, "u": DRIVE, "theta": PENDULUM, "omega [rad/s]": SPEED}
    guess = guess_forms(table(cells), Said())
    assert (guess.forms[0].motion, guess.forms[0].kind) == ("omega [rad/s]", Kind.SPEED)
    assert (
        "Left out: theta, which is not the angle of what turns with omega [rad/s], and does not follow u (otherwise: "
        "--position theta)." in guess.findings
    )
    assert guess_forms(table(cells), Said(motion="theta", kind=Kind.POSITION, unit="deg")).forms[0].motion == "theta"
