"""Many rows of a plain motor in one loop: to the last bit what it is moved on by, row by row; and where that ends."""

from math import inf

import numpy as np
import pytest
from numpy.typing import NDArray

from motor_model.dynamics.motor import advance
from motor_model.dynamics.rows import Commands, Reached, find_switch, is_plain, pass_rows
from motor_model.dynamics.state import at_rest
from motor_model.dynamics.straight import find_straight, find_torques, prepare_hold
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

Floats = NDArray[np.float64]
ROWS = 0.001 * np.arange(600)
TOLD = Commands(np.array([0.0, 0.1005, 0.2]), np.array([6.0, 9.0, 0.2]), 0.0)
FRICTION = {"ks": 0.5}
STATIC = {"ks": 0.3, "breakaway_voltage": 0.8, "stribeck_speed": 2.0}
STEP = {"step_voltage": 0.5, "step_time": 0.3}


def vector(*effects: str, **values: float) -> Floats:
    return Parameters({"kv": PAPER_KV, "ka": PAPER_KA} | values, effects, max_voltage=12.0).vector()


def begin(p: Floats, speed: float, told: Commands = TOLD) -> Reached:
    """At the first row, turning or at rest."""
    hold = prepare_hold(p, told.values[0], find_torques(p, 0.0))
    s = at_rest(0.0)._replace(speed=speed, direction=np.sign(speed))
    return Reached(0.0, s, told.values[0], 1, 0, find_switch(told, 0), hold)


def passed(p: Floats, speed: float, told: Commands = TOLD, before: float = inf) -> tuple[Reached, Floats, Floats]:
    angle, speeds = np.zeros(len(ROWS)), np.zeros(len(ROWS))
    reached = pass_rows(p, find_straight(p).least, told, begin(p, speed, told), before, ROWS, angle, speeds)
    return reached, angle, speeds


def stepped(p: Floats, speed: float, rows: int) -> Floats:
    """The angle at some rows of a motor that every row and every command stops at."""
    s, t, angles = at_rest(0.0)._replace(speed=speed, direction=np.sign(speed)), 0.0, [0.0]
    for until in ROWS[1:rows]:
        for change in (*TOLD.time[(TOLD.time > t) & (TOLD.time < until)], until):
            s = advance(p, TOLD.values[np.searchsorted(TOLD.time, t, "right") - 1], s, t, change - t)
            t = change
        angles.append(s.angle)
    return np.array(angles)


def test_plain_is_what_is_straight_and_changes_by_nothing_else() -> None:
    plain = [vector(), vector("coulomb_friction", ks=0.4), vector("static_friction", **STATIC)]
    plain.append(vector("backlash", backlash_angle=0.2, load_fraction=0.5))
    other = [
        vector("armature_inductance", electrical_time_constant=0.004),
        vector("torque_ripple", ripple_voltage=0.1, ripple_cycles=3.0, ripple_phase=0.5),
        vector("warm_up", resistance_rise=0.2, warm_up_time=3.0),
        vector("quadratic_drag", drag=1e-4),
    ]
    for motors, expected in ((plain, True), (other, False)):
        assert all(is_plain(p, find_straight(p)) is expected for p in motors)


def test_rows_are_what_steps_from_one_to_the_next_come_to() -> None:
    p = vector("coulomb_friction", **FRICTION)
    reached, angle, speed = passed(p, 20.0)
    rows = reached.row
    assert ROWS[rows - 1] > TOLD.time[2] and reached.number == 2  # commands at a row and between two
    assert angle[:rows] == pytest.approx(stepped(p, 20.0, rows), abs=1e-11)
    assert (angle[rows - 1], speed[rows - 1]) == (reached.state.angle, reached.state.speed)
    assert ROWS[rows - 1] == reached.time


def test_what_comes_to_rest_is_left_to_who_knows_how() -> None:
    reached, _, speed = passed(vector("coulomb_friction", **FRICTION), 20.0)
    assert reached.row < len(ROWS) and reached.state.speed > 0.0  # 0.2 V do not hold it against 0.5 V of friction
    slower = passed(vector("static_friction", **STATIC), 20.0)[0]
    assert slower.row < reached.row  # Stribeck friction bends before
    assert find_straight(vector("static_friction", **STATIC)).least < slower.state.speed
    assert not speed[reached.row :].any()


@pytest.mark.parametrize(("volts", "leaves"), [(0.79, False), (0.81, True)])
def test_a_motor_rests_until_a_command_breaks_it_away(volts: float, leaves: bool) -> None:
    told = Commands(np.array([0.0, 0.2]), np.array([0.0, volts]), 0.01)
    reached, angle, speed = passed(vector("static_friction", **STATIC), 0.0, told)
    assert not angle.any() and not speed.any()
    assert (reached.row < len(ROWS)) is leaves
    assert reached.time == pytest.approx(0.21 if leaves else ROWS[-1])


def test_a_load_step_is_not_passed() -> None:
    p = vector("load_step", **STEP)
    reached, _, speed = passed(p, 20.0, before=STEP["step_time"])
    assert ROWS[reached.row - 1] < STEP["step_time"] <= ROWS[reached.row] + 1e-12
    assert not speed[reached.row :].any()
