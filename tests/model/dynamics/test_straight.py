"""Straight motors: what is one, what friction and loads take of it, and that one with inductance keeps turning."""

import numpy as np
import pytest
from numpy.typing import NDArray

from motor_model.dynamics.linear import Coefficients, second_order
from motor_model.dynamics.straight import find_torques, is_straight, keeps_turning
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
    ):
        assert is_straight(p)
    for p in (
        vector("static_friction", **STATIC),
        vector("quadratic_drag", drag=1e-4),
        vector("torque_ripple", ripple_voltage=0.1, ripple_cycles=3.0, ripple_phase=0.0),
        vector("warm_up", resistance_rise=0.1, warm_up_time=3.0),
    ):
        assert not is_straight(p)
    stepping = vector(
        "coulomb_friction", "load_bias", "load_step", ks=0.4, bias_voltage=0.1, step_voltage=0.5, step_time=1.0
    )
    assert find_torques(stepping, 0.99) == pytest.approx((0.5, -0.3, 0.0))
    assert find_torques(stepping, 1.0) == pytest.approx((1.0, 0.2, 0.0))


def test_a_motor_with_inductance_surely_keeps_turning_where_it_is_fast_enough() -> None:
    tau, h = 0.01, 0.005
    for drive in (-8.0, 0.0, 8.0):  # of the current that it begins with
        for speed in np.linspace(1.0, 60.0, 60):
            c = Coefficients(PAPER_KA, 0.3, 0.0, -6.0, PAPER_KV, 0.0)
            slowest = min(second_order(c, tau, speed, drive, part * h)[0] for part in np.linspace(0.05, 1.0, 20))
            if keeps_turning(c, tau, speed, drive, h):
                assert slowest > 0.0
        assert keeps_turning(c, tau, 60.0, drive, h) and not keeps_turning(c, tau, 1.0, drive, h)
        assert not keeps_turning(c._replace(slope=-0.1), tau, 60.0, drive, h)  # speeding up by itself: no such bound
