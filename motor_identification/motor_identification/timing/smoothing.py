"""Find whether speeds were filtered before they were logged, and by which of the filters of small programs.

The commonest is y_k = m·y_{k−1} + (1 − m)·x_k; what others there are stands in `speed_filter.py`. They lag, as an
inductance or a delay does, and what they do to the speeds they do to their noise too, which nothing in the motor can.
So x is computed for several m, and the motor fitted to it beside what shapes most motions; what that leaves is judged
as random torque and sensor noise (`noise/error_learning.py`). The density of y is that of x divided by the part of y
that it is in its own row, such as 1 − m, and has to be larger than that beside what lags in a motor. Counted speeds lie
on a lattice for the right filter alone, which nothing does by chance. Filters with means in them are tried where speeds
have their zeros (`unit_zeros.py`).
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from math import exp

import numpy as np

from motor_identification.noise.error_data import log_likelihood, make_error_data
from motor_identification.noise.error_learning import learn_error_model
from motor_identification.recording import Recording
from motor_identification.sensor.held_samples import find_frames
from motor_identification.sensor.speed_sensor import are_said_counts, find_counts, lies_between_counts
from motor_identification.sensor.value_lattice import find_lattice, measure_scatter
from motor_identification.timing.shaped_fit import Shaper
from motor_identification.timing.speed_filter import BILINEAR, KINDS, LEAST_ROWS, MEAN, MEMORY, SpeedFilter
from motor_identification.timing.telling_blocks import take_blocks
from motor_identification.timing.timing import ASSUMED, Timing, is_open
from motor_identification.timing.unit_zeros import find_means
from motor_model.effects import LAGGING

# Tried in turn as long as they are likelier: beyond, the motor's own lag is taken for a filter, and that for the motor.
CLIMB = (0.0, 0.15, 0.3, 0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.92, 0.94, 0.96, 0.98)
TAUGHT = 0.854  # by a tutorial that many follow: v = 0.854*v + 0.0728*x + 0.0728*x_before
ROUND = tuple(
    sorted({k / 20 for k in range(1, 20)} | {k / 16 for k in range(1, 16)} | {TAUGHT, 0.96, 0.97, 0.98, 0.99})
)
# Of log likelihood: in all, and as a part of what it would be if nothing but sensor noise made speeds unlike their
# prediction. Measured: 0.04 to 3 of that where speeds were smoothed, the less the stronger a torque is beside them.
LEAST_GAIN, LEAST_PART = 20.0, 0.04
# Of log likelihood: what is less likely by no more is what was meant, if it is a round share, a simpler filter, or the
# timing that is assumed.
AS_LIKELY = 3.0
# Of log likelihood, from a top to its neighbours: with less between them a parabola finds it. Else half as far from it,
# so many times at most: counts are whole at one share alone.
SHARP, HALVINGS = 40.0, 5
# And of fewer than MANY speeds more, in all. Measured: 20 to 33 of few that were not filtered, or otherwise.
LEAST_SPEEDS, MANY, LEAST_GAIN_OF_FEW = 60, 200, 40.0
# Of the one before: programs that keep less hardly filter. Measured: 0.02 to 0.15 of three logs that nobody filtered.
LEAST_SHARE = 0.19
LONGEST = 0.1  # of the speeds: a filter that is later had speeds that hardly moved, whose last digits are likely then
EVEN = 1e-3  # of a row: rows that differ by no more are of one length
MOST_SHARES = 4  # that make a lattice: where more do, values are too few to tell
# Times the least scatter of values on their lattice: a share that leaves more is near to the one that was. Measured: 11
# and 20 of the next ones to it of two stairs, at whose levels any share leaves whole counts.
SAME_SCATTER = 3.0
LATTICE_SPEEDS = 40  # that are enough for a lattice to be looked closer at
# Times what the digits of the log become where a filter is undone: a lattice of no larger step is theirs, and no
# encoder's. Measured: 1.0 of firmware that gives whole counts a second; of counts that passed a filter 5 and more.
OF_DIGITS = 2.0


def find_filter(shaper: Shaper, timings: Sequence[Timing]) -> Timing:
    """Find the filter that speeds passed, and of some timings the likeliest with it.

    The first of `timings` as it is where they passed none. Where it was said how they were made, only a lattice is sign
    enough; or that they lie between the counts that were said.
    """
    recordings = shaper.recordings
    if any(find_frames(one.time, one.speed) is not None for one in recordings):  # each is shown several times
        return timings[0]
    are_open = all(map(is_open, recordings))
    means = find_means(recordings) if are_open else ()
    are_open = are_open or all(map(lies_between_counts, recordings))
    if not means and _are_counts(recordings):
        return timings[0]
    each = [Likelihood(shaper, timing) for timing in timings]
    chosen = _choose_by_timing(each, means, are_open)
    if chosen is None:
        return timings[0]
    by, best, sure = chosen
    # Poles that are off make up for a timing that is not the log's: each timing has a filter of its own.
    own = {one: (None if sure or one is by else _choose_filter(one, means, are_open)[0]) or best for one in each}
    likelihood = max(each, key=lambda one: one.of(own[one]) + AS_LIKELY * (one.timing == ASSUMED))
    return replace(likelihood.timing, filter=own[likelihood])


def _choose_by_timing(
    each: Sequence["Likelihood"], means: Sequence[int], are_open: bool
) -> tuple["Likelihood", SpeedFilter, bool] | None:
    """Choose the filter that speeds passed by the first timing with which they passed one, and whether it is sure.

    Measured: 2,500 speeds of a tachogenerator, a mean of three rows' own instants, were less likely by 23 behind that
    mean with those of rows' means, and by theirs likelier by 2,319. Of 5,700 behind an RC filter of 0.93 of a row the
    share was 0.25 by rows' means, likelier by 6,900 than none, where an inductance is by 9,000; by instants it was
    0.34, by 10,100.
    """
    for one in each:
        best, sure = _choose_filter(one, means, are_open)
        if best is not None and (sure or _is_worth_it(each, one, best)) and one.is_driven(best):
            return one, best, sure
    return None


def _are_counts(recordings: Sequence[Recording]) -> bool:
    """Whether speeds lie on a lattice of counts as they are: then they passed no poles, but a mean perhaps."""
    return any(find_counts(one.speed, one.sample_period) > 0.0 or are_said_counts(one) for one in recordings)


def _choose_filter(likelihood: "Likelihood", means: Sequence[int], are_open: bool) -> tuple[SpeedFilter | None, bool]:
    """Choose the likeliest filter with zeros of one of these means, and say whether a lattice makes it sure.

    None without any.
    """
    if means and _are_counts(likelihood.shaper.recordings):
        return max((SpeedFilter(MEAN, rows) for rows in means), key=likelihood.of), False
    found: list[SpeedFilter | None] = [SpeedFilter(MEAN, rows) for rows in means if rows > LEAST_ROWS]
    if not means or LEAST_ROWS in means:  # of which the bilinear transform makes one for every pole
        best, sure = _choose_poles(likelihood, BILINEAR if means else MEMORY, are_open)
        if sure:
            return best, True
        found.append(best)
    return max(found, key=likelihood.of), False


def _choose_poles(likelihood: "Likelihood", simplest: str, are_open: bool) -> tuple[SpeedFilter | None, bool]:
    """Choose the likeliest filter with poles, and say whether a lattice makes it sure; None without any.

    The simplest is climbed from none on; others from where they come as late.
    """
    others = [kind for kind in KINDS if kind not in (simplest, MEAN)]
    shares = _list_lattices(likelihood.shaper.recordings, simplest)
    if shares:  # what two rows' mean makes of counts lies on a lattice of halves
        halves = _list_lattices(likelihood.shaper.recordings, BILINEAR, shares) if simplest == MEMORY else []
        found = [SpeedFilter(simplest, share) for share in shares] + [SpeedFilter(BILINEAR, share) for share in halves]
        return max(found, key=likelihood.of), True
    first = _make(simplest, CLIMB[_climb(partial(likelihood.of_kind, simplest))]) if are_open else None
    if first is None:
        return None, False
    tops = {simplest: CLIMB.index(first.number) if first.kind == simplest else 0}
    for kind in others:
        tops[kind] = _climb(partial(likelihood.of_kind, kind), _find_as_late(kind, first.delay))
    kind = max(tops, key=lambda kind: likelihood.of_kind(kind, CLIMB[tops[kind]]) - AS_LIKELY * (kind != simplest))
    if tops[kind] == len(CLIMB) - 1:  # it goes on, and is no filter
        return None, False
    number = _find_peak(partial(likelihood.of_kind, kind), tops[kind])
    number = _swap_poles(likelihood, number) if kind == MEMORY and number > 0.0 else number  # 0: none is likelier
    return (_make(kind, number) if number >= LEAST_SHARE or kind == BILINEAR else None), False


def _swap_poles(likelihood: "Likelihood", share: float) -> float:
    """Choose between a filter's share and the one that the motor behind it keeps, uphill from there.

    Which of two lags in series is the filter's and which the motor's only noise and the blur of a row tell: the climb
    from none ends at the first, and the other has to be as much likelier as any filter.
    """
    keeps = likelihood.keep_of_motor(SpeedFilter(MEMORY, share))
    value = partial(likelihood.of_kind, MEMORY)
    top = _climb(value, min(range(1, len(CLIMB) - 1), key=lambda k: abs(CLIMB[k] - keeps)))
    if top in (0, len(CLIMB) - 1):
        return share
    other = _find_peak(value, top)
    return other if value(other) > value(share) + LEAST_GAIN else share


def _find_as_late(kind: str, delay: float) -> int:
    """Find which of the numbers to climb makes a kind of filter most nearly so late [rows]."""
    return min(range(1, len(CLIMB)), key=lambda k: abs(SpeedFilter(kind, CLIMB[k]).delay - delay))


def _make(kind: str, number: float) -> SpeedFilter | None:
    """Make a filter of a kind: one by the bilinear transform without a pole is a mean of two rows."""
    if number > 0.0:
        return SpeedFilter(kind, number)
    return SpeedFilter(MEAN, 2) if kind == BILINEAR else None


class Likelihood:
    """The likelihood of speeds as they were logged, by the filter that they passed.

    count: of how many; 0: as many as are used without a filter. Readings of which one leaves out speeds compare by one.
    """

    def __init__(self, shaper: Shaper, timing: Timing, count: int = 0) -> None:
        self.shaper, self.timing, self.count = shaper, timing, count
        self._known: dict[SpeedFilter | None, float] = {}
        self._torque: dict[SpeedFilter | None, float] = {}

    def of(self, passed: SpeedFilter | None) -> float:
        """Compute its logarithm, as of as many speeds as were used without a filter."""
        if passed not in self._known:
            self._known[passed] = self._measure(passed)
        return self.count * self._known[passed]

    def of_kind(self, kind: str, number: float) -> float:
        """Compute the same, by a kind of filter and its number."""
        return self.of(_make(kind, number))

    def keep_of_motor(self, passed: SpeedFilter | None) -> float:
        """Compute how much of its speed a motor keeps in a row, as it is fitted behind a filter."""
        estimate = self.shaper.fit(replace(self.timing, filter=passed)).estimate
        return exp(-estimate.problem.sample_period / estimate.parameters.time_constant)

    def is_driven(self, passed: SpeedFilter | None) -> bool:
        """Decide whether what moves the motor behind a filter is its voltage, and no random torque beyond that.

        A memory that is longer than the motion's rise makes a first jump of it, which no voltage makes.
        """
        self.of(passed)
        return self._torque.get(passed, 0.0) <= max(
            float(np.max(np.abs(one.voltage))) for one in self.shaper.recordings
        )

    def of_lag(self) -> float:
        """Compute the same without a filter, beside what lags in a motor."""
        return self.count * self._measure(None, LAGGING)

    def _measure(self, passed: SpeedFilter | None, beside: Sequence[str] = ()) -> float:
        """Measure the mean logarithm of the density of a speed."""
        estimate = self.shaper.fit(replace(self.timing, filter=passed), beside).estimate
        columns = estimate.problem.intervals, estimate.increments, self.shaper.blocks
        rows = [
            block
            for intervals, increments, spans in zip(*columns, strict=True)
            for block in take_blocks(make_error_data(intervals, increments), intervals.time[intervals.last], spans)
        ]
        durations = np.concatenate([row.duration for row in rows])
        self.count = self.count or len(durations)
        errors = learn_error_model(rows, estimate.lag)
        value = log_likelihood(rows, errors, estimate.lag)
        if not beside:
            self._torque[passed] = errors.rms_voltage
        first = passed.log_first if passed else 0.0
        if self.shaper.rows.nominal:  # what was logged is a count over one period for all rows
            durations = np.full(len(durations), float(np.median(durations)))
        return value / len(durations) + float(np.mean(np.log(durations))) - first


def _list_lattices(recordings: Sequence[Recording], kind: str, shares: Sequence[float] = ROUND) -> list[float]:
    """List the shares for which what passed a kind of filter lies on a lattice; none where the speeds themselves do."""
    longest = max(recordings, key=len)
    some = np.linspace(1, len(longest) - 1, min(LATTICE_SPEEDS, len(longest) - 1)).astype(int)
    rows = np.diff(longest.time, prepend=2.0 * longest.time[0] - longest.time[1])
    even = np.ptp(rows) < EVEN * float(np.median(rows))
    for durations in (np.ones(len(rows)),) if even else (np.ones(len(rows)), rows):  # counts of each by its own row
        if find_counts(longest.speed * durations, longest.sample_period) > 0.0:
            return []
        counted = {share: SpeedFilter(kind, share).undo(longest.speed) * durations for share in shares}
        near = [share for share in shares if find_lattice(counted[share][some]) > 0.0]
        digit = OF_DIGITS * find_lattice(np.diff(longest.speed * durations)) if near else 0.0
        least = {share: digit / exp(SpeedFilter(kind, share).log_first) for share in near}
        steps = {share: find_lattice(counted[share]) for share in near}
        off = {share: measure_scatter(counted[share], step) for share, step in steps.items() if step > least[share]}
        if off:
            sure = [share for share in off if off[share] <= SAME_SCATTER * min(off.values())]
            return sure if len(sure) <= MOST_SHARES else []
    return []


def _is_worth_it(each: Sequence[Likelihood], likelihood: Likelihood, passed: SpeedFilter) -> bool:
    """Decide whether speeds are so much likelier behind a filter than without, by any timing, beside what lags too."""
    if likelihood.of(passed) - likelihood.of(None) <= LEAST_GAIN:
        return False
    plain = max(value for one in each for value in (one.of(None), one.of_lag()))
    gain = max(one.of(passed) for one in each) - plain
    most = passed.log_likeness * likelihood.count  # of white noise, over what it is taken for
    enough = likelihood.count >= max(LEAST_SPEEDS, passed.delay / LONGEST)
    least = LEAST_GAIN if likelihood.count >= MANY else LEAST_GAIN_OF_FEW
    return enough and gain > max(least, LEAST_PART * most)


def _climb(value: Callable[[float], float], begin: int = 0) -> int:
    """Climb from one of the shares uphill, and say which is at the top."""
    k = begin
    while k > 0 and value(CLIMB[k - 1]) > value(CLIMB[k]):
        k -= 1
    while k + 1 < len(CLIMB) and value(CLIMB[k + 1]) > value(CLIMB[k]):
        k += 1
    return k


def _find_peak(value: Callable[[float], float], k: int) -> float:
    """Find the likeliest share near one of those to climb, a round one where that is nearly as likely."""
    top = CLIMB[k]
    if k in (0, len(CLIMB) - 1):
        return top
    low, high = CLIMB[k - 1], CLIMB[k + 1]
    for _ in range(HALVINGS):
        if value(top) - min(value(low), value(high)) <= SHARP:
            break
        below, above = 0.5 * (low + top), 0.5 * (top + high)
        best = max((below, top, above), key=value)
        low, high = {below: (low, top), top: (below, above), above: (top, high)}[best]
        top = best
    peak = _fit_parabola(*((share, value(share)) for share in (low, top, high)))
    nearest = min(ROUND, key=lambda one: abs(one - peak))
    best = max((top, peak, nearest), key=value)
    return next(one for one in (nearest, top, peak) if value(one) >= value(best) - AS_LIKELY)


def _fit_parabola(*points: tuple[float, float]) -> float:
    """Find where a parabola through three points has its top."""
    (a, at_a), (b, at_b), (c, at_c) = points
    left, right = (b - a) * (at_b - at_c), (b - c) * (at_b - at_a)
    return b - 0.5 * ((b - a) * left - (b - c) * right) / (left - right)
