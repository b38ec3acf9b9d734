"""Find the slot over whose times speeds were computed: the period method, whose values are the older the slower.

Such a value is the mean from one edge to the next, on average a whole period P = slot/|v| old. Taken as one of its
row's own instant it is off by what the motor gained in that time, v̇·P: the slot is the regression of what a fit leaves
on v̇/|v|. Where a motor is slow enough, how long values stay tells the slot without a fit.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Floats, Recording
from motor_identification.sensor.pulse_periods import find_slot_by_stays
from motor_identification.timing.shaped_fit import ShapedFit, Shaper
from motor_identification.timing.timing import Timing

SLOWEST = 0.01  # of the fastest: slower values are those of a motor about to stand
TRIMMED = 0.95  # of the rows, without those at which a motor turns round
SIGNIFICANT = 4.0  # standard errors: what is not, needs no fit to be refused
SHORTEST, LONGEST = 0.003, 3.0  # rows that a slot may take at the usual speed: a shorter one makes no difference
ROUNDS, NEAR = 4, 0.05  # of the regression, and of a slot from one to the next, at most
LEAST_ROWS = 30
MOST_APART = 1.5  # usual rows from one to the next, whose speeds tell the acceleration between


def find_stays_slot(recordings: Sequence[Recording]) -> float:
    """Find the slot [rad] by how long values stay; 0 where that tells none."""
    found = [slot for one in recordings if (slot := find_slot_by_stays(one.time, one.speed)) > 0.0]
    return float(np.median(found)) if found else 0.0


def find_regressed_slot(shaper: Shaper, instants: Timing) -> float:
    """Find the slot [rad] by what fits leave; 0 where they show none. instants: by which rows' own values are read.

    It has to be judged by what is left with it.
    """
    usual = min(recording.sample_period for recording in shaper.recordings) * _measure_usual_speed(shaper.recordings)
    # From the shortest slot, by which what a motor shows that stands or turns round is left out; and with all of that.
    return _regress_from(SHORTEST * usual, shaper, instants, usual) or _regress_from(0.0, shaper, instants, usual)


def _regress_from(slot: float, shaper: Shaper, instants: Timing, usual: float) -> float:
    """Find the slot [rad] by regressions from one; usual: [rad] the travel in a row. 0 where they show none."""
    for k in range(ROUNDS):
        more, error = _regress(shaper.fit(replace(instants, slot=slot)))
        if (k == 0 and more <= SIGNIFICANT * error) or not SHORTEST * usual < slot + more < LONGEST * usual:
            return 0.0
        slot += more
        if abs(more) < NEAR * slot:
            break
    return slot


def match_residuals(instants: ShapedFit, periods: ShapedFit) -> tuple[Floats, Floats]:
    """List what two fits leave of the speeds [rad/s] of the rows that the second has, (I,) each, in order of time.

    The first takes the value of every row for that of its instant, the second for one between edges before it.
    """
    rows = [_match(*pair) for pair in zip(_pairs(instants), _pairs(periods), strict=True)]
    one, other = (np.concatenate(part) for part in zip(*rows, strict=True))
    return one, other


_Left = tuple[Intervals, Floats]  # a recording's intervals, and simulated minus measured travel [rad] in them


def _pairs(fitted: ShapedFit) -> list[_Left]:
    estimate = fitted.estimate
    return list(zip(estimate.problem.intervals, estimate.increments, strict=True))


def _match(instants: _Left, periods: _Left) -> tuple[Floats, Floats]:
    (data, left), (other, second) = instants, periods
    moving = np.flatnonzero(other.slack == 0.0)
    at = np.searchsorted(data.time[data.last], other.time[other.last[moving]])
    at, moving = at[at < len(left)], moving[at < len(left)]
    return left[at] / data.duration[at], second[moving] / other.duration[moving]


def _measure_usual_speed(recordings: Sequence[Recording]) -> float:
    speed = np.abs(np.concatenate([recording.speed for recording in recordings]))
    return float(np.median(speed[speed > 0.0])) if np.any(speed) else 0.0


def _regress(fitted: ShapedFit) -> tuple[float, float]:
    """Regress what a fit leaves on acceleration over speed: a slot [rad] more, and its standard error."""
    rows = [_list_columns(*pair) for pair in _pairs(fitted)]
    columns, left = (np.concatenate(part) for part in zip(*rows, strict=True))
    if len(left) < LEAST_ROWS:
        return 0.0, np.inf
    size = np.abs(columns[:, 0])
    kept = size <= np.quantile(size, TRIMMED)
    columns, left = columns[kept], left[kept]
    scale = np.maximum(np.max(np.abs(columns), axis=0), 1e-300)
    inverse = np.linalg.pinv(columns / scale)
    weights = inverse @ left
    rest = left - columns / scale @ weights
    error = float(np.sqrt(inverse[0] ** 2 @ rest**2))  # White, Econometrica 48, 1980
    return float(weights[0] / scale[0]), float(error / scale[0])


def _list_columns(data: Intervals, increments: Floats) -> tuple[Floats, Floats]:
    """List v̇/|v|, v̇ and 1 of rows, shape (R, 3), and simulated minus measured speed [rad/s] there, shape (R,)."""
    moving = np.flatnonzero((data.slack == 0.0) & (data.speed != 0.0))
    if len(moving) < LEAST_ROWS:
        return np.empty((0, 3)), np.empty(0)
    left, speed = increments[moving] / data.duration[moving], data.speed[moving]
    apart = np.diff(data.time[data.last[moving]])
    gain = np.diff(speed + left) / apart
    good = (apart < MOST_APART * np.median(apart)) & (np.abs(speed[1:]) > SLOWEST * np.max(np.abs(speed)))
    columns = np.column_stack([gain / np.abs(speed[1:]), gain, np.ones(len(gain))])
    return columns[good], left[1:][good]
