"""Measure the angle through a whole recording: a simulated one drifts, and with it the phase of what repeats.

Within a run of intervals the encoder counts the angle. Where a run is broken (a reversal, a standstill, an interval
that was left out) the count goes on if there are two channels; from one speed of an instant to that of the next row
the shaft turns by their mean; else a fitted motor bridges the gap, which is short.
"""

from dataclasses import dataclass, replace

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Floats, Integers
from motor_model.compiled import compiled

MOST_ROWS = 1.5  # between two speeds that were measured one after the other


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

    def fill_in(self, whole: "Track") -> "Track":
        """Fill in what another track of the same recording measured where this one knows nothing; this one stays.

        The other's travel is added to its angle from an instant that this one knows on; what that is off by at the next
        such instant is spread over the time between, as the closing error of a traverse: in one interval it is a jump.
        """
        known = np.isin(whole.time, self.time)
        before = np.maximum(np.searchsorted(self.time, whole.time, side="right") - 1, 0)
        angle = whole.angle + np.interp(whole.time, self.time, self.angle - whole.at(self.time))
        time = np.concatenate([self.time, whole.time[~known]])
        order = np.argsort(time, kind="stable")
        run = np.concatenate([self.run, self.run[before[~known]]])
        return Track(time[order], np.concatenate([self.angle, angle[~known]])[order], run[order])


def make_track(intervals: Intervals, angle: Floats) -> Track:
    """Make the track of one recording; `angle` [rad] is a fitted motor's at `intervals.time`, shape (K,)."""
    order = intervals.order
    measured = np.full(len(angle), np.nan)
    run = np.zeros(len(angle), dtype=np.int64)
    _follow(
        intervals.first[order], intervals.last[order], intervals.speed[order], intervals.slack[order],
        intervals.edge[order], intervals.place[order], intervals.slot, find_row_step(intervals), intervals.time,
        angle, measured, run,
    )  # fmt: skip
    known = np.isfinite(measured)
    return Track(intervals.time[known], measured[known], run[known])


def find_row_step(intervals: Intervals) -> float:
    """Find how long [s] it is at most from the window of a logged speed to that of the next row; 0 for angles."""
    start = np.sort(intervals.time[intervals.first])
    if intervals.window == 0.0 or len(start) < 2:
        return 0.0
    return max(MOST_ROWS * float(np.median(np.diff(start))) - intervals.window, 0.0)


@compiled
def _follow(
    first: Integers, last: Integers, speed: Floats, slack: Floats, edge: Integers, place: Floats, slot: float,
    step: float, time: Floats, angle: Floats, measured: Floats, run: Integers,
) -> None:  # fmt: skip
    """Fill the measured angle at both ends of every interval, in the order of time."""
    at, here, count, number = 0, 0.0, -1, 0
    counted, off = False, 0.0  # whether there was a place, and how far the angle is from it
    measured[0] = 0.0
    for i in range(len(first)):
        if first[i] < at:
            continue
        gap = angle[first[i]] - angle[at]
        follows = first[i] == at
        if i > 0 and 0.0 < time[first[i]] - time[at] <= step:
            gap, follows = 0.5 * (speed[i - 1] + speed[i]) * (time[first[i]] - time[at]), True
        if count >= 0 and edge[i, 0] >= 0:  # no further than the edges in the gap, and one slot to either flank
            most = (abs(edge[i, 0] - count) + 1) * slot  # two channels count down backward
            gap = min(max(gap, -most), most)
        here += gap
        if np.isfinite(place[i, 0]):
            here = place[i, 0] + off if counted else here
            counted, off = True, here - place[i, 0]
        number += 0 if follows and slack[i] == 0.0 else 1
        measured[first[i]], run[first[i]] = here, number
        if slack[i] > 0.0:
            here += min(max(angle[last[i]] - angle[first[i]], -slack[i]), slack[i])
        else:
            here += speed[i] * (time[last[i]] - time[first[i]])
        measured[last[i]], run[last[i]] = here, number
        at = last[i]
        count = edge[i, 1]
