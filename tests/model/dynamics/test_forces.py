"""The terms of the equation, each alone: sizes, signs, and slopes that are those of the curves."""

from math import copysign, e, pi, sin

import pytest
from numpy.typing import NDArray

from motor_model.dynamics.forces import (
    GONE,
    drag_curvature_at,
    drive_of,
    friction_at,
    friction_slope_at,
    is_bent,
    load_slope_at,
    loads_at,
    warmth,
)
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters

BASE = {"kv": PAPER_KV, "ka": PAPER_KA}
STATIC = {"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 5.0, "drag": 1e-4}
RIPPLE = {"ripple_voltage": 0.4, "ripple_cycles": 12.0, "ripple_phase": 0.3}


def vector(*effects: str, **values: float) -> NDArray:  # type: ignore[type-arg]
    return Parameters(BASE | values, effects).vector()


def test_copper_warms_up_exponentially() -> None:
    warm = vector("warm_up", resistance_rise=0.3, warm_up_time=20.0)
    assert warmth(warm, 0.0) == 1.0
    assert warmth(warm, 20.0) == pytest.approx(1.0 + 0.3 * (1.0 - 1.0 / e))
    assert warmth(warm, 1e4) == pytest.approx(1.3)
    assert warmth(vector(), 1e4) == 1.0


def test_loads_add_up_and_the_step_comes_at_its_time() -> None:
    p = vector("load_bias", "load_step", bias_voltage=-0.2, step_voltage=0.5, step_time=3.0)
    assert loads_at(p, 0.0, 2.999) == -0.2
    assert loads_at(p, 0.0, 3.0) == pytest.approx(0.3)
    rippled = vector("load_bias", "torque_ripple", bias_voltage=-0.2, **RIPPLE)
    for angle in (0.0, 0.1, -7.0):
        assert loads_at(rippled, angle, 0.0) == pytest.approx(-0.2 + 0.4 * sin(12.0 * angle + 0.3))
    assert loads_at(rippled, 2.0 * pi, 0.0) == pytest.approx(loads_at(rippled, 0.0, 0.0))


@pytest.mark.parametrize("angle", [0.0, 0.11, 0.2, -3.0])
def test_the_loads_slope_is_that_of_the_loads(angle: float) -> None:
    p = vector("torque_ripple", **RIPPLE)
    slope = (loads_at(p, angle + 1e-6, 0.0) - loads_at(p, angle - 1e-6, 0.0)) / 2e-6
    assert load_slope_at(p, angle) == pytest.approx(slope, rel=1e-6, abs=1e-7)
    assert load_slope_at(vector(), angle) == 0.0


def test_friction_falls_from_breakaway_to_sliding_and_rises_with_drag() -> None:
    p = vector("static_friction", "quadratic_drag", **STATIC)
    assert friction_at(p, 0.0, 1.0) == pytest.approx(0.9)
    assert friction_at(p, 5.0, 1.0) == pytest.approx(0.4 + 0.5 / e + 1e-4 * 25.0)
    assert friction_at(p, 100.0, 1.0) == pytest.approx(0.4 + 1.0)
    assert friction_at(vector("coulomb_friction", ks=0.4), 0.0, 1.0) == 0.4


def test_stribeck_friction_is_left_out_where_it_is_less_than_rounding() -> None:
    p = vector("static_friction", ks=0.4, breakaway_voltage=0.9, stribeck_speed=5.0)
    before, after = (5.0 * (GONE * share) ** 0.5 for share in (1.0 - 1e-9, 1.0 + 1e-9))
    assert friction_at(p, before, 1.0) == friction_at(p, after, 1.0) == 0.4
    assert -1e-15 < friction_slope_at(p, before) < friction_slope_at(p, after) == 0.0
    assert friction_at(p, 5.0 * 30.0**0.5, 1.0) > 0.4
    assert friction_at(vector(), 100.0, 1.0) == 0.0


@pytest.mark.parametrize("speed", [0.0, 1.0, 5.0, 60.0])
def test_friction_is_the_same_both_ways(speed: float) -> None:
    p = vector("static_friction", "quadratic_drag", **STATIC)
    assert friction_at(p, -speed, -1.0) == -friction_at(p, speed, 1.0)
    assert friction_slope_at(p, -speed) == friction_slope_at(p, speed)


@pytest.mark.parametrize("speed", [0.5, 3.5, 5.0, 60.0])
def test_the_slope_of_friction_is_that_of_friction(speed: float) -> None:
    p = vector("static_friction", "quadratic_drag", **STATIC)
    slope = (friction_at(p, speed + 1e-5, 1.0) - friction_at(p, speed - 1e-5, 1.0)) / 2e-5
    assert friction_slope_at(p, speed) == pytest.approx(slope, rel=1e-6, abs=1e-10)


@pytest.mark.parametrize("speed", [-40.0, 0.5, 60.0])
def test_the_curvature_of_drag_is_that_of_friction(speed: float) -> None:
    p, way = vector("quadratic_drag", drag=1e-4), copysign(1.0, speed)
    below, here, above = (friction_at(p, speed + step, way) for step in (-0.1, 0.0, 0.1))
    assert drag_curvature_at(p, speed) == pytest.approx(0.5 * abs(above - 2.0 * here + below) / 0.01, rel=1e-6)
    assert drag_curvature_at(vector(), speed) == 0.0


def test_only_curves_and_what_warms_up_are_bent() -> None:
    assert is_bent(vector("static_friction", ks=0.4, breakaway_voltage=0.9, stribeck_speed=5.0))
    assert is_bent(vector("quadratic_drag", drag=1e-4))
    assert is_bent(vector("torque_ripple", **RIPPLE))
    assert is_bent(vector("warm_up", resistance_rise=0.3, warm_up_time=2.0))
    assert not is_bent(vector("coulomb_friction", "load_bias", ks=0.5, bias_voltage=0.2))


def test_the_drive_of_a_plain_motor_is_its_voltage_and_back_emf() -> None:
    assert drive_of(vector(), 6.0) == (6.0, PAPER_KV)


def test_a_coasting_bridge_brakes_only_while_it_drives() -> None:
    p = vector("coast_drive", coast_share=0.7)
    assert drive_of(p, 12.0) == pytest.approx((12.0, PAPER_KV))
    assert drive_of(p, 0.0) == pytest.approx((0.0, 0.3 * PAPER_KV))
    assert drive_of(p, -6.0) == pytest.approx((-6.0, 0.65 * PAPER_KV))


def test_sag_divides_the_whole_drive() -> None:
    p = vector("supply_sag", sag=0.2)
    assert drive_of(p, 12.0) == pytest.approx((12.0 / 1.2, PAPER_KV / 1.2))
    assert drive_of(p, -6.0) == pytest.approx((-6.0 / 1.05, PAPER_KV / 1.05))
