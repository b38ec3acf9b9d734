"""A speed that no voltage changes."""

from dataclasses import replace
from math import inf

import pytest
from fault_bench import LIMIT, SLOT
from tiers import keep_fast

from motor_control.controller.faults import insensitive_speed
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion
from motor_model.sample import Sample

ENCODER = Config(slot=SLOT)
UNKNOWN = Motion()
LEARNT = Motion(steady_speed=60.0, steady_voltage=4.5, most=60.0)


def told(rows: list[tuple[float, float]], config: Config = ENCODER, known: Motion = UNKNOWN) -> tuple[float, str]:
    """When [s] speeds [rad/s] under mean voltages [V], a sample each, are a fault, and what is said."""
    state = insensitive_speed.State()
    for k, (speed, voltage) in enumerate(rows):
        motion = replace(known, slow_voltage=voltage)
        look = Seen(Sample(k * 5_000_000, speed, voltage), speed, motion, 9.0, 0.005, LIMIT)
        reason, state = insensitive_speed.check(config, state, look)
        if reason:
            return k * 0.005, reason
    return inf, ""


RISE = [min(2.0 + 0.01 * k, 12.0) for k in range(1600)]  # [V] all after 5 s


def test_hum_under_a_voltage_that_grows_is_told() -> None:
    when, reason = told([(6.54, volts) for volts in RISE])
    assert 4.0 < when < 6.5  # 6 V more than the least after 3 s
    assert " V turn the motor no faster than 2." in reason and "hum of the mains" in reason
    assert 4.0 < told([(6.54 * (1.01 if k % 2 else 0.99), volts) for k, volts in enumerate(RISE)])[0] < 6.5


@pytest.mark.parametrize(("most", "stops"), [(8.1, False), (9.5, True)])
def test_half_of_the_voltage_is_the_bound(most: float, stops: bool) -> None:
    when, _ = told([(6.54, min(volts, most)) for volts in RISE])
    assert (when < inf) == stops


def test_a_motor_that_answers_is_none() -> None:
    """3 % of speed for a voltage six times as large is still an answer; nor is one under the same voltage a fault."""
    assert told([(6.54 * (1.0 + 0.05 * k / 1600), volts) for k, volts in enumerate(RISE)]) == (inf, "")
    assert told([(6.54, 12.0)] * 2000) == (inf, "")
    assert told([(0.0, volts) for volts in RISE]) == (inf, "")  # a standstill is the matter of others


@pytest.mark.parametrize("limit", [1e-300, 0.01, 1.0, 6.0])
def test_a_limit_that_is_lowered_makes_no_fault_of_the_voltage_before(limit: float) -> None:
    state = insensitive_speed.State()
    for k in range(600):
        voltage = 4.5 if k < 310 else limit  # a sample or two later, and the mean of them
        voltage += 0.02 * (k % 2)
        look = Seen(
            Sample(k * 5_000_000, 60.0, voltage), 60.0, replace(LEARNT, slow_voltage=voltage), 60.0, 0.005, LIMIT
        )
        look = replace(look, voltage_limit=LIMIT if k < 300 else limit)
        reason, state = insensitive_speed.check(ENCODER, state, look)
        assert reason == ""


def lost_at(hum: float) -> list[tuple[float, float]]:
    """A line that is lost under 60 rad/s: the loop is at all the voltage before any average has settled."""
    rows, mean = [], 4.5
    for k in range(1200):
        mean += 0.033 * ((4.5 if k < 200 else 12.0) - mean)
        rows.append((60.0 if k < 200 else hum, mean))
    return rows


def test_hum_after_a_motion_is_told_by_what_that_motion_needed() -> None:
    """The average of the speed has not settled before the voltage has grown by more than half of the rest."""
    when, reason = told(lost_at(39.0), known=LEARNT)
    assert 1.2 < when < 3.0 and " no faster than 2.9" in reason
    assert told(lost_at(39.0), Config(slot=SLOT, kv=0.069, time_constant=0.06), LEARNT)[0] < 3.5
    assert told(lost_at(39.0))[0] == inf  # nothing was learnt: all voltages that it has been seen under are near 12 V


@pytest.mark.parametrize(("needed", "stops"), [(4.0, True), (4.4, False)])
def test_the_bound_is_a_heavy_load_beyond_what_a_motion_needed(needed: float, stops: bool) -> None:
    known = Motion(steady_speed=39.0, steady_voltage=needed, most=150.0)
    assert (told([(39.0, 12.0)] * 2000, known=known)[0] < inf) == stops


@pytest.mark.parametrize("time_constant", keep_fast([1.0, 3.0, 5.0], 1.0, 5.0))
@pytest.mark.parametrize("share", [0.6, 0.9, 0.95, 0.98])
@pytest.mark.parametrize("known", [UNKNOWN, None])
def test_a_flywheel_under_full_voltage_is_none(time_constant: float, share: float, known: Motion | None) -> None:
    """It has run at a share of its top speed, coasted for a moment, and gets all there is: it hardly answers."""
    motion = known or Motion(steady_speed=174.0 * share, steady_voltage=12.0 * share, most=174.0 * share)
    for coasts in (0.1, 0.15, 0.2, 0.3, 0.5, 1.0):
        speed, mean, rows = 174.0 * share, 12.0 * share, []
        for k in range(1500):  # what stops it wrongly does within a second of the whole voltage
            voltage = 12.0 * share if k < 200 else 0.0 if k < 200 + 200 * coasts else 12.0
            speed += 0.005 / time_constant * (voltage / LIMIT * 174.0 - speed)
            mean += 0.033 * (voltage - mean)
            rows.append((speed, mean))
        assert told(rows, known=motion) == (inf, "")


def test_without_a_stall_time_nothing_is_a_fault() -> None:
    assert told([(6.54, volts) for volts in RISE], Config(slot=SLOT, stall_time=0.0)) == (inf, "")
