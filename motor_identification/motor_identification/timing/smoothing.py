"""Find whether speeds were smoothed before they were logged, each keeping a share of the one before.

y_k = m·y_{k−1} + (1 − m)·x_k, the commonest filter of small programs. It lags, as an inductance or a delay does, and
what it does to the speeds it does to their noise too, which nothing in the motor can. So x is computed for several m,
and the motor fitted to it beside what shapes most motions; what that leaves is judged as random torque and sensor noise
(`noise/error_learning.py`). The density of y is that of x divided by (1 − m) for every row, and has to be larger than
that beside what lags in a motor. Counted speeds lie on a lattice for the right m alone, which nothing does by chance.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import log

import numpy as np

from motor_identification.noise.error_data import log_likelihood, make_error_data
from motor_identification.noise.error_learning import learn_error_model
from motor_identification.recording import Recording
from motor_identification.sensor.held_samples import find_frames
from motor_identification.sensor.value_lattice import find_lattice
from motor_identification.timing.shaped_fit import Shaper
from motor_identification.timing.timing import Timing, is_open, sharpen
from motor_model.effects import LAGGING

# Tried in turn as long as they are likelier: beyond, the motor's own lag is taken for a filter, and that for the motor.
CLIMB = (0.3, 0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.92, 0.94, 0.96, 0.98)
ROUND = tuple(sorted({k / 20 for k in range(1, 20)} | {k / 16 for k in range(1, 16)} | {0.96, 0.97, 0.98, 0.99}))
# Of log likelihood: in all, and as a part of what it would be if nothing but sensor noise made speeds unlike their
# prediction. Measured: 0.04 to 3 of that where speeds were smoothed, the less the stronger a torque is beside them.
LEAST_GAIN, LEAST_PART = 20.0, 0.04
AS_LIKELY = 3.0  # of log likelihood: a round share that is less likely by no more is what was meant
LEAST_SPEEDS = 200
EVEN = 1e-3  # of a row: rows that differ by no more are of one length
MOST_SHARES = 4  # that make a lattice: where more do, values are too few to tell
LATTICE_SPEEDS = 40  # that are enough for a lattice to be looked closer at


def find_memory(shaper: Shaper, timings: Sequence[Timing]) -> Timing:
    """Find the share of the speed before that each speed keeps, and of some timings the likeliest with it.

    The first of `timings` as it is where the speeds were not smoothed. Where it was said how they were made, only a
    lattice is sign enough.
    """
    if any(_are_as_measured(recording) for recording in shaper.recordings):
        return timings[0]
    shares = _list_lattices(shaper.recordings)
    each = [_Likelihood(shaper, timing) for timing in timings]
    best = _find_likeliest(each[0], shares)
    if best not in shares and not _is_worth_it(each, each[0], best):
        return timings[0]
    likelihood = max(each, key=lambda one: one.of(best))
    if likelihood is not each[0]:
        best = _find_likeliest(likelihood, shares)
    return replace(likelihood.timing, memory=best)


def _are_as_measured(recording: Recording) -> bool:
    """Whether speeds were not smoothed for sure: each is shown several times, or they lie on a lattice as they are."""
    return find_frames(recording.time, recording.speed) is not None or find_lattice(recording.speed) > 0.0


class _Likelihood:
    """The likelihood of speeds as they were logged, by the share of the one before that each keeps."""

    def __init__(self, shaper: Shaper, timing: Timing) -> None:
        self.shaper, self.timing, self.count = shaper, timing, 0
        self._known: dict[float, float] = {}

    def of(self, memory: float) -> float:
        """Compute its logarithm, as of as many speeds as were used without smoothing."""
        if memory not in self._known:
            self._known[memory] = self._measure(memory)
        return self.count * self._known[memory]

    def of_lag(self) -> float:
        """Compute the same without smoothing, beside what lags in a motor."""
        return self.count * self._measure(0.0, LAGGING)

    def _measure(self, memory: float, beside: Sequence[str] = ()) -> float:
        """Measure the mean logarithm of the density of a speed."""
        estimate = self.shaper.fit(replace(self.timing, memory=memory), beside).estimate
        pairs = zip(estimate.problem.intervals, estimate.increments, strict=True)
        rows = [make_error_data(intervals, increments) for intervals, increments in pairs]
        durations = np.concatenate([row.duration for row in rows])
        self.count = self.count or len(durations)
        value = log_likelihood(rows, learn_error_model(rows, estimate.lag), estimate.lag)
        return value / len(durations) + float(np.mean(np.log(durations))) - log(1.0 - memory)


def _list_lattices(recordings: Sequence[Recording]) -> list[float]:
    """List round shares for which what was smoothed lies on a lattice; none where the speeds do as they are."""
    longest = max(recordings, key=len)
    some = np.linspace(1, len(longest) - 1, min(LATTICE_SPEEDS, len(longest) - 1)).astype(int)
    rows = np.diff(longest.time, prepend=2.0 * longest.time[0] - longest.time[1])
    even = np.ptp(rows) < EVEN * float(np.median(rows))
    for durations in (np.ones(len(rows)),) if even else (np.ones(len(rows)), rows):  # counts of each by its own row
        if find_lattice(longest.speed * durations) > 0.0:
            return []
        near = [one for one in ROUND if find_lattice((sharpen(longest.speed, one) * durations)[some]) > 0.0]
        sure = [one for one in near if find_lattice(sharpen(longest.speed, one) * durations) > 0.0]
        if sure:
            return sure if len(sure) <= MOST_SHARES else []
    return []


def _find_likeliest(likelihood: _Likelihood, shares: Sequence[float]) -> float:
    """Find the likeliest share: of those that make a lattice, if there are any."""
    if shares:
        return max(shares, key=likelihood.of)
    return _climb(likelihood.of) if all(map(is_open, likelihood.shaper.recordings)) else 0.0


def _is_worth_it(each: Sequence[_Likelihood], likelihood: _Likelihood, memory: float) -> bool:
    """Decide whether speeds are so much likelier with a share than without, by any timing, beside what lags too."""
    if memory == 0.0 or likelihood.of(memory) - likelihood.of(0.0) <= LEAST_GAIN:
        return False
    plain = max(value for one in each for value in (one.of(0.0), one.of_lag()))
    gain = max(one.of(memory) for one in each) - plain
    most = -0.5 * log(1.0 - memory**2) * likelihood.count  # of white noise, over what it is taken for
    return gain > max(LEAST_GAIN, LEAST_PART * most) and likelihood.count >= LEAST_SPEEDS


def _climb(value: Callable[[float], float]) -> float:
    """Find the likeliest share from 0 on, a round one where that is nearly as likely; 0 where it only falls."""
    tried = [0.0]
    for memory in CLIMB:
        tried.append(memory)
        if value(memory) <= value(tried[-2]):
            break
    top = max(tried, key=value)
    if top == 0.0 or top == tried[-1]:
        return top
    peak = _find_peak(*((memory, value(memory)) for memory in tried[-3:]))
    nearest = min(ROUND, key=lambda one: abs(one - peak))
    best = max((top, peak, nearest), key=value)
    return next(one for one in (nearest, top, peak) if value(one) >= value(best) - AS_LIKELY)


def _find_peak(*points: tuple[float, float]) -> float:
    """Find where a parabola through three points has its top."""
    (a, at_a), (b, at_b), (c, at_c) = points
    left, right = (b - a) * (at_b - at_c), (b - c) * (at_b - at_a)
    return b - 0.5 * ((b - a) * left - (b - c) * right) / (left - right)
