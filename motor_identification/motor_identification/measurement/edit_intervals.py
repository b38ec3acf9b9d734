"""Make other intervals of intervals: append standstills, exclude some, join neighbours, share a sensor's noise."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from motor_identification.measurement.intervals import Intervals, index_times
from motor_identification.recording import Bools, Floats, Integers
from motor_model.compiled import compiled


def append_standstills(moving: Intervals, still: tuple[Floats, Floats], slack: float) -> Intervals:
    """Append times [s] in which the motor moved less than `slack` [rad], at the end of the list."""
    start, end = still
    blank = np.zeros(len(start))
    time, first, last = index_times(
        np.concatenate([moving.time[moving.first], start]), np.concatenate([moving.time[moving.last], end])
    )
    return replace(
        moving,
        time=time,
        first=first,
        last=last,
        speed=np.concatenate([moving.speed, blank]),
        slack=np.concatenate([moving.slack, blank + slack]),
        blur=np.concatenate([moving.blur, blank]),
        edge=np.concatenate([moving.edge, np.full((len(blank), 2), -1)]),
        place=np.concatenate([moving.place, np.full((len(blank), 2), np.nan)]),
    )


def exclude_intervals(intervals: Intervals, bad: Bools) -> Intervals:
    """Exclude marked intervals; shape of `bad`: (I,)."""
    good = ~bad
    return replace(
        intervals,
        first=intervals.first[good],
        last=intervals.last[good],
        speed=intervals.speed[good],
        slack=intervals.slack[good],
        blur=intervals.blur[good],
        edge=intervals.edge[good],
        place=intervals.place[good],
        left_out=intervals.left_out + int(bad.sum()),
    )


def share_noise(intervals: Sequence[Intervals]) -> tuple[Intervals, ...]:
    """Give all recordings of logged speeds one sensor's noise: what is unknown of it is a share of the same unit.

    An angle's where speeds were counted, a speed's where their noise is white, whatever the window.
    """
    counts = [data.noise for data in intervals if data.window > 0.0 and not data.independent]
    speeds = [data.noise / data.window for data in intervals if data.window > 0.0 and data.independent]

    def common(data: Intervals) -> float:
        return float(np.median(speeds)) * data.window if data.independent else float(np.median(counts))

    return tuple(replace(data, noise=common(data)) if data.window > 0.0 else data for data in intervals)


def join_intervals(intervals: Intervals, duration: float) -> Intervals:
    """Join intervals that follow each other until each is at least `duration` [s] long.

    A mean speed over many slots says as much about the motor as those over its parts, but for what happens within it.
    """
    if len(intervals.first) == 0:
        return intervals
    group = np.empty(len(intervals.first), dtype=np.int64)
    _group(intervals.apart, intervals.duration, duration, group)
    begin = np.flatnonzero(np.diff(group, prepend=-1))
    end = np.append(begin[1:], len(group)) - 1
    travel = np.add.reduceat(intervals.speed * intervals.duration, begin)
    start_time, end_time = intervals.time[intervals.first[begin]], intervals.time[intervals.last[end]]
    blur = np.maximum.reduceat(intervals.blur, begin)
    if intervals.independent:  # their errors add up, and do not go from one to the next
        blur = np.sqrt(np.add.reduceat(intervals.blur**2, begin))
    time, first, last = index_times(start_time, end_time)
    return replace(
        intervals,
        time=time,
        first=first,
        last=last,
        speed=travel / (end_time - start_time),
        blur=blur,
        slack=intervals.slack[begin],
        edge=np.column_stack([intervals.edge[begin, 0], intervals.edge[end, 1]]),
        place=np.column_stack([intervals.place[begin, 0], intervals.place[end, 1]]),
    )


@compiled
def _group(apart: Bools, duration: Floats, least: float, group: Integers) -> None:
    """Number the intervals by the longer ones they are joined to."""
    number, length = -1, 0.0
    for k in range(len(apart)):
        if apart[k] or length >= least:
            number, length = number + 1, 0.0
        group[k] = number
        length += duration[k]
