"""Find torque ripple, a load periodic in the shaft angle, as a line in the residual's spectrum over the angle.

A load sin(cθ + φ) of 1 V moves the speed of a fitted motor by a linear response that is had in closed form between two
measured angles; the residual's part along it, for any number of cycles c a turn, is a periodogram over the angle (over
time: N. R. Lomb, Astrophys. Space Sci. 39, 1976). A line is as narrow as the angle range is wide, so that blocks of a
few turns are searched first, their powers added, then counted runs around the best, then the whole recording around the
best of those.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import tau

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.measurement.intervals import Intervals
from motor_identification.measurement.measured_angle import Track
from motor_identification.periodic.response_products import sum_products
from motor_identification.periodic.run_alignment import align_runs
from motor_identification.periodic.whitened_run import BLOCK_TURNS, WhitenedRun, whiten_runs
from motor_identification.recording import Floats, Integers
from motor_model.effects import SPEC_BY_NAME

POINTS_PER_LINE = 4.0  # grid points to the width of a line
ROUGH_PEAKS, PEAK_REACH = 32, 2.0  # of the rough spectrum, and how many of its grid points around each are searched
FINE_CANDIDATES = 3  # of those, which are searched in the whole recording
# Between two knots: grid points, or cycles where grid points are further apart than those that lines of a whole turn
# need; and a share of the cycles where that is more. Measured: 2 % off where knots are that far apart.
KNOT_DISTANCE, KNOT_CYCLES, KNOT_SHARE = 16, 4.0, 0.02
KNOT_TOLERANCE = 0.01  # that a disc's table is solved within there. Measured: responses' squares are 0.2 % off
LEAST_TURNS = 0.01  # of travel: less is no turning
SPILLED = 2.0  # times the sum of a block's white squares: no more of it is explained, as whitening mixes neighbours
USUAL_RIPPLE = 0.3  # of the largest voltage: more goes with the angle where a load hangs or is out of balance only
# Numbers of cycles, from the most on, of which the finest that could be seen is; and what is tried beside each.
FINEST_TRIED, FINEST_NEAR = 24, np.array([1.0, 0.97, 0.93])
# Cycles a turn from which on a ripple comes through a gear, and how large it is there at most, as a share of the
# largest that is looked for: a fine sensor on a slow shaft would show thousands of cycles of a third of the voltage.
MANY_CYCLES, FINE_SIZE = 200.0, 0.1
# Of the sum of white squares, for each counted run and so many more: slips explain by chance.
SLIP_CHANCE, SLIP_CHANCE_BASE = 4.0, 12
# The same of what cannot slip, for each run that has a phase of its own, and for the best of all lines: of 10,000 it
# explains 18. Measured: 19 of 2,641 lines.
PHASE_CHANCE, LINE_CHANCE = 2.0, 30.0


@dataclass(frozen=True)
class Ripple:
    """A load amplitude·sin(cycles·θ + phase), with a phase for every recording: there is no index pulse."""

    cycles: float  # [1/rev]
    amplitude: float  # [V]
    phases: tuple[float, ...]  # [rad]
    tracks: tuple[Track, ...]  # the measured angles with the slips that it reveals
    explained: float  # of the sum of white squares


def find_ripples(estimate: Estimate, tracks: Sequence[Track], least: float = 0.0) -> list[Ripple]:
    """Find the most likely ripples in what an estimate leaves on measured angles, best first, each another line.

    None where the spectrum promises less than `least` of the sum of white squares.
    """
    problem, runs = estimate.problem, whiten_runs(estimate, tracks)
    low, high = SPEC_BY_NAME["ripple_cycles"].box(problem.unknowns.extent)
    most = USUAL_RIPPLE * problem.unknowns.extent.voltage
    turns = max(np.ptp(np.concatenate([run.course.start, run.course.end])) for run in runs) / tau
    high = find_finest(runs, low, high, most)
    width = measure_line(turns) / POINTS_PER_LINE
    rough: Floats = np.arange(low, high + width, width, dtype=np.float64)
    blocks = [run.number_blocks() for run in runs]
    spectrum = _spectrum(runs, rough, blocks, most, problem.raise_if_stopped)
    if spectrum.max() - 2.0 * sum(int(block.max()) + 1 for block in blocks) < least:
        return []
    counted = [run.course.run for run in runs]
    of_run = 1.0 / (POINTS_PER_LINE * max(1.0, *(run.longest_turns() for run in runs)))
    around = np.arange(-PEAK_REACH * width, PEAK_REACH * width, min(of_run, width))
    likely: list[tuple[float, float]] = []  # how much each peak explains at best, and where
    for peak in _peaks(spectrum, ROUGH_PEAKS):
        close = np.unique(np.clip(rough[peak] + around, low, high))
        closer = _spectrum(runs, close, counted, most, problem.raise_if_stopped)
        likely.append((float(closer.max()), float(close[np.argmax(closer)])))
    found: list[Ripple] = []
    around = np.arange(-PEAK_REACH * of_run, PEAK_REACH * of_run, 1.0 / (POINTS_PER_LINE * max(turns, 1.0)))
    for middle in _apart([cycles for _, cycles in sorted(likely, reverse=True)], of_run)[:FINE_CANDIDATES]:
        problem.raise_if_stopped()
        close = np.unique(np.clip(middle + around, low, high))
        lines = [_fit_line(runs, tracks, cycles, problem.intervals) for cycles in close]
        found.append(max(lines, key=lambda line: line.explained))
    chance = sum(map(_explained_by_chance, runs, problem.intervals)) if least > 0.0 else 0.0
    return sorted((line for line in found if line.explained > max(least, chance)), key=lambda line: -line.explained)


def measure_line(turns: float) -> float:
    """Measure how many cycles a turn a line is wide, in blocks of a motion over so many turns.

    An axis that goes on by a part of a turn has wide lines, and may have a sensor that would show thousands of cycles.
    """
    return 1.0 / min(BLOCK_TURNS, max(turns, LEAST_TURNS))


def find_finest(runs: Sequence[WhitenedRun], low: float, high: float, most: float) -> float:
    """Find the most cycles a turn, from low to high, of which a ripple of `most` [V] would stand out of the noise.

    A motor hardly follows a finer one, and rows of a fast motor take its mean. Of many cycles, a smaller one.
    """
    finest = _find_visible(runs, low, high, most)
    if finest <= MANY_CYCLES:
        return finest
    return max(MANY_CYCLES, _find_visible(runs, low, finest, FINE_SIZE * most))


def _find_visible(runs: Sequence[WhitenedRun], low: float, high: float, most: float) -> float:
    for cycles in np.geomspace(high, low, FINEST_TRIED):
        for near in cycles * FINEST_NEAR:  # one alone may be where whole waves pass from row to row
            sums = [run.sum_products(near, np.zeros_like(run.course.run)) for run in runs]
            if 0.5 * most**2 * sum(float(part[0, 0] + part[0, 2]) for part in sums) > LINE_CHANCE:
                return float(cycles)
    return low


def _explained_by_chance(run: WhitenedRun, data: Intervals) -> float:
    """How much the best line explains of one recording's white noise, and a little more."""
    base = SLIP_CHANCE * SLIP_CHANCE_BASE if data.slot > 0.0 else LINE_CHANCE
    return base + explain_runs_by_chance(int(run.course.run.max()), data)


def explain_runs_by_chance(last: int, data: Intervals) -> float:
    """Compute how much of white noise counted runs, up to a last one's number, explain as each is turned to fit best.

    Measured: 45 and 74 of a disc with nothing on it, in 70 and 101 runs between rows that were missing.
    """
    if data.slot > 0.0:
        return SLIP_CHANCE * last
    return 0.0 if data.counts_both_ways else PHASE_CHANCE * last


def _apart(cycles: Sequence[float], width: float) -> list[float]:
    """Leave out what is within a line's width of one before."""
    kept: list[float] = []
    for one in cycles:
        if all(abs(one - other) > POINTS_PER_LINE * width for other in kept):
            kept.append(one)
    return kept


def _spectrum(
    runs: Sequence[WhitenedRun], cycles: Floats, blocks: Sequence[Integers], most: float, go_on: Callable[[], None]
) -> Floats:
    """How much a ripple of each number of cycles, and of `most` [V] or so, explains, each block on its own."""
    rows = zip(runs, blocks, strict=True)
    return np.asarray(np.sum([_powers(run, cycles, block, most, go_on) for run, block in rows], 0))


def _powers(run: WhitenedRun, cycles: Floats, block: Integers, most: float, go_on: Callable[[], None]) -> Floats:
    """The same in one recording.

    The products with the residual are exact; those of the responses among themselves change slowly with the cycles, and
    are had at some (`place_knots`) only. Where whole waves pass between two rows next to nothing answers, and only a
    ripple of many volts would explain anything: its size has a prior, of a standard deviation of `most`. And no block
    has more explained than is there, which products that spill over from the next one would.
    """
    there = SPILLED * np.bincount(block, run.white**2)
    places = place_knots(cycles)
    rough = replace(run, encoder=run.encoder.within(KNOT_TOLERANCE))
    shapes = np.array([rough.sum_products(knot, block) for knot in cycles[places]])
    knots = 0.5 * (shapes[:, :, 0] + shapes[:, :, 2])  # sine and cosine are as good as independent in every block
    powers: list[Floats] = []
    done = 0
    for along, across in sum_products(run.course, run.pull_back(), cycles, block):
        go_on()
        at = np.interp(done + np.arange(len(along)), places, np.arange(len(places)))
        done += len(along)
        low, part = np.divmod(np.minimum(at, len(knots) - 1.0), 1.0)
        first = low.astype(np.int64)
        second = np.minimum(first + 1, len(knots) - 1)
        sizes = knots[first] * (1.0 - part)[:, None] + knots[second] * part[:, None]
        squares = along**2 + across**2
        powers.append(np.minimum(squares / (np.maximum(sizes, 0.0) + 1.0 / most**2), there).sum(axis=1))
    return np.concatenate(powers)


def place_knots(cycles: Floats) -> Integers:
    """Place the knots among evenly spaced numbers of cycles (C,), as indices: closer where cycles are few."""
    if len(cycles) < 2:
        return np.arange(len(cycles))
    least = min(KNOT_DISTANCE * (cycles[1] - cycles[0]), KNOT_CYCLES)
    chosen = [0]
    while chosen[-1] < len(cycles) - 1:
        next_one = cycles[chosen[-1]] + max(least, KNOT_SHARE * cycles[chosen[-1]])
        chosen.append(min(max(int(np.searchsorted(cycles, next_one)), chosen[-1] + 1), len(cycles) - 1))
    return np.array(chosen)


def fit_ripple(estimate: Estimate, tracks: Sequence[Track], cycles: float) -> Ripple:
    """Fit the most likely ripple of so many cycles a turn."""
    return _fit_line(whiten_runs(estimate, tracks), tracks, cycles, estimate.problem.intervals)


def _fit_line(
    runs: Sequence[WhitenedRun], tracks: Sequence[Track], cycles: float, intervals: Sequence[Intervals]
) -> Ripple:
    """Fit a ripple of so many cycles, with every recording's slips."""
    weights, straightened, explained = [], [], 0.0
    for run, track, data in zip(runs, tracks, intervals, strict=True):
        wave = cycles * data.gear
        aligned = align_runs(run.sum_products(cycles, run.course.run), wave * data.slot, data.counts_both_ways)
        weights.append(aligned.weight)
        explained += aligned.explained
        straightened.append(track.slipped(aligned.slips / wave))
    amplitude, phases = float(np.mean(np.abs(weights))), tuple(float(np.angle(weight)) for weight in weights)
    return Ripple(cycles, amplitude, phases, tuple(straightened), explained)


def _peaks(spectrum: Floats, count: int) -> list[int]:
    """Indices of the highest local maxima, highest first."""
    padded = np.concatenate([[-np.inf], spectrum, [-np.inf]])
    tops = np.flatnonzero((padded[1:-1] >= padded[:-2]) & (padded[1:-1] > padded[2:]))
    return [int(i) for i in tops[np.argsort(-spectrum[tops])][:count]]
