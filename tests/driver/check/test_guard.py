"""Limits that hold whatever a step asks for."""

from dataclasses import replace

import pytest

from motor_driver.check.guard import Guard
from motor_driver.check.look import OFF, Act, Look
from motor_driver.check.settings import Settings

SETTINGS = Settings(max_voltage=12.0)
ON = Act(2.0, on=True)


def driven(act: Act, seconds: float, step: float = 0.005, look: Look | None = None) -> tuple[Act, Guard]:
    """The same for some time, at rest before it."""
    look = look or Look(1.0, 0, 0.0, supply=12.0)
    done, guard = Guard(SETTINGS).judge(OFF, look)
    for k in range(1, round(seconds / step) + 1):
        done, guard = guard.judge(act, replace(look, time=1.0 + k * step))
    return done, guard


def test_half_of_the_motors_voltage_is_the_most() -> None:
    assert driven(Act(100.0, on=True), 0.1)[0].voltage == 6.0
    assert driven(Act(-100.0, on=True), 0.1)[0].voltage == -6.0


@pytest.mark.parametrize(("seconds", "stops"), [(2.1, False), (2.3, True)])
def test_one_voltage_does_not_stay_longer_than_two_seconds(seconds: float, stops: bool) -> None:
    act, guard = driven(ON, seconds)
    assert (act == OFF) == stops and ("on 2 V are enough" in guard.stop) == stops


@pytest.mark.parametrize(("seconds", "stops"), [(6.1, False), (6.3, True)])
def test_a_voltage_that_rises_does_not_stay_longer_than_six_seconds(seconds: float, stops: bool) -> None:
    guard = Guard(SETTINGS)
    for k in range(round(seconds / 0.005)):
        act, guard = guard.judge(Act(0.01 + k * 0.004, on=True), Look(1.0 + k * 0.005, 0, 0.0))
    assert (act == OFF) == stops


@pytest.mark.parametrize(("gap", "stops"), [(0.09, False), (0.11, True)])
def test_a_gap_in_the_samples_stops_the_motor(gap: float, stops: bool) -> None:
    _, guard = driven(ON, 0.1)
    assert guard.latest is not None
    act, guard = guard.judge(ON, replace(guard.latest, time=guard.latest.time + gap))
    assert (act == OFF) == stops and ("no sample came for 110 ms" in guard.stop) == stops


@pytest.mark.parametrize(("supply", "stops"), [(7.4, False), (7.1, True), (13.7, False), (13.9, True)])
def test_a_supply_that_changes_stops_the_motor(supply: float, stops: bool) -> None:
    _, guard = driven(ON, 0.1)
    assert guard.latest is not None
    act, _ = guard.judge(ON, replace(guard.latest, time=guard.latest.time + 0.005, supply=supply))
    assert (act == OFF) == stops


@pytest.mark.parametrize(("edges", "stops"), [(89, False), (92, True)])
def test_more_edges_than_the_board_counts_for_certain_stop_it(edges: int, stops: bool) -> None:
    _, guard = driven(ON, 0.1)
    assert guard.latest is not None
    act, _ = guard.judge(ON, replace(guard.latest, time=guard.latest.time + 0.005, count=-edges))
    assert (act == OFF) == stops


def test_after_a_stop_nothing_is_passed_on() -> None:
    _, guard = driven(ON, 2.5)
    assert guard.judge(ON, Look(99.0, 0, 0.0))[0] == OFF
