"""Zeros before a start in which the motor moved already, as the speeds after it say."""

from dataclasses import replace

import numpy as np
import pytest
from swinging import noisy

from motor_identification.recording import Floats
from motor_identification.sensor.speed_sensor import find_speed_sensor
from motor_identification.sensor.unseen_starts import COUNTS, GROWING, mark_unseen_starts

STOOD, TAU = 40, 30.0  # rows


def started(unseen: int, top: float = 100.0, tau: float = TAU) -> Floats:
    """Speeds of a motor that starts at the row STOOD, of which the first ones are 0."""
    row = np.arange(STOOD + 100)
    speed = top * -np.expm1(-np.maximum(row - STOOD, 0.0) / tau)
    speed[: STOOD + 1 + unseen] = 0.0
    return np.asarray(speed)


@pytest.mark.parametrize("unseen", [0, 1, 2, 5, 10])
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_zeros_are_unseen_as_far_as_the_growth_of_the_speeds_leads_back(unseen: int, way: float) -> None:
    """It bends, and so leads back a little too far: to rows in which the motor stood in truth."""
    marked = np.flatnonzero(mark_unseen_starts(way * started(unseen)))
    assert unseen <= len(marked) <= 1.25 * unseen
    assert marked.tolist() == [STOOD + 1 + unseen - k for k in range(len(marked), 0, -1)]


@pytest.mark.parametrize("tau", [0.5, 1.0, 2.0, 5.0, 30.0, 100.0])
@pytest.mark.parametrize("part", [0.01, 0.5, 0.99])
def test_a_start_that_is_seen_at_once_has_no_unseen_rows(tau: float, part: float) -> None:
    """Whatever the time constant, and the part of a row that had passed at the first speed."""
    row = np.arange(STOOD + 100)
    speed = -np.expm1(-np.maximum(row - STOOD - 1.0 + part, 0.0) / tau)
    assert not mark_unseen_starts(speed).any()


def test_a_speed_that_is_held_until_the_next_edges_grows_over_the_rows_in_which_it_is() -> None:
    held = started(6)
    held[STOOD + 8 : STOOD + 10] = held[STOOD + 7]
    assert 3 <= np.count_nonzero(mark_unseen_starts(held)) <= 7


@pytest.mark.parametrize("after", [GROWING, GROWING + 1])
def test_what_does_not_double_in_a_few_rows_is_a_speed_of_its_own(after: int) -> None:
    speed = np.concatenate([np.zeros(STOOD), np.full(after, 10.0), np.full(50, 20.0)])
    assert mark_unseen_starts(speed).any() == (after == GROWING)


def test_a_motor_that_turns_before_it_doubles_did_not_start() -> None:
    speed = started(5)
    speed[STOOD + 7] *= -1.0
    assert not mark_unseen_starts(speed).any()


@pytest.mark.parametrize(("zeros", "found"), [(3, True), (2, False)])
def test_a_motor_stood_before_it_started(zeros: int, found: bool) -> None:
    """Zeros between two ways are few, and no start."""
    speed = started(5)
    speed[: STOOD + 6 - zeros] = -50.0
    assert mark_unseen_starts(speed).any() == found


@pytest.mark.parametrize(("counts", "found"), [(COUNTS, True), (COUNTS - 1.0, False)])
def test_few_counts_are_0_now_and_then(counts: float, found: bool) -> None:
    """Counts within a row: a motor that speeds up shows none, and then a few."""
    counted = np.concatenate(
        [np.zeros(STOOD), [counts, counts + 1.0, counts + 2.0, 2.0 * counts], np.arange(9.0, 60.0)]
    )
    assert mark_unseen_starts(0.7 * counted).any() == found


def test_nothing_to_judge_by() -> None:
    for few in (np.empty(0), np.zeros(1), np.zeros(50), np.ones(50), np.array([0.0, 0.0, 0.0, 1.0])):
        assert not mark_unseen_starts(few).any()


def test_a_sensor_goes_without_them() -> None:
    clean, begun = noisy(0.3), started(5)
    speed = np.concatenate([begun, clean.speed[len(begun) :]])
    found = find_speed_sensor(replace(clean, speed=speed))
    left_out = set(range(len(clean))) - set(found.row.tolist())
    assert left_out and left_out <= set(range(STOOD - 1, STOOD + 6)) and found.wrong == len(left_out)
