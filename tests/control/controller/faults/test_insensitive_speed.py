"""A speed that no voltage changes."""

from math import inf

import pytest
from fault_bench import LIMIT, SLOT

from motor_control.controller.faults import insensitive_speed
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion
from motor_model.sample import Sample

ENCODER = Config(slot=SLOT)


def told(rows: list[tuple[float, float]], config: Config = ENCODER) -> tuple[float, str]:
    """When [s] speeds [rad/s] under mean voltages [V], a sample each, are a fault, and what is said."""
    state = insensitive_speed.State()
    for k, (speed, voltage) in enumerate(rows):
        look = Seen(Sample(k * 5_000_000, speed, voltage), speed, Motion(slow_voltage=voltage), 9.0, 0.005, LIMIT)
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


def test_a_flywheel_of_five_seconds_under_full_voltage_is_none() -> None:
    """It had coasted from 100 rad/s of 174."""
    speed, rows = 100.0, []
    for k in range(2000):
        voltage = 0.0 if k < 100 else 12.0
        speed += 0.005 / 5.0 * (voltage / LIMIT * 174.0 - speed)
        rows.append((speed, voltage))
    assert told(rows) == (inf, "")


def test_without_a_stall_time_nothing_is_a_fault() -> None:
    assert told([(6.54, volts) for volts in RISE], Config(slot=SLOT, stall_time=0.0)) == (inf, "")
