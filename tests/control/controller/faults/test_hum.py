"""Hum of the mains in the place of edges: under 0 V, and beside more voltage than its speed needs."""

from dataclasses import replace
from math import inf, nan

import pytest
from fault_bench import LIMIT, SLOT

from motor_control.controller.faults import hum
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.faults.hum import AT_ONCE, ELSEWHERE, KEPT, LOAD, LOAD_BOTH, LOAD_JUMP
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
    braked: int = 0,
    gap: float = 0.0,
    drift: float = 0.0,
) -> tuple[float, str]:
    """When [s] hum of a rate [1/s] under a mean voltage [V], after a faster motion, is a fault; what is said.

    It comes at once, or is reached within some edges; after a gap [s]; and drifts by a share a second.
    """
    state, rhythm, edge, count = hum.State(), Rhythm(), 0.0, 0
    for k in range(round(seconds * 200.0)):
        now = k / 200.0
        while edge + (period := period_of(count, rate, braked, gap, drift)) <= now:
            edge, count = edge + period, count + 1
        volts = voltage if count > 20 else before
        sample = Sample(10**9 + round(now * 1e9), SPEED, volts, count, 10**9 + round(edge * 1e9), 1.0 / rate)
        rhythm = follow_rhythm(rhythm, sample)
        motion = replace(known, slow_voltage=volts)
        seen = Seen(sample, SPEED, motion, reference, 0.005, LIMIT, rhythm=rhythm)
        reason, state = hum.check(config, state, seen)
        if reason:
            return now, reason
    return inf, ""


def period_of(count: int, rate: float, braked: int, gap: float, drift: float) -> float:
    """[s] that follow an edge: 160 a second before the twentieth."""
    if count <= 20:
        return 1.0 / 160.0 + (gap if count == 20 else 0.0)
    share = min((count - 20) / (braked + 1), 1.0)
    return ((1.0 - share) / 160.0 + share / rate) * (1.0 + drift * (count - 20) / rate)


@pytest.mark.parametrize("config", [ENCODER, MODEL])
def test_all_the_voltage_beside_hum_is_told_within_half_a_second(config: Config) -> None:
    when, reason = told(12.0, config=config)
    assert 0.2 < when < 0.5
    assert reason.startswith("The encoder's line hums with 100 Hz: 12 V change nothing, and 0.") and "pull-up" in reason


@pytest.mark.parametrize("rate", [97.0, 104.0, 70.0, 150.0, 240.0])
def test_edges_of_another_rate_are_none_where_a_load_may_have_braked_the_motor(rate: float) -> None:
    """It changes by 2 % and more from edge to edge, until it turns steadily: insensitive_speed lets loads be."""
    assert told(12.0, rate=rate, braked=20) == (inf, "")


@pytest.mark.parametrize("config", [ENCODER, MODEL])
@pytest.mark.parametrize("rate", [97.0, 104.0, 70.0, 140.0])
def test_edges_of_another_rate_from_one_to_the_next_are_hum(rate: float, config: Config) -> None:
    """It was the top speed for ever, at 0.75 and 0.9 of the edges that are wanted."""
    when, reason = told(12.0, rate=rate, config=config)
    assert 0.25 < when < 0.6 and f"hums with {rate:.0f} Hz" in reason


def test_a_jump_is_one_if_no_load_had_the_time() -> None:
    least = AT_ONCE * MODEL.time_constant
    assert told(12.0, rate=70.0, config=MODEL, gap=0.8 * least)[0] < 0.6
    assert told(12.0, rate=70.0, config=MODEL, gap=1.5 * least) == (inf, "")


@pytest.mark.parametrize(("share", "stops"), [(0.5, True), (8.0, False)])
def test_a_motor_that_spins_up_has_even_edges_too_but_they_drift(share: float, stops: bool) -> None:
    assert (told(12.0, rate=70.0, drift=share * KEPT)[0] < inf) == stops


@pytest.mark.parametrize(("more", "stops"), [(-0.02, False), (0.04, True)])
@pytest.mark.parametrize(("load", "rate", "braked"), [(LOAD, 100.0, 20), (LOAD_BOTH, 100.0, 0), (LOAD_JUMP, 70.0, 0)])
def test_the_bound_is_a_load_beyond_what_that_speed_needed(
    load: float, rate: float, braked: int, more: float, stops: bool
) -> None:
    voltage = HOLDING * rate / 100.0 + (load + more) * LIMIT
    assert (told(voltage, rate=rate, braked=braked)[0] < inf) == stops


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
    state, rhythm = hum.State(), Rhythm()
    for k in range(400):
        volts = 12.0 if k >= 65 else 0.0
        count = k // 2
        sample = Sample(10**9 + k * 5_000_000, SPEED, volts, count, 10**9 + count * 10_000_000, 0.01)
        rhythm = follow_rhythm(rhythm, sample)
        seen = Seen(sample, SPEED, Motion(slow_voltage=volts), 50.0, 0.005, LIMIT, rhythm=rhythm)
        reason, state = hum.check(ENCODER, state, seen)
        if reason:
            break
    assert 0.05 < (k - 65) * 0.005 < 0.2
    assert "12 V change nothing, and 0 V are enough" in reason
