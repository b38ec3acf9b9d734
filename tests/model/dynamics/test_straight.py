"""Straight motors: what is one, what friction and loads take of it, and that one with inductance keeps turning."""

from math import inf

import numpy as np
import pytest
from numpy.typing import NDArray

from motor_model.dynamics.forces import friction_at
from motor_model.dynamics.linear import Coefficients, second_order
from motor_model.dynamics.straight import find_straight, find_torques, keeps_turning
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

STATIC = {"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 5.0}
STEP = {"step_voltage": 0.5, "step_time": 1.0}


def vector(*effects: str, **values: float) -> NDArray:  # type: ignore[type-arg]
    return Parameters({"kv": PAPER_KV, "ka": PAPER_KA} | values, effects).vector()


def test_straight_is_what_is_linear_while_nothing_happens() -> None:
    for p in (
        vector("coulomb_friction", "coast_drive", ks=0.4, coast_share=0.5),
        vector("load_step", **STEP),
        vector("backlash", backlash_angle=0.2, load_fraction=0.5),
        vector("armature_inductance", electrical_time_constant=0.01),
        vector("torque_ripple", ripple_voltage=0.1, ripple_cycles=3.0, ripple_phase=0.5),
    ):
        assert find_straight(p).least == 0.0
    assert find_torques(p, 0.0) == (0.0, 0.0, 0.0)  # the ripple is not of the straight motion
    assert find_straight(vector("quadratic_drag", drag=1e-4)).least == inf
    stepping = vector(
        "coulomb_friction", "load_bias", "load_step", ks=0.4, bias_voltage=0.1, step_voltage=0.5, step_time=1.0
    )
    assert find_torques(stepping, 0.99) == pytest.approx((0.5, -0.3, 0.0))
    assert find_torques(stepping, 1.0) == pytest.approx((1.0, 0.2, 0.0))


def test_stribeck_friction_is_straight_where_it_is_gone() -> None:
    p = vector("static_friction", **STATIC)
    least = find_straight(p).least
    assert friction_at(p, 1.001 * least, 1.0) == STATIC["ks"] < friction_at(p, 0.5 * least, 1.0)
    assert find_torques(p, 0.0) == pytest.approx((0.4, -0.4, 0.0))  # what it slides with, not what it breaks away at


def test_a_motor_that_warms_up_is_straight_in_steps_that_its_warmth_hardly_changes_in() -> None:
    warming = find_straight(vector("warm_up", resistance_rise=0.1, warm_up_time=3.0))
    assert warming.least == 0.0 and warming.longest == pytest.approx(0.03)
    assert find_straight(vector("coulomb_friction", ks=0.4)).longest == inf


def test_a_motor_with_inductance_surely_keeps_turning_where_it_is_fast_enough() -> None:
    tau, h = 0.01, 0.005
    for drive in (-8.0, 0.0, 8.0):  # of the current that it begins with
        for speed in np.linspace(1.0, 60.0, 60):
            c = Coefficients(PAPER_KA, 0.3, 0.0, -6.0, PAPER_KV, 0.0)
            slowest = min(second_order(c, tau, speed, drive, part * h)[0] for part in np.linspace(0.05, 1.0, 20))
            for least in (0.0, 20.0):
                if keeps_turning(c, tau, speed, drive, h, least):
                    assert slowest > least
        assert keeps_turning(c, tau, 60.0, drive, h, 0.0) and not keeps_turning(c, tau, 1.0, drive, h, 0.0)
        assert not keeps_turning(c, tau, 60.0, drive, h, 58.0)
        assert not keeps_turning(
            c._replace(slope=-0.1), tau, 60.0, drive, h, 0.0
        )  # speeding up by itself: no such bound
