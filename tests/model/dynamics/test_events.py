"""Where a piece ends: the shaft at rest, or its play taken up."""

from math import log

import pytest
from numpy.typing import NDArray

from motor_model.dynamics.events import solve, time_of_rest, until_event
from motor_model.dynamics.linear import Coefficients
from motor_model.dynamics.state import State
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

BRAKED = Coefficients(PAPER_KA, 0.5, 0.0, -2.0, PAPER_KV, 0.0)  # -2 V against 0.5 V of friction
H = 0.2


def vector(lag: float = 0.0) -> NDArray:  # type: ignore[type-arg]
    effects = ("armature_inductance",) if lag else ()
    values = {"electrical_time_constant": lag} if lag else {}
    return Parameters({"kv": PAPER_KV, "ka": PAPER_KA} | values, effects).vector()


def moving(speed: float, play: float = 0.0, drive: float = 0.0) -> State:
    return State(1.0, speed, drive, play, 1.0 if speed > 0.0 else -1.0, 0.0)


def test_the_time_of_rest_of_a_braked_motor_is_a_logarithm() -> None:
    expected = PAPER_KA / PAPER_KV * log(1.0 + PAPER_KV * 30.0 / 2.5)
    assert time_of_rest(vector(), BRAKED, moving(30.0), H) == pytest.approx(expected, rel=1e-12)
    undamped = BRAKED._replace(back_emf=0.0)
    assert time_of_rest(vector(), undamped, moving(30.0), H) == pytest.approx(PAPER_KA * 30.0 / 2.5, rel=1e-12)


@pytest.mark.parametrize("c", [BRAKED._replace(gradient=5.0), BRAKED._replace(slope=-0.02, gradient=5.0)])
@pytest.mark.parametrize("lag", [0.0, 0.004])
def test_the_time_of_rest_is_where_the_speed_is_zero(c: Coefficients, lag: float) -> None:
    p, s = vector(lag), moving(30.0, drive=-2.0)
    instant = time_of_rest(p, c, s, H)
    assert 0.0 < instant < H and abs(solve(p, c, s, instant)[0]) < 1e-9


@pytest.mark.parametrize("speed", [1e-3, -1e-163])
def test_a_motor_that_coasts_to_ever_lower_speeds_never_rests(speed: float) -> None:
    """The square of the second speed is 0 in double precision: a drag without any friction then takes nothing."""
    coasting = Coefficients(PAPER_KA, 0.0, 0.0, 0.0, PAPER_KV, 0.0)
    assert time_of_rest(vector(), coasting, moving(speed), H) == H


def test_a_piece_without_an_event_is_solved_to_its_end() -> None:
    state, taken = until_event(vector(), BRAKED, moving(30.0), 0.01)
    speed, _, travel = solve(vector(), BRAKED, moving(30.0), 0.01)
    assert taken == 0.01 and (state.speed, state.angle) == pytest.approx((speed, 1.0 + travel))
    assert state.speed > 0.0


@pytest.mark.parametrize("lag", [0.0, 0.004])
def test_a_shaft_that_comes_to_rest_ends_the_piece_there(lag: float) -> None:
    state, taken = until_event(vector(lag), BRAKED, moving(30.0, drive=-2.0), H)
    assert state.speed == 0.0 and state.direction == 1.0 and 0.0 < taken < H
    assert taken == pytest.approx(time_of_rest(vector(lag), BRAKED, moving(30.0, drive=-2.0), H))


def test_play_is_used_up_by_travel_and_ends_the_piece_where_it_is_gone() -> None:
    free, taken = until_event(vector(), BRAKED, moving(30.0, play=1.0), 0.01)
    assert taken == 0.01 and free.play == pytest.approx(1.0 - (free.angle - 1.0)) and 0.7 < free.play < 0.8
    caught, sooner = until_event(vector(), BRAKED, moving(30.0, play=0.1), 0.01)
    assert caught.play == 0.0 and caught.angle == pytest.approx(1.1, abs=1e-12)
    assert 0.1 / 30.0 < sooner < 0.01


def test_a_start_whose_cause_is_gone_is_none() -> None:
    """It was to start forward, but what drives it drives backward: it has not moved."""
    state, taken = until_event(vector(), BRAKED, State(1.0, 0.0, 0.0, 0.0, 1.0, 0.0), 0.01)
    assert (state.angle, state.speed, taken) == (1.0, 0.0, 0.01)


def test_a_reversal_within_a_piece_of_a_motor_with_inductance_is_not_passed_over() -> None:
    """Its speed is positive again at the end; in between the shaft stood."""
    p, forward = vector(0.02), BRAKED._replace(source=8.0, torque=0.0)
    s = moving(4.0, drive=-6.0)
    assert solve(p, forward, s, 0.06)[0] > 0.0
    state, taken = until_event(p, forward, s, 0.06)
    assert state.speed == 0.0 and 0.0 < taken < 0.02


@pytest.mark.parametrize("drive", [4.9e-316, 1e-300, 1e-14, 0.0])
def test_a_settled_current_has_no_extreme_of_its_own(drive: float) -> None:
    """After thousands of electrical time constants what is left of it is no number to divide by."""
    p, forward = vector(0.001), BRAKED._replace(source=-3.3, torque=0.0)
    settled, s = until_event(p, forward, moving(141.6), 0.01), moving(141.6, drive=drive)
    state, taken = until_event(p, forward, s, 0.01)
    assert taken == settled[1] and state.speed == pytest.approx(settled[0].speed, rel=1e-9)
    assert 0.0 < state.speed < 141.6
