"""Speeds over whole ticks of a timer are told from all others, through printed digits, with the speed of one tick."""

from math import tau

import numpy as np
import pytest
from scipy.signal import lfilter

from motor_identification.recording import Floats
from motor_identification.sensor.pulses.timer_ticks import (
    FEWEST_SPEEDS,
    TICKS,
    are_over_slots,
    find_speed_of_a_tick,
    list_slots,
)

SLOT, TICK = tau / 44, 1e-6


def swinging(rows: int = 2000, top: float = 350.0) -> Floats:
    """Speeds [rad/s] of a motor that swings both ways."""
    return np.asarray(top * np.sin(np.linspace(0.0, 40.0, rows)) * np.linspace(0.6, 1.0, rows))


def timed(speed: Floats, tick: float = TICK, slot: float = SLOT) -> Floats:
    """What is said of speeds that are a slot over whole ticks."""
    ticks = np.maximum(np.rint(slot / tick / np.maximum(np.abs(speed), 1e-3)), 1.0)
    return np.asarray(np.sign(speed) * slot / tick / ticks)


@pytest.mark.parametrize("tick", [0.5e-6, 1e-6, 4e-6])
@pytest.mark.parametrize("slot", [tau / 44, tau / 600, tau / 7])
def test_the_speed_of_a_tick_is_found(tick: float, slot: float) -> None:
    speed = timed(swinging(), tick, slot)
    assert find_speed_of_a_tick(speed) == pytest.approx(slot / tick, rel=1e-5)
    assert any(found == pytest.approx(slot, rel=1e-5) for found in list_slots(speed))


def test_printed_digits_hide_it_only_where_they_are_coarser_than_a_tick() -> None:
    rpm = timed(swinging()) * 60.0 / tau
    assert find_speed_of_a_tick(np.round(rpm, 1)) == pytest.approx(SLOT / TICK * 60.0 / tau, rel=1e-4)
    assert find_speed_of_a_tick(np.round(rpm, -1)) == 0.0


def test_a_few_false_speeds_hide_nothing() -> None:
    speed = timed(swinging())
    speed[::300] = 40.0 * np.sqrt(np.arange(len(speed[::300])) + 2.0) + 300.0
    assert find_speed_of_a_tick(speed) == pytest.approx(SLOT / TICK, rel=1e-5)


@pytest.mark.parametrize("seed", range(8))
def test_no_other_sensor_has_ticks(seed: int) -> None:
    random = np.random.default_rng(seed)
    smooth = swinging()
    counted = np.floor(smooth / 3.1 + random.uniform(0.0, 1.0, len(smooth))) * 3.1
    others = (smooth, smooth + random.normal(0.0, 2.0, len(smooth)), np.round(smooth, 1), counted, 0.25 * counted)
    assert [find_speed_of_a_tick(one) for one in others] == [0.0] * len(others)
    smoothed = lfilter([0.4], [1.0, -0.6], timed(smooth))  # nor what a filter made of ticks
    assert find_speed_of_a_tick(smoothed) == 0.0 and list_slots(smoothed) == ()


def test_means_of_a_few_alike_have_ticks_of_as_many_slots() -> None:
    mean = np.convolve(timed(swinging()), np.ones(3) / 3.0, mode="valid")
    assert find_speed_of_a_tick(mean) == pytest.approx(3.0 * SLOT / TICK, rel=1e-3)


def test_few_speeds_tell_nothing() -> None:
    ticks = np.arange(400, 401 + FEWEST_SPEEDS)  # the fastest is not looked at
    assert find_speed_of_a_tick(SLOT / TICK / ticks) == pytest.approx(SLOT / TICK, rel=1e-6)
    assert find_speed_of_a_tick(SLOT / TICK / ticks[:-2]) == 0.0
    assert find_speed_of_a_tick(np.zeros(9)) == 0.0


def test_slots_are_those_of_ticks_as_there_are_up_to_the_longest() -> None:
    slots = list_slots(timed(swinging()), 1.0)
    assert slots == tuple(pytest.approx(SLOT / TICK * tick, rel=1e-5) for tick in TICKS if SLOT / TICK * tick <= 1.0)


def test_speeds_are_over_a_slot_that_is_said_or_a_few_of_it_and_over_no_other() -> None:
    speed = timed(swinging())
    assert are_over_slots(speed, SLOT) and are_over_slots(speed, SLOT / 3.0)
    assert not are_over_slots(speed, 1.002 * SLOT) and not are_over_slots(speed, SLOT / 1.5)
    assert not are_over_slots(swinging(), SLOT)
