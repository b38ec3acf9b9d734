"""The feed-forward against the motor itself: its voltage holds the speed and the acceleration that it was made for."""

import numpy as np
import pytest
from bench_board import BREAKAWAY, motor

from motor_control.controller.feedforward import FeedForward
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.simulate import simulate

EFFECTS = {
    "friction": motor(),
    "drag": motor(("quadratic_drag",), drag=1e-4),
    "bias": motor(("load_bias",), bias_voltage=0.7),
    "dead zone": motor(("dead_zone",), dead_zone_voltage=0.6),
    "asymmetry": motor(("direction_asymmetry",), reverse_gain=0.8),
    "coasting": motor(("coast_drive",), coast_share=0.7),
    "sag": motor(("supply_sag",), sag=0.3),
    "all": motor(
        ("quadratic_drag", "load_bias", "dead_zone", "direction_asymmetry", "coast_drive", "supply_sag"),
        drag=1e-4, bias_voltage=-0.4, dead_zone_voltage=0.3, reverse_gain=1.1, coast_share=0.5, sag=0.1,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", EFFECTS)
@pytest.mark.parametrize("speed", [2.0, 30.0, -60.0])
def test_its_voltage_holds_the_speed(name: str, speed: float) -> None:
    voltage = FeedForward(EFFECTS[name]).voltage(speed, 0.0, 0.0)
    then = simulate(EFFECTS[name], np.array([0.0]), np.array([voltage]), np.array([0.0, 0.02]), speed).speed[-1]
    assert then == pytest.approx(speed, rel=1e-6)
    less = simulate(EFFECTS[name], np.array([0.0]), np.array([0.9 * voltage]), np.array([0.0, 0.02]), speed).speed[-1]
    assert less / speed < 0.999


@pytest.mark.parametrize("name", EFFECTS)
def test_its_voltage_makes_the_acceleration(name: str) -> None:
    voltage = FeedForward(EFFECTS[name]).voltage(30.0, 200.0, 0.0)
    then = simulate(EFFECTS[name], np.array([0.0]), np.array([voltage]), np.array([0.0, 1e-4]), 30.0).speed[-1]
    assert then - 30.0 == pytest.approx(0.02, rel=0.01)


def test_load_friction_and_zero() -> None:
    forward = FeedForward(motor())
    assert forward.voltage(10.0, 0.0, 0.5) - forward.voltage(10.0, 0.0, 0.0) == pytest.approx(0.5)
    assert forward.voltage(0.0, 0.0, 0.0) == 0.0
    assert forward.voltage(1e-9, 0.0, 0.0) == pytest.approx(BREAKAWAY)
    assert forward.voltage(-1e-9, 0.0, 0.0) == pytest.approx(-BREAKAWAY)


def test_what_the_supply_cannot_give_is_asked_for_all_the_same() -> None:
    """The limit is the law's; here only a finite number counts."""
    asked = FeedForward(motor()).voltage(1000.0, 0.0, 0.0)
    assert 11.9 < asked < 1000.0 * PAPER_KV + 1.0


def test_the_fastest_speed_by_the_model() -> None:
    assert FeedForward(Parameters({"kv": PAPER_KV, "ka": PAPER_KA})).fastest == pytest.approx(174.097)
    assert FeedForward(EFFECTS["bias"]).fastest == pytest.approx(12.7 / PAPER_KV)
