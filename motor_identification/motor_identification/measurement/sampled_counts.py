"""Locate the disc from counts read at samples, without stamps: when it was where, and how surely.

A count c says that c flanks have passed and the next has not: the angle is anywhere in one slot, (c + ½) slots with a
standard deviation of 1/√12 slots. But a slow motor shows more. Where it takes several samples for a slot, the sample at
which the count changes and the one before it enclose the flank: in the middle between them the angle is the flank's,
to within half the travel of one sample. So with v the travel between two samples in slots:

    v ≥ 1   every sample is a fix of (c + ½) slots with σ = 1/√12, whether its count changed or not
    v < 1   every change is a fix of half way from c₋ + ½ to c + ½, in the middle between both samples, with σ = v/√12

The two agree at v = 1, and neither favours samples for what they show, which would bias them by up to half a slot.
Stamps of samples that jitter by σ_t blur every fix by ω·σ_t more.
"""

from dataclasses import dataclass, replace
from math import inf, sqrt

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.measurement.edges import Edges, move_reversals_to_slowest, read_directions
from motor_identification.recording import Bools, Floats, Integers, Recording
from motor_identification.sensor.parabola_scatter import PARABOLA, WINDOW, measure_scatter
from motor_identification.sensor.white_noise import estimate_white_noise

UNIFORM_SIGMA = 1.0 / sqrt(12.0)  # standard deviation of what is uniform over 1
RATE_NEIGHBOURS = 3  # changes on either side that tell how fast the disc turns
# Terms of the polynomials that most of a motion's bends under a voltage that jumps go into: two freedoms are left.
BENT = 5
# By their terms, median over mean of χ² with the degrees of freedom that they leave of a window.
CHI2_MEDIAN_SHARE = {PARABOLA: 0.839, BENT: 0.693}
# Of the jitter that parabolas tell: what the highest terms of uneven rows tell below that, they do not by chance: of 12
# windows the median of two freedoms is unsure by 0.4 of a variance, and this is a quarter of one.
BENDS = 0.5
# Times the variance that counting leaves in a prediction from 6 counts before: that of a line, carried on by one.
PREDICTED_RATIO = 1.9
FAST = 0.7  # of the rate that a quarter of fixes exceed: rows by whose noise stamps' jitter is told
EVEN_ROWS = 0.05  # of a row: how far they may be from even for that
JITTER_RATIO = 1.8  # times the variance that counting leaves, from which on stamps are said to jitter


@dataclass(frozen=True)
class Fixes:
    """Where the disc was, in order of time; arrays of shape (F,).

    Within a run the disc turns one way. Runs share no scale: after a reversal an encoder may count the other flank.
    """

    time: Floats  # [s] since the first sample
    place: Floats  # [slots] turned the run's way
    height: Floats  # [slots] counted up and down since the recording's start
    blur: Floats  # [slots] standard deviation of the place
    run: Integers
    way: Integers  # −1, +1; 0 where a single channel leaves it open
    rate: Floats  # [slots/s] how fast the disc turned there

    def __len__(self) -> int:
        return len(self.time)


@dataclass(frozen=True)
class Changes:
    """The samples whose count is another than before; arrays of shape (C,)."""

    sample: Integers  # index into the recording
    way: Integers  # −1, 0, +1 as in `Fixes`
    run: Integers

    def __len__(self) -> int:
        return len(self.sample)


def extract_count_changes(recording: Recording) -> Changes:
    """Extract all changes of the count, in runs of one direction."""
    steps = np.diff(recording.edge_count)
    sample = np.flatnonzero(steps) + 1
    way = np.sign(steps[sample - 1])
    if recording.info.single_channel:
        middle = 0.5 * (recording.time[sample] + recording.time[sample - 1])
        edges = Edges(middle, recording.edge_count[sample], read_directions(recording.speed[sample]))
        way = move_reversals_to_slowest(edges, recording).direction
    changes = number_runs(sample, way)
    own_board = not recording.info.single_channel and recording.info.source != "import"
    return part_returns(changes) if own_board else changes


def number_runs(sample: Integers, way: Integers) -> Changes:
    """Number the runs of one direction in changes at these samples (C,) in these directions (C,)."""
    return Changes(sample, way, np.cumsum(np.diff(way, prepend=way[:1]) != 0))


def part_returns(changes: Changes) -> Changes:
    """Part the first change after every turn from the next: it may take back the one before.

    Our boards count a flank back by which the shaft leaves a hole again; the next flank is half a slot away then, else
    a whole one, and a count does not tell which.
    """
    turned = np.diff(changes.run, prepend=changes.run[:1]) != 0
    after = np.append(False, turned[:-1])[: len(turned)] & ~turned
    return replace(changes, run=np.cumsum(turned | after))


def locate_fixes(recording: Recording, changes: Changes) -> Fixes:
    """Locate the disc at every instant at which the counts say where it was; `changes` are those of the recording."""
    time = recording.time
    if not len(changes):
        return Fixes(time[:0], time[:0], time[:0], time[:0], changes.run, changes.way, time[:0])
    turned = np.abs(np.diff(recording.edge_count, prepend=recording.edge_count[0])).cumsum()
    follows = np.minimum(np.searchsorted(changes.sample, np.arange(len(time))), len(changes) - 1)
    step, rates = np.diff(time, prepend=time[0]), _rates(time, turned, changes)
    rate = np.interp(time, time[changes.sample], rates.rate)
    travel = rate * step
    changed = np.isin(np.arange(len(time)), changes.sample)
    point = (travel >= 1.0) & (changed | _within(changes, follows, len(time)))
    point[[0, -1]] = True  # the motor stands there, or is seen at an instant that it did not choose
    k, c = np.flatnonzero(point), np.flatnonzero(changed & ~(travel >= 1.0))
    gap = turned[c] - turned[c - 1]
    at = np.concatenate([time[k], 0.5 * (time[c] + time[c - 1])])
    # The flank lies half way between the angles at both samples, which is not where the disc is in the middle of a time
    # in which it gains speed.
    bend = np.clip(np.interp(time[c], time[changes.sample], rates.growth) * step[c] ** 2 / 8.0, -0.25, 0.25)
    place = np.concatenate([turned[k] + 0.5, 0.5 * (turned[c] + turned[c - 1] + 1.0) - bend])
    sharp = np.maximum(travel[c], np.minimum(gap - 1.0, 1.0))
    blur = UNIFORM_SIGMA * np.concatenate([np.ones(len(k)), sharp])
    order, which = np.argsort(at, kind="stable"), np.concatenate([k, c])
    run, way = changes.run[follows[which]], changes.way[follows[which]]
    count = recording.edge_count - recording.edge_count[0]
    height = np.concatenate([count[k] + 0.0, 0.5 * (count[c] + count[c - 1])])
    fixes = Fixes(at[order], place[order], height[order], blur[order], run[order], way[order], rate[which][order])
    bound = max(_bound_jitter(recording, fixes), measure_rounding(recording))
    jitter = min(estimate_stamp_jitter(fixes), bound)
    return replace(fixes, blur=np.hypot(fixes.blur, jitter * fixes.rate))


def _bound_jitter(recording: Recording, fixes: Fixes) -> float:
    """Bound how far [s] stamps jitter, where a motor whose voltage jumps follows no parabola.

    Of even rows a count is predicted from those and voltages before. Of uneven ones jitter is white, so that every term
    of a polynomial through a window has the same of it, and of what a motor's inertia lets through the highest terms
    have the least. Measured: 0.76 ms by parabolas through rows of 50 ms of a motor of 84 ms in a staircase, under exact
    stamps, and 0.15 ms by the two highest terms; its friction and its inductance were within that.
    """
    early, late = np.quantile(np.diff(recording.time), (0.05, 0.95))
    rate = np.interp(recording.time, fixes.time, fixes.rate)
    counts = np.diff(recording.edge_count, prepend=recording.edge_count[0]) != 0  # a motor that stands has no jitter
    turning = counts & (rate >= FAST * np.quantile(fixes.rate, 0.75))
    fast = float(np.median(rate[turning])) if turning.any() else 0.0
    noise = estimate_white_noise(recording.edge_count.astype(np.float64), recording.voltage, turning)
    if late - early > EVEN_ROWS * early:
        rough = estimate_stamp_jitter(fixes, BENT)
        return rough if rough < BENDS * estimate_stamp_jitter(fixes) else inf
    if noise <= 0.0 or fast <= 0.0:
        return inf
    return sqrt(max(noise**2 - PREDICTED_RATIO * UNIFORM_SIGMA**2, 0.0)) / fast


def measure_rounding(recording: Recording) -> float:
    """Measure by how much [s] stamps that are whole multiples of a clock's tick are off.

    No row number tells it: rows that come late now and then do so truly, and a count is predicted by those before. 0
    where rows are all alike, or some of those are missing: the step that all are multiples of is a row then, no tick.
    """
    steps = np.diff(recording.sample_time)
    tick = int(np.gcd.reduce(steps)) if len(steps) else 0
    return 0.0 if not len(steps) or tick == np.min(steps) else tick * 1e-9 * UNIFORM_SIGMA


def _within(changes: Changes, follows: Integers, samples: int) -> Bools:
    """Which samples lie between two changes of one run, shape (K,); `follows` numbers the change after each."""
    before = np.maximum(follows - 1, 0)
    between = (np.arange(samples) > changes.sample[0]) & (np.arange(samples) < changes.sample[-1])
    return np.asarray(between & (changes.run[before] == changes.run[follows]))


@dataclass(frozen=True)
class Rates:
    """How fast the disc turns at every change of the count; arrays of shape (C,)."""

    rate: Floats  # [slots/s]
    growth: Floats  # [slots/s²] acceleration


def _rates(time: Floats, turned: Integers, changes: Changes) -> Rates:
    """From a few changes on either side within the run, and the middles of the samples that enclose them.

    Near the ends of a run both are those of the nearest place with neighbours on both sides, carried on from there.
    """
    middle = 0.5 * (time[changes.sample] + time[changes.sample - 1])
    there = 0.5 * (turned[changes.sample] + turned[changes.sample - 1])
    first = np.searchsorted(changes.run, changes.run, side="left")
    last = np.searchsorted(changes.run, changes.run, side="right") - 1
    reach = np.minimum((last - first) // 2, RATE_NEIGHBOURS)
    here = np.arange(len(middle))
    centre = np.clip(here, first + reach, last - reach)
    before, after = centre - reach, centre + reach

    def over(begin: Integers, end: Integers) -> Floats:
        apart = middle[end] - middle[begin]
        return np.divide(there[end] - there[begin], apart, out=np.zeros(len(apart)), where=apart > 0.0)

    mean = np.where(reach > 0, 0.5 * (over(before, centre) + over(centre, after)), over(first, last))
    mean = np.where(mean > 0.0, mean, 1.0 / (time[changes.sample] - time[changes.sample - 1]))  # a change on its own
    apart = 0.5 * (middle[after] - middle[before])
    gain = over(centre, after) - over(before, centre)
    growth = np.divide(gain, apart, out=np.zeros(len(middle)), where=apart > 0.0)
    carried = mean + growth * (middle - middle[centre])
    return Rates(np.clip(carried, 0.25 * mean, 4.0 * mean), growth)


def estimate_stamp_jitter(fixes: Fixes, terms: int = PARABOLA) -> float:
    """Estimate the standard deviation [s] of the stamps, from how far fixes lie beside a parabola through neighbours.

    0 where that is no more than counting itself leaves. It takes a dozen windows of a motor fast enough to tell.
    terms: of the polynomial that is laid through them.
    """
    if len(fixes) < 2 * WINDOW:
        return 0.0
    scatter = measure_scatter(fixes.time, fixes.place, terms) / (WINDOW - terms)
    middle = slice(WINDOW // 2, WINDOW // 2 + len(scatter))
    rate, counting = fixes.rate[middle], fixes.blur[middle] ** 2
    run = sliding_window_view(fixes.run, WINDOW)
    fast = (rate >= np.quantile(rate, 0.5)) & (fixes.blur[middle] > 0.99 * UNIFORM_SIGMA)
    told = (run[:, 0] == run[:, -1]) & fast
    if np.count_nonzero(told) < 12:
        return 0.0
    share = CHI2_MEDIAN_SHARE[terms]
    size = float(np.median(scatter[told] / counting[told])) / share
    if size < JITTER_RATIO:
        return 0.0
    return sqrt(max(float(np.median((scatter[told] / share - counting[told]) / rate[told] ** 2)), 0.0))
