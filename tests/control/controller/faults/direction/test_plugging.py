"""A motion that plugging does not slow down."""

from math import exp, inf

import pytest
from fault_bench import LIMIT, SLOT

from motor_control.controller.faults.direction import plugging
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion
from motor_model.sample import Sample

TWO = Config(slot=SLOT, two_channels=True)


def plugged(keeps: float, config: Config = TWO, plugs: bool = True, voltage: float = 2.7) -> float:
    """When a motion is a fault [s] that keeps so much of its speed in 0.4 s, backward, against a voltage [V]."""
    state = plugging.State()
    for k in range(400):
        speed = 33.0 * keeps ** (k * 0.005 / 0.4)
        sample = Sample(k * 5_000_000, -speed, voltage)
        seen = Seen(sample, -speed, Motion(slow_speed=speed), 3.5, 0.005, LIMIT, plugs=plugs)
        reason, state = plugging.check(config, state, seen)
        if reason:
            assert "at 33 rad/s against 2.7 V, and does not become slower" in reason or keeps != 1.0
            return k * 0.005
    return inf


@pytest.mark.parametrize("keeps", [1.0, 1.2, 0.96])
def test_a_motion_that_keeps_its_speed_is_a_fault(keeps: float) -> None:
    """Channels exchanged at 2 % of the top speed: 174 and 600 rad/s motors turned at 19 % of it for ever."""
    assert 0.39 < plugged(keeps) < 0.42


@pytest.mark.parametrize("time_constant", [8.0, 10.0, 30.0])
def test_a_flywheel_that_the_model_knows_has_time_to_become_slower(time_constant: float) -> None:
    """10 s, reversed from 0.6 to -0.6 of its top speed: it was stopped as one that does not become slower."""
    flywheel, coasts = Config(slot=SLOT, two_channels=True, time_constant=time_constant), exp(-0.4 / time_constant)
    assert plugged(coasts, flywheel) == inf
    assert plugged(1.0, flywheel) == pytest.approx(max(0.4, 0.06 * time_constant), abs=0.011)


def test_one_that_becomes_slower_is_none_nor_what_is_not_all_that_may_be() -> None:
    assert plugged(0.94) == plugged(1.0, plugs=False) == plugged(1.0, voltage=-2.7) == inf
    assert plugged(1.0, Config(slot=SLOT)) == plugged(1.0, Config(slot=SLOT, two_channels=True, stall_time=0.0)) == inf
