"""Thin long logs out: join rows that are far quicker than the motion, so that as many are left as tell of it.

A log of a minute at 1 kHz says no more of a motor of 20 ms than the means over 4 ms do, at a quarter of the time.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from motor_identification.estimation.problem import Problem
from motor_identification.measurement.edit_intervals import join_intervals
from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Floats, Recording
from motor_model.sample import Measurement

ENOUGH = 10_000  # intervals of all recordings together: no more are needed. Half a minute at 400 Hz has as many
MOST_JOINED = 8  # rows
# Of the speed's power, that speeds may differ by within joined rows: motion that their mean does not follow, and the
# sensor's noise. Measured: 0.0004 to 0.0008 in four rows of a real motor of 20 ms at 1 kHz.
MOST_SPREAD = 0.01


def thin_problem(problem: Problem) -> Problem:
    """Thin the problem of a diagnosis, which fits many models: what they are fitted to and judged by alike."""
    return problem.with_intervals(thin_out(problem.recordings, problem.intervals))


def thin_out(recordings: Sequence[Recording], intervals: Sequence[Intervals]) -> tuple[Intervals, ...]:
    """Join rows of recordings that have more than enough of them; edges with stamps, and all others, as they are."""
    rows = count_joined(recordings, intervals)
    if rows == 1:
        return tuple(intervals)
    pairs = zip(recordings, intervals, strict=True)
    return tuple(replace(join_intervals(data, rows * recording.sample_period), rows=rows) for recording, data in pairs)


def count_joined(recordings: Sequence[Recording], intervals: Sequence[Intervals]) -> int:
    """Count the rows that may be joined: a power of two, 1 where the motion is as quick as the rows or they are few."""
    if any(recording.info.measurement is Measurement.EDGES for recording in recordings):
        return 1
    total, rows = sum(len(data.first) for data in intervals), 1
    speeds = [data.speed[data.order] for data in intervals]
    while rows * ENOUGH < total and rows < MOST_JOINED and all(_differ_little(speed, 2 * rows) for speed in speeds):
        rows *= 2
    return rows


def _differ_little(speed: Floats, rows: int) -> bool:
    """Decide whether speeds (I,) differ little within so many rows, beside what they are."""
    groups = speed[: len(speed) // rows * rows].reshape(-1, rows)
    return groups.size > 0 and float(np.mean(groups.var(axis=1))) <= MOST_SPREAD * float(np.mean(speed**2))
