"""Other intervals of intervals: with standstills, without some, joined, with one sensor's noise."""

from dataclasses import replace

import numpy as np
import pytest

from motor_identification.measurement.edit_intervals import (
    append_standstills,
    exclude_intervals,
    join_intervals,
    share_noise,
)
from motor_identification.measurement.intervals import Intervals, index_intervals

SLOT = 0.1  # [rad]


def between_edges(count: int) -> Intervals:
    """A slot every second, with every edge's number and place."""
    time, numbers = np.arange(count + 1.0), np.arange(count + 1)
    return index_intervals(
        time[:-1],
        time[1:],
        np.full(count, SLOT),
        np.full(count, 1e-3),
        edge=np.column_stack([numbers[:-1], numbers[1:]]),
        place=SLOT * np.column_stack([numbers[:-1], numbers[1:]]),
        slot=SLOT,
        left_out=1,
        gear=3.0,
        unevenness=2.0,
    )


def test_standstills_come_after_the_motion_and_know_no_edge() -> None:
    data = append_standstills(between_edges(3), (np.array([3.0]), np.array([7.5])), SLOT)
    assert data.time.tolist() == [0.0, 1.0, 2.0, 3.0, 7.5] and data.duration.tolist() == [1.0, 1.0, 1.0, 4.5]
    assert data.slack.tolist() == [0.0, 0.0, 0.0, SLOT] and data.speed[3] == data.blur[3] == 0.0
    assert data.edge[3].tolist() == [-1, -1] and np.isnan(data.place[3]).all()
    assert (data.slot, data.left_out, data.gear, data.unevenness) == (SLOT, 1, 3.0, 2.0)


def test_what_is_excluded_is_counted() -> None:
    data = exclude_intervals(between_edges(4), np.array([False, True, False, True]))
    assert data.time[data.first].tolist() == [0.0, 2.0] and data.left_out == 3
    assert data.edge.tolist() == [[0, 1], [2, 3]]


@pytest.mark.parametrize(("duration", "ends"), [(0.5, [1, 2, 3, 4, 5, 6]), (2.0, [2, 4, 6]), (2.1, [3, 6])])
def test_joined_intervals_are_as_long_as_asked_for_and_keep_their_outer_edges(duration: float, ends: list[int]) -> None:
    data = join_intervals(between_edges(6), duration)
    assert data.time[data.last].tolist() == ends and data.edge[:, 1].tolist() == ends
    assert data.speed == pytest.approx(SLOT) and data.blur == pytest.approx(1e-3)
    assert data.place[:, 1] == pytest.approx(SLOT * np.array(ends)) and (data.gear, data.left_out) == (3.0, 1)


def test_nothing_is_joined_over_a_gap_or_to_a_standstill() -> None:
    gap = exclude_intervals(between_edges(5), np.arange(5) == 2)
    assert join_intervals(gap, 9.0).edge.tolist() == [[0, 2], [3, 5]]
    still = append_standstills(between_edges(2), (np.array([2.0]), np.array([4.0])), SLOT)
    assert join_intervals(still, 9.0).duration.tolist() == [2.0, 2.0]


def test_noise_beside_counts_adds_up_in_joined_speeds_and_flanks_do_not() -> None:
    """Of logged speeds each has it; of angles only those at the ends."""
    time = np.arange(41.0)
    speeds = index_intervals(time[:-1], time[1:], np.ones(40), np.full(40, 0.1), window=1.0, noise=0.1)
    joined = join_intervals(speeds, 4.0)
    assert len(joined.first) == 10 and (joined.window, joined.noise, joined.unit) == (1.0, 0.1, 0.1)
    assert joined.floor_squared(0.3) == pytest.approx((2.0 * 0.1**2 + 4 * 2.0 * 0.3**2) / 4.0**2)
    assert [one.noise for one in share_noise([speeds, replace(speeds, noise=0.4), speeds])] == [0.1, 0.1, 0.1]
    white = [replace(speeds, independent=True, window=window, noise=0.3 * window) for window in (1.0, 1.0, 50.0)]
    assert [one.noise for one in share_noise(white)] == pytest.approx([0.3, 0.3, 15.0])  # of speeds, not of angles
    flanks = join_intervals(index_intervals(time[:-1], time[1:], np.ones(40), np.full(40, 0.1), slot=0.5), 4.0)
    assert flanks.unit == 0.5 and share_noise([flanks])[0] is flanks
    assert flanks.floor_squared(0.3) == pytest.approx(2.0 * (0.1**2 + 0.3**2) / 4.0**2)
