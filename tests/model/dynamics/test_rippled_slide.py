"""Pieces that are prepared once for a step are the pieces of any motion, and are left to these near a standstill."""

import numpy as np
import pytest
from numpy.typing import NDArray

from motor_model.dynamics.linear import Coefficients, first_order
from motor_model.dynamics.motor import advance
from motor_model.dynamics.rippled_slide import relax, slide
from motor_model.dynamics.rippling import turn_on
from motor_model.dynamics.state import State
from motor_model.dynamics.straight import begin_lag, find_straight, find_torques, prepare_hold
from motor_model.parameters import Parameters

FINE = 200  # pieces' share of a step, beside which it is judged
SLOW = {"kv": 0.07, "ka": 0.0055, "ripple_voltage": 0.3, "ripple_cycles": 5.0, "ripple_phase": 0.3}


def motor(values: dict[str, float], *effects: str) -> NDArray:  # type: ignore[type-arg]
    return Parameters(values, ("torque_ripple", *effects), max_voltage=12.0).vector()


def step(p: NDArray, u: float, s: State, h: float, least: float = 0.0) -> tuple[float, float]:  # type: ignore[type-arg]
    return slide(p, prepare_hold(p, u, find_torques(p, 0.0)), s, h, 1.0, least)


def advanced(p: NDArray, u: float, s: State, h: float, parts: int = FINE) -> State:  # type: ignore[type-arg]
    for k in range(parts):
        s = advance(p, u, s, k * h / parts, h / parts)
    return s


def test_it_turns_as_pieces_do_and_as_exactly() -> None:
    """Motors of all sizes that speed up and slow down: what both leave beside pieces that are far shorter."""
    random, own, peers = np.random.default_rng(2), [], []
    for _ in range(400):
        top, lag = 10.0 ** random.uniform(0.5, 3.0), 10.0 ** random.uniform(-2.0, 0.0)
        values = {"kv": 12.0 / top, "ka": 12.0 / top * lag, "ripple_phase": random.uniform(-3.0, 3.0)}
        values |= {"ripple_voltage": random.uniform(0.05, 1.0), "ripple_cycles": 10.0 ** random.uniform(-0.3, 2.0)}
        values |= {"ks": 0.6, "bias_voltage": random.uniform(-0.5, 0.5), "coast_share": 0.4}
        p, way = motor(values, "coulomb_friction", "load_bias", "coast_drive"), random.choice([-1.0, 1.0])
        u, speed = way * random.uniform(2.0, 12.0), way * random.uniform(0.3, 1.0) * top
        s = State(random.uniform(-5.0, 5.0), speed, 0.0, 0.0, way, random.uniform(-1.0, 1.0))
        h = lag * 10.0 ** random.uniform(-2.0, -0.5)
        then, travel = step(p, u, s, h)
        if then == 0.0:
            continue
        fine, pieces = advanced(p, u, s, h), advance(p, u, s, 0.0, h)
        for errors, at, gone in ((own, then, travel), (peers, pieces.speed, pieces.angle - s.angle)):
            errors.append(max(abs(at - fine.speed), abs(gone - fine.angle + s.angle) / h) / abs(speed))
    assert len(own) > 300
    assert np.median(own) < 1e-7 and max(own) < 1e-4
    assert np.quantile(own, 0.9) < 2.0 * np.quantile(peers, 0.9)


@pytest.mark.parametrize(("u", "least", "turns"), [(8.0, 0.0, True), (-12.0, 0.0, False), (8.0, 200.0, False)])
def test_a_shaft_that_may_come_to_rest_is_left_to_the_pieces(u: float, least: float, turns: bool) -> None:
    then, travel = step(motor(SLOW), u, State(0.0, 60.0, 0.0, 0.0, 1.0, 0.0), 0.05, least)
    assert (then > 0.0 and travel > 0.0) is turns


def test_a_slow_ripple_of_a_turning_motor_is_had_so() -> None:
    """By the step that roll-outs take: the same as alone; with inductance there is none."""
    s, h = State(0.4, 60.0, 0.0, 0.0, 1.0, 0.2), 0.004
    p = motor(SLOW)
    hold = prepare_hold(p, 8.0, find_torques(p, 0.0))
    then, _drive, travel, _ = turn_on(p, hold, s, h, 1.0, find_straight(p).least, begin_lag())
    assert (then, travel) == step(p, 8.0, s, h) and then > 0.0
    lagging = motor(SLOW | {"electrical_time_constant": 0.002}, "armature_inductance")
    assert turn_on(lagging, hold, s, h, 1.0, 0.0, begin_lag())[0] == 0.0


def test_directions_are_alike() -> None:
    ahead, back = motor(SLOW), motor(SLOW | {"ripple_phase": -0.3})
    one = step(ahead, 8.0, State(0.2, 60.0, 0.0, 0.0, 1.0, 0.1), 0.02)
    other = step(back, -8.0, State(-0.2, -60.0, 0.0, 0.0, -1.0, -0.1), 0.02)
    assert one == pytest.approx([-value for value in other], rel=1e-12)


@pytest.mark.parametrize("rate", [0.0, 3.0, 80.0])
def test_what_is_prepared_is_the_motion_of_a_piece(rate: float) -> None:
    """An acceleration of 40 rad/s² that grows by 900 rad/s³, from 2 rad/s on."""
    then, travel = first_order(Coefficients(1.0, -40.0 - rate * 2.0, 0.0, 0.0, rate, -900.0), 2.0, 0.03)
    one = relax(rate, 0.03)
    assert 2.0 + 40.0 * one.speed + 900.0 * one.travel == pytest.approx(then, rel=1e-12)
    assert 2.0 * one.time + 40.0 * one.travel + 900.0 * one.further == pytest.approx(travel, rel=1e-12)
