"""Hum of the mains in the place of edges: under 0 V, and beside more voltage than its speed needs."""

from dataclasses import replace
from math import inf, nan

import pytest
from fault_bench import LIMIT, SLOT

from motor_control.controller.faults import mains_hum
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.faults.mains_hum import ELSEWHERE, LOAD
from motor_control.controller.motion import Motion
from motor_model.sample import Sample
from motor_model.sensing.mains_rhythm import Rhythm, follow_rhythm

ENCODER = Config(slot=SLOT)
MODEL = Config(slot=SLOT, fastest=174.0, kv=0.066, time_constant=0.08, friction=0.5)
SPEED = 100.0 * SLOT  # [rad/s] of hum
NEEDED = 0.62  # [V] of the last steady motion, at 10 rad/s
LEARNT = Motion(steady_speed=10.0, steady_voltage=NEEDED, most=10.0)
HOLDING = NEEDED * SPEED / 10.0


def told(
    voltage: float,
    *,
    config: Config = ENCODER,
    known: Motion = LEARNT,
    reference: float = 10.0,
    rate: float = 100.0,
    before: float = 3.0,
    seconds: float = 4.0,
) -> tuple[float, str]:
    """When [s] hum of a rate [1/s] under a mean voltage [V], after a faster motion, is a fault; what is said."""
    state, rhythm, edge, count = mains_hum.State(), Rhythm(), 0.0, 0
    for k in range(round(seconds * 200.0)):
        now = k / 200.0
        while edge + 1.0 / (rate if count > 20 else 160.0) <= now:
            edge, count = edge + 1.0 / (rate if count > 20 else 160.0), count + 1
        volts = voltage if count > 20 else before
        sample = Sample(10**9 + round(now * 1e9), SPEED, volts, count, 10**9 + round(edge * 1e9), 1.0 / rate)
        rhythm = follow_rhythm(rhythm, sample)
        motion = replace(known, slow_voltage=volts)
        seen = Seen(sample, SPEED, motion, reference, 0.005, LIMIT, rhythm=rhythm)
        reason, state = mains_hum.check(config, state, seen)
        if reason:
            return now, reason
    return inf, ""


@pytest.mark.parametrize("config", [ENCODER, MODEL])
def test_all_the_voltage_beside_hum_is_told_within_half_a_second(config: Config) -> None:
    when, reason = told(12.0, config=config)
    assert 0.2 < when < 0.5
    assert reason.startswith("The encoder's line hums with 100 Hz: 12 V change nothing, and 0.") and "pull-up" in reason


@pytest.mark.parametrize("rate", [97.0, 104.0, 70.0, 150.0])
def test_edges_of_another_rate_are_none(rate: float) -> None:
    assert told(12.0, rate=rate) == (inf, "")


@pytest.mark.parametrize(("more", "stops"), [(LOAD - 0.02, False), (LOAD + 0.04, True)])
def test_the_bound_is_a_load_beyond_what_that_speed_needed(more: float, stops: bool) -> None:
    assert (told(HOLDING + more * LIMIT)[0] < inf) == stops


@pytest.mark.parametrize(
    ("share", "stops"), [(1.0, False), (1.0 + 0.8 * ELSEWHERE, False), (1.0 + 1.5 * ELSEWHERE, True)]
)
def test_a_motor_that_does_as_it_is_told_is_none(share: float, stops: bool) -> None:
    """A load may take all there is: who turns at 100 edges a second and is wanted there has no fault."""
    assert (told(12.0, reference=share * SPEED)[0] < inf) == stops


def test_a_voltage_that_is_asked_for_is_none_nor_what_nothing_is_known_of() -> None:
    assert told(12.0, reference=nan) == (inf, "")
    assert told(12.0, known=Motion()) == (inf, "")
    assert told(12.0, known=Motion(), config=MODEL)[0] < 0.5
    assert told(12.0, config=replace(ENCODER, stall_time=0.0)) == (inf, "")


def test_under_no_voltage_it_is_told_before_the_motor_moves() -> None:
    when, reason = told(0.0, before=0.0, known=Motion())
    assert 0.5 < when < 0.9 and "with the motor at 0 V" in reason
    assert told(0.0, before=0.0, known=Motion(), rate=104.0) == (inf, "")


@pytest.mark.parametrize(("time_constant", "least", "most"), [(0.1, 0.5, 0.9), (40.0, 1.2, 1.6), (100.0, 3.0, 3.4)])
def test_a_heavy_flywheel_may_coast_through_the_rate_of_the_mains(
    time_constant: float, least: float, most: float
) -> None:
    """It takes 0.03 of its time constant for that."""
    config = replace(MODEL, time_constant=time_constant)
    assert least < told(0.0, before=0.0, config=config)[0] < most


def test_a_voltage_that_comes_soon_changes_nothing_of_what_came_under_none() -> None:
    """Hum was there for 0.2 s when the reference came."""
    state, rhythm = mains_hum.State(), Rhythm()
    for k in range(400):
        volts = 12.0 if k >= 65 else 0.0
        count = k // 2
        sample = Sample(10**9 + k * 5_000_000, SPEED, volts, count, 10**9 + count * 10_000_000, 0.01)
        rhythm = follow_rhythm(rhythm, sample)
        seen = Seen(sample, SPEED, Motion(slow_voltage=volts), 50.0, 0.005, LIMIT, rhythm=rhythm)
        reason, state = mains_hum.check(ENCODER, state, seen)
        if reason:
            break
    assert 0.05 < (k - 65) * 0.005 < 0.2
    assert "12 V change nothing, and 0 V are enough" in reason
