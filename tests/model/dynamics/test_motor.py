"""The step: when a motor holds and lets go, where a piece ends, and that steps can be joined."""

from math import log

import pytest
from numpy.typing import NDArray

from motor_model.dynamics.motor import advance, piece, time_in_piece
from motor_model.dynamics.state import State, at_rest
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

STATIC = {"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 5.0}


def vector(*effects: str, **values: float) -> NDArray:  # type: ignore[type-arg]
    return Parameters({"kv": PAPER_KV, "ka": PAPER_KA} | values, effects).vector()


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_motor_holds_up_to_its_breakaway_voltage(sign: float) -> None:
    p = vector("static_friction", **STATIC)
    held = advance(p, sign * 0.899, at_rest(0.0), 0.0, 1.0)
    assert (held.angle, held.speed) == (0.0, 0.0)
    assert sign * advance(p, sign * 0.901, at_rest(0.0), 0.0, 0.1).angle > 0.0


def test_a_load_counts_against_what_holds() -> None:
    p = vector("coulomb_friction", "load_bias", ks=0.4, bias_voltage=0.3)
    assert advance(p, 0.69, at_rest(0.0), 0.0, 1.0).angle == 0.0
    assert advance(p, 0.71, at_rest(0.0), 0.0, 1.0).angle > 0.0
    assert advance(p, -0.11, at_rest(0.0), 0.0, 1.0).angle < 0.0


def test_a_motor_with_inductance_lets_go_when_its_current_has_grown() -> None:
    lag = 0.05
    p = vector("coulomb_friction", "armature_inductance", ks=0.4, electrical_time_constant=lag)
    release = lag * log(2.0 / (2.0 - 0.4))  # [s] until 2 V·(1 − e^(−t/τ)) is 0.4 V
    state, taken = piece(p, 2.0, at_rest(0.0), 0.0, 1.0)
    assert taken == pytest.approx(release) and state.drive == pytest.approx(0.4) and state.speed == 0.0
    assert advance(p, 2.0, at_rest(0.0), 0.0, 0.99 * release).angle == 0.0
    assert advance(p, 2.0, at_rest(0.0), 0.0, 1.2 * release).angle > 0.0


def test_a_load_step_ends_the_piece_before_it() -> None:
    p = vector("load_step", step_voltage=0.5, step_time=0.03)
    _, taken = piece(p, 6.0, State(0.0, 40.0, 0.0, 0.0, 1.0, 0.0), 0.0, 0.1)
    assert taken == pytest.approx(0.03)
    _, taken = piece(p, 6.0, State(0.0, 40.0, 0.0, 0.0, 1.0, 0.0), 0.03, 0.1)
    assert taken == 0.1


@pytest.mark.parametrize(
    ("effects", "values", "within"),
    [
        (("coulomb_friction",), {"ks": 0.4}, 1e-12),
        (("armature_inductance", "coulomb_friction"), {"ks": 0.4, "electrical_time_constant": 0.01}, 1e-9),
        (("static_friction",), STATIC, 1e-5),
    ],
)
@pytest.mark.parametrize("command", [6.0, -6.0, 0.0])
def test_two_steps_are_one(effects: tuple[str, ...], values: dict[str, float], within: float, command: float) -> None:
    p, s = vector(*effects, **values), State(0.0, 15.0, 0.0, 0.0, 1.0, 0.0)
    whole = advance(p, command, s, 0.0, 0.2)
    first = advance(p, command, s, 0.0, 0.07)
    again = advance(p, command, first, 0.07, 0.13)
    assert (again.angle, again.speed) == pytest.approx((whole.angle, whole.speed), abs=within * 100.0)


def test_backlash_takes_the_load_away_until_the_play_is_taken_up() -> None:
    p = vector("backlash", backlash_angle=0.2, load_fraction=0.5)
    s = State(0.0, 0.0, 0.0, 0.0, -1.0, 0.0)  # it last ran backward: forward there is play
    free, _ = piece(p, 6.0, s, 0.0, 1e-4)
    taken_up, _ = piece(p, 6.0, s._replace(direction=1.0), 0.0, 1e-4)
    assert free.speed / taken_up.speed == pytest.approx(2.0, rel=1e-2)
    assert free.play == pytest.approx(0.2 - free.angle) and taken_up.play == 0.0


def test_a_swing_without_friction_ends_at_last() -> None:
    p = vector("armature_inductance", "quadratic_drag", electrical_time_constant=0.03, drag=1e-5)
    s = State(0.0, 60.0, 0.0, 0.0, 1.0, 0.0)
    later = advance(p, 0.0, s, 0.0, 0.5)
    assert 0.0 < abs(later.speed) < 0.1
    assert advance(p, 0.0, later, 0.5, 30.0).speed == 0.0
    assert advance(p, 1e-9, later, 0.5, 30.0).speed == pytest.approx(1e-9 / PAPER_KV)  # what is no rounding turns it


def test_the_time_at_which_an_angle_is_passed() -> None:
    for p in (vector("coulomb_friction", ks=0.4), vector("static_friction", **STATIC)):
        s = State(0.0, 60.0, 0.0, 0.0, 1.0, 0.0)
        then, h = piece(p, 8.0, s, 0.0, 0.005)
        instant = time_in_piece(p, 8.0, s, 0.0, h, 0.4 * then.angle)
        assert 0.0 < instant < h
        assert piece(p, 8.0, s, 0.0, instant)[0].angle == pytest.approx(0.4 * then.angle, abs=1e-10)
