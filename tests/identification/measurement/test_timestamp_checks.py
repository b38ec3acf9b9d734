"""Wrong stamps are marked by two rules, and right ones of a motor that gains speed or misses an edge are not."""

from dataclasses import replace

import numpy as np
import pytest
from handmade import PERIOD, turning

from motor_identification.measurement.timestamp_checks import (
    EDGES_AROUND,
    STAMP_ERROR,
    STAMP_MARGIN,
    mark_possible,
    mark_smooth,
)
from motor_identification.recording import Floats


def evenly(time: Floats) -> Floats:
    return 700.0 * time


@pytest.mark.parametrize(("beyond", "right"), [(0.9, True), (1.1, False)])
@pytest.mark.parametrize("side", [-1.0, 1.0], ids=["before the sample before", "after its sample"])
def test_an_edge_came_between_two_samples(side: float, beyond: float, right: bool) -> None:
    recording = turning(evenly, 0.1)
    sample = np.array([10])
    bound = recording.time[9 if side < 0 else 10]
    margin = STAMP_MARGIN * PERIOD * beyond
    assert mark_possible(recording, sample, np.array([bound + side * margin]))[0] == right


def test_a_timers_tick_is_allowed_besides() -> None:
    recording = turning(evenly, 0.1)
    coarse = replace(recording, info=replace(recording.info, edge_resolution=0.5 * PERIOD))
    late = np.array([recording.time[10] + 0.4 * PERIOD])
    assert not mark_possible(recording, np.array([10]), late)[0]
    assert mark_possible(coarse, np.array([10]), late)[0]


@pytest.mark.parametrize(
    ("slots", "right"), [(0.9 * STAMP_ERROR, True), (1.2 * STAMP_ERROR, False), (-1.2 * STAMP_ERROR, False)]
)
def test_one_stamp_that_is_off_by_half_a_slot(slots: float, right: bool) -> None:
    """It makes one interval too short and the next too long by as much."""
    count = np.arange(40)
    time = 0.01 * count.astype(float)
    time[20] += 0.01 * slots
    marks = mark_smooth(time, count)
    assert marks[20] == right and marks.sum() >= 39


def test_speeding_up_missing_an_edge_and_an_irregular_disc_are_right() -> None:
    count = np.arange(60)
    faster = np.sqrt(count / 60.0 + 0.05)
    assert mark_smooth(faster, count).all()
    missed = np.delete(0.01 * np.arange(61.0), 30)
    assert mark_smooth(missed, count).all()  # both intervals beside it are not too long together: they are too long
    irregular = 0.01 * (count + np.random.default_rng(0).normal(0.0, 0.05, 60))
    assert mark_smooth(irregular, count).all()


def test_too_few_edges_say_nothing() -> None:
    time = 0.01 * np.arange(2.0 * EDGES_AROUND)
    time[5] += 0.008
    assert mark_smooth(time, np.arange(2 * EDGES_AROUND)).all()
