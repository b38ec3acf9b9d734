"""Measure the angle through a whole recording: a simulated one drifts, and with it the phase of what repeats.

Within a run of intervals the encoder counts the angle. Where a run is broken (a reversal, a standstill, an interval
that was left out) a fitted motor bridges the gap, which is short.
"""

from dataclasses import dataclass, replace

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Floats, Integers
from motor_model.compiled import compiled


@dataclass(frozen=True)
class Track:
    """The shaft's angle since the recording's start; arrays of shape (K,), `time` ascending.

    `run` numbers the stretches in which the encoder counted without a gap; from one to the next a motor that swings
    back and forth may be misjudged by some slots.
    """

    time: Floats  # [s]
    angle: Floats  # [rad]
    run: Integers

    def at(self, time: Floats) -> Floats:
        """[rad] at any times [s]; between two measured ones it turns evenly."""
        return np.asarray(np.interp(time, self.time, self.angle))

    def run_at(self, time: Floats) -> Integers:
        """The number of the run at any times [s]."""
        return np.asarray(self.run[np.maximum(np.searchsorted(self.time, time, side="right") - 1, 0)])

    def slipped(self, slips: Floats) -> "Track":
        """Add every run's slip [rad] to the track, shape (number of runs,)."""
        return replace(self, angle=self.angle + slips[np.minimum(self.run, len(slips) - 1)])


def make_track(intervals: Intervals, angle: Floats) -> Track:
    """Make the track of one recording; `angle` [rad] is a fitted motor's at `intervals.time`, shape (K,)."""
    order = np.argsort(intervals.time[intervals.first], kind="stable")
    measured = np.full(len(angle), np.nan)
    run = np.zeros(len(angle), dtype=np.int64)
    _follow(
        intervals.first[order], intervals.last[order], intervals.speed[order], intervals.slack[order],
        intervals.edge[order], intervals.slot, intervals.time, angle, measured, run,
    )  # fmt: skip
    known = np.isfinite(measured)
    return Track(intervals.time[known], measured[known], run[known])


@compiled
def _follow(
    first: Integers, last: Integers, speed: Floats, slack: Floats, edge: Integers, slot: float,
    time: Floats, angle: Floats, measured: Floats, run: Integers,
) -> None:  # fmt: skip
    """Fill the measured angle at both ends of every interval, in the order of time."""
    at, here, count, number = 0, 0.0, -1, 0
    measured[0] = 0.0
    for i in range(len(first)):
        if first[i] < at:
            continue
        gap = angle[first[i]] - angle[at]
        if count >= 0 and edge[i, 0] >= 0:  # no further than the edges in the gap, and one slot to either flank
            most = (abs(edge[i, 0] - count) + 1) * slot  # two channels count down backward
            gap = min(max(gap, -most), most)
        here += gap
        number += 1 if first[i] > at or slack[i] > 0.0 else 0
        measured[first[i]], run[first[i]] = here, number
        if slack[i] > 0.0:
            here += min(max(angle[last[i]] - angle[first[i]], -slack[i]), slack[i])
        else:
            here += speed[i] * (time[last[i]] - time[first[i]])
        measured[last[i]], run[last[i]] = here, number
        at = last[i]
        count = edge[i, 1]
