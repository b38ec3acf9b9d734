"""A residual that repeats with the angle is a line; one that is slow, small, or between the lines is none."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosed import held

from motor_identification.discrepancy.angle_harmonics import (
    HARMONIC_GAP,
    MOST_CYCLES,
    count_visible_cycles,
    find_angle_harmonic,
)
from motor_identification.discrepancy.operating_conditions import find_conditions
from motor_identification.validation.held_out import HeldOut

SHARE = 0.003  # of a slot: what the disc of `diagnosed` has


def waving(cycles: float, size: float) -> HeldOut:
    """A complete model's held-out motion, with a disc's wave over the angle more: so many rad/s at full speed."""
    complete = held()
    seen = find_conditions(replace(complete, scored=tuple(np.ones_like(marks) for marks in complete.scored)))
    (data,) = complete.intervals
    share = np.abs(seen.speed) / np.abs(seen.speed).max()
    wave = np.where(seen.still, 0.0, size * share * np.sin(cycles * seen.angle))
    return replace(complete, intervals=(replace(data, speed=data.speed + wave),))


@pytest.mark.parametrize("cycles", [1, 3, 11, MOST_CYCLES])
def test_a_line_of_so_many_cycles_a_turn(cycles: int) -> None:
    found = find_angle_harmonic(waving(cycles, 3.0), SHARE)
    assert found is not None and found.cycles == cycles and 0.4 < found.share <= 1.0


@pytest.mark.parametrize("cycles", [2.5, 7.4])
def test_between_the_lines_nothing_repeats(cycles: float) -> None:
    assert find_angle_harmonic(waving(cycles, 3.0), SHARE) is None


@pytest.mark.parametrize(("times", "asked"), [(0.9, False), (1.5, True)])
def test_near_the_floor_it_is_not_asked(times: float, asked: bool) -> None:
    complete = held()
    wanted = times * HARMONIC_GAP * complete.floor(SHARE)
    a_unit = waving(3, 1.0).gap ** 2 - complete.gap**2
    one = waving(3, float(np.sqrt((wanted**2 - complete.gap**2) / a_unit)))
    assert (one.gap > HARMONIC_GAP * one.floor(SHARE)) is asked
    assert (find_angle_harmonic(one, SHARE) is not None) is asked


@pytest.mark.parametrize(("times", "cycles"), [(0.9, MOST_CYCLES), (1.1, 21), (30.0, 0)])
def test_cycles_of_which_intervals_show_half_a_wave_are_visible(times: float, cycles: int) -> None:
    seen = find_conditions(waving(11, 3.0))
    travel = np.abs(seen.speed * seen.duration)
    stretch = times * np.pi / MOST_CYCLES / float(np.median(travel[travel > 0.0]))
    assert count_visible_cycles(replace(seen, duration=seen.duration * stretch)) == cycles
    assert count_visible_cycles(replace(seen, speed=0.0 * seen.speed)) == 0


def test_missing_friction_does_not_repeat() -> None:
    assert find_angle_harmonic(held(ks=0.4), SHARE) is None
