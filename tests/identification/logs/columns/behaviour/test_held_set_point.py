"""A controller's log, of rows far apart, is told from a static curve beside which something else is held."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.behaviour.held_set_point import FOLLOWS, OFF_CURVE, STAYS, holds_a_set_point
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import Kind
from motor_identification.logs.signals import Floats

ROWS = 60
LEVELS = np.where(np.arange(ROWS) < ROWS // 2, 100.0, -80.0)
SETTLES = 1.0 - np.exp(-(np.arange(ROWS) % (ROWS // 2)) / 3.0)
DRIVE = 0.1 * LEVELS * (2.0 - SETTLES)  # more of it, where the motor has still to come there
SPEED = LEVELS * SETTLES
CURVE = np.linspace(1.0, 9.0, ROWS)


def held(target: str, values: Floats, motion: Floats = SPEED, drive: Floats = DRIVE, name: str = "speed [rpm]") -> bool:
    columns = {"u [V]": drive, name: motion, target: values}
    cells = {one: np.array([f"{value:.9g}" for value in column]) for one, column in columns.items()}
    return holds_a_set_point(Table(Path("log.csv"), np.arange(ROWS), cells), Pair("", "u [V]", name), Said())


@pytest.mark.parametrize(
    ("target", "of_motion"),
    [
        ("Setpoint(RPM)", True),
        ("setpoint", True),
        ("target speed", True),
        ("load_setpoint [A]", False),
        ("current setpoint", False),
        ("ref voltage", False),
        ("setpoint [%]", False),
        ("target [deg]", False),
        ("target angle", False),
    ],
)
def test_a_set_point_is_of_what_moves(target: str, of_motion: bool) -> None:
    assert held(target, LEVELS) == of_motion


def test_a_set_point_in_another_unit_is_compared_in_that_of_the_motion() -> None:
    assert held("target [rad/s]", LEVELS * 2.0 * np.pi / 60.0)
    assert not held("target [rad/s]", LEVELS)  # 9.5 times as large as the speed
    assert not held("target [count/s]", LEVELS)  # of what, nothing tells
    assert held("target", LEVELS, name="motor speed") and held("target [rpm]", LEVELS, name="motor speed")


def test_a_position_has_a_set_point_of_its_own() -> None:
    assert held("target [deg]", LEVELS, name="position [deg]") and held("target", LEVELS, name="position [deg]")
    assert not held("target [rpm]", LEVELS, name="position [deg]")
    assert not held("target speed", LEVELS, name="position [deg]")


def test_what_the_user_says_of_a_motion_without_a_name_counts() -> None:
    columns = {"u [V]": DRIVE, "y": SPEED, "target speed": LEVELS}
    table = Table(Path("log.csv"), np.arange(ROWS), {one: column.astype(str) for one, column in columns.items()})
    assert holds_a_set_point(table, Pair("", "u [V]", "y"), Said(kind=Kind.SPEED))
    assert not holds_a_set_point(table, Pair("", "u [V]", "y"), Said(kind=Kind.POSITION))


@pytest.mark.parametrize("times", [0.9, 1.1])
def test_a_motion_is_about_as_large_as_its_set_point(times: float) -> None:
    """A limit, or another thing's target, is of any size; both ends of the range."""
    middle = float(np.median(SPEED / LEVELS))
    assert held("setpoint", LEVELS * middle / (FOLLOWS * times)) == (times > 1.0)
    assert held("setpoint", LEVELS * middle * FOLLOWS / times) == (times < 1.0)
    assert not held("setpoint", -LEVELS) and not held("setpoint", 0.0 * LEVELS)


@pytest.mark.parametrize(("share", "stays"), [(STAYS - 0.1, True), (STAYS + 0.1, False)])
def test_a_set_point_stays_in_most_rows(share: float, stays: bool) -> None:
    at = np.round(np.arange(ROWS) * share)  # goes on in this share of the rows
    assert held("setpoint", LEVELS * (1.0 + 1e-3 * (at % 2.0))) == stays


def test_rows_that_have_settled_are_a_curve_whoever_gave_the_voltage() -> None:
    stairs = np.repeat(np.arange(10.0, 70.0, 10.0), ROWS // 6)
    settled = 0.1 * stairs + 0.5 + 0.01 * np.sin(np.arange(ROWS))
    assert not held("setpoint [rpm]", stairs, stairs, settled)
    assert not held("setpoint [rpm]", np.full(ROWS, 50.0), 10.0 * CURVE, CURVE)


@pytest.mark.parametrize(
    ("off", "curve"), [(0.05, True), (0.8 * OFF_CURVE, True), (1.3 * OFF_CURVE, False), (0.4, False)]
)
def test_one_row_that_has_not_settled_is_enough(off: float, curve: bool) -> None:
    speed = 10.0 * CURVE
    speed[ROWS // 2] -= off * float(np.ptp(speed))
    assert held("setpoint [rpm]", np.full(ROWS, 50.0), speed, CURVE) != curve


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("size", [1e-308, 1.7e308])
def test_numbers_of_any_size_warn_of_nothing(size: float) -> None:
    huge = np.where(np.arange(ROWS) % 2 == 0, size, -size)
    assert not held("setpoint [rpm]", LEVELS, huge) and not held("setpoint [rpm]", np.full(ROWS, size))
    assert not held("setpoint [rpm]", LEVELS, huge, huge)
