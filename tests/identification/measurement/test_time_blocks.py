"""Every n-th block of a recording's time, a hundred samples long, or a twelfth of a short recording."""

import numpy as np
import pytest

from motor_identification.measurement.edit_intervals import exclude_intervals
from motor_identification.measurement.intervals import Intervals, index_intervals
from motor_identification.measurement.time_blocks import BLOCK, LEAST_BLOCKS, TimeBlocks

PERIOD = 0.005  # [s]
LENGTH = BLOCK * PERIOD


def intervals(duration: float, count: int = 1200) -> Intervals:
    bounds = np.linspace(0.0, duration, count + 1)
    return index_intervals(bounds[:-1], bounds[1:], np.ones(count), np.zeros(count))


@pytest.mark.parametrize("every", [2, 4])
def test_the_last_of_every_few_blocks(every: int) -> None:
    data = intervals(12.0)
    marks = TimeBlocks(every).mark(data, PERIOD)
    block = np.floor(data.time[data.first] / LENGTH + 1e-9)
    assert np.array_equal(np.unique(block[marks]) % every, np.full(24 // every, every - 1))
    assert marks.mean() == pytest.approx(1.0 / every)


@pytest.mark.parametrize(("period", "length"), [(0.001, 0.1), (0.005, 0.5), (0.02, 2.0), (0.1, 5.0)])
def test_a_block_has_100_samples_or_is_a_twelfth(period: float, length: float) -> None:
    data = intervals(60.0, 60_000)
    marks = TimeBlocks(2).mark(data, period)
    assert np.count_nonzero(np.diff(marks.astype(int)) != 0) == round(60.0 / length) - 1


@pytest.mark.parametrize("unit", [2.0**-7, 8.0])
def test_blocks_are_the_same_in_any_unit_of_time(unit: float) -> None:
    """A log of 1,000 rows was held out otherwise at 10 ms a row than at 1 ms, and had another verdict."""
    assert np.array_equal(
        TimeBlocks(4).mark(intervals(12.0 * unit), PERIOD * unit), TimeBlocks(4).mark(intervals(12.0), PERIOD)
    )


@pytest.mark.parametrize(("times", "blocks"), [(0.5, LEAST_BLOCKS), (0.99, LEAST_BLOCKS), (2.0, 2 * LEAST_BLOCKS)])
def test_a_short_recording_has_as_many_blocks(times: float, blocks: int) -> None:
    marks = TimeBlocks(2).mark(intervals(times * LEAST_BLOCKS * LENGTH), PERIOD)
    changes = np.count_nonzero(np.diff(marks.astype(int)) != 0) + 1
    assert blocks - 1 <= changes <= blocks + 1


def test_every_recording_has_another_block_than_the_one_before() -> None:
    data = intervals(12.0)
    marks = TimeBlocks(4).mark_each([data] * 5, PERIOD)
    assert np.array_equal(marks[0], TimeBlocks(4).mark(data, PERIOD)) and np.array_equal(marks[4], marks[0])
    assert np.array_equal(sum(part.astype(int) for part in marks[:4]), np.ones(1200))
    assert marks[3][0] and not marks[0][0]  # the beginning


@pytest.mark.parametrize("count", [1, 2])
def test_a_recording_within_one_block_is_left_whole(count: int) -> None:
    start = 0.001 * np.arange(count)
    data = index_intervals(
        np.append(start, 100.6), np.append(start + 0.001, 100.601), np.ones(count + 1), np.zeros(count + 1)
    )
    only = exclude_intervals(data, np.arange(count + 1) == count)
    assert not TimeBlocks(4).mark(only, PERIOD, 3).any() and TimeBlocks(4).mark(data, PERIOD, 3).sum() == count


@pytest.mark.parametrize(
    ("time", "blocks"), [(1.25, [2]), (1.46, [2, 3]), (1.44, [2]), (1.04, [1, 2]), (1.06, [2]), (12.5, [])]
)
def test_the_blocks_of_a_time_and_of_what_is_near_their_ends(time: float, blocks: list[int]) -> None:
    data = intervals(12.0)
    marks = TimeBlocks(4).mark_near([time], data, PERIOD)
    assert np.array_equal(np.unique(np.floor(data.time[data.first][marks] / LENGTH + 1e-9)), blocks)
