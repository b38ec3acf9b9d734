"""Strong voltages where the motor shall stand."""

from dataclasses import replace
from math import inf, nan

import pytest
from fault_bench import LIMIT, SLOT

from motor_control.controller.faults import push_at_rest
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion
from motor_model.sample import Sample

TWO = Config(slot=SLOT, two_channels=True)


def pushed(
    voltages: list[float], config: Config = TWO, reference: float = 0.0, innovation: float = 0.01, rested: bool = True
) -> float:
    """When voltages [V], one a sample, again and again, are a fault [s]."""
    state = push_at_rest.State(rested)
    for k in range(2000):
        sample = Sample(k * 5_000_000, 0.0, voltages[k % len(voltages)])
        reason, state = push_at_rest.check(
            config, state, Seen(sample, 9.0, Motion(), reference, 0.005, LIMIT, innovation)
        )
        if reason:
            swings = "is pushed to and fro" in reason
            assert f"by up to {max(map(abs, voltages)):.3g} V for 0.{4 if swings else 2} s in all" in reason
            return k * 0.005
    return inf


def test_strong_voltages_to_and_fro_are_a_fault() -> None:
    assert pushed([-6.0, 6.0]) == pytest.approx(0.22, abs=0.03)
    assert 0.5 < pushed([6.0, -6.0] + [0.0] * 5) < 2.5


def test_what_a_load_takes_or_a_hit_is_none() -> None:
    assert pushed([5.8]) == inf  # of 12 V: a quarter for a load, friction, and a random torque
    assert pushed([6.0] * 30 + [0.0] * 400) == inf


def test_it_is_about_rest_under_an_observer_with_two_channels() -> None:
    assert pushed([6.0], replace(TWO, two_channels=False)) == pushed([6.0], replace(TWO, stall_time=0.0)) == inf
    assert pushed([6.0], reference=1.0) == pushed([6.0], reference=nan) == inf
    assert pushed([6.0], innovation=nan) == pushed([12.0], rested=False) == inf  # measured; on the way to rest


def test_a_loop_that_swings_is_a_fault_on_the_measured_speed_too() -> None:
    """Four times the default gain: 12 V to and fro, and up to a quarter of the top speed, for ever."""
    swing = [12.0] * 9 + [-12.0] * 9
    assert 0.4 < pushed(swing, innovation=nan, rested=False) < 0.7
    assert pushed(swing[:8] + [0.0] * 30 + swing[-8:] + [0.0] * 30, innovation=nan) == inf
    assert pushed([12.0] * 200 + [-12.0] * 30 + [0.0] * 900, innovation=nan) == inf  # a brake, and what it overshoots
    assert pushed(swing, replace(TWO, two_channels=False)) == pushed(swing, reference=2.0) == inf
