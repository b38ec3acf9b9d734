"""Find torque ripple, a load periodic in the shaft angle, as a line in the residual's spectrum over the angle.

A load sin(cθ + φ) of 1 V moves the speed of a fitted motor by a linear response that is had in closed form between two
measured angles; the residual's part along it, for any number of cycles c a turn, is a periodogram over the angle (over
time: N. R. Lomb, Astrophys. Space Sci. 39, 1976). A line is as narrow as the angle range is wide, so that blocks of a
few turns are searched first, their powers added, then counted runs around the best, then the whole recording around the
best of those. What each counted run's wrong initial speed leaves (the model came to it without the ripple) is projected
out before. Near a standstill, where the shaft swings on its ripple rather than turns over it, nothing is taken.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import tau

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.parameter_space import SLOW_SPEED
from motor_identification.estimation.whitened_fit import Encoder, learn_encoders
from motor_identification.measurement.measured_angle import Track
from motor_identification.periodic.autoregression import Autoregression, fit_autoregression
from motor_identification.periodic.linear_response import Course
from motor_identification.periodic.run_alignment import align_runs
from motor_identification.recording import Floats, Integers
from motor_model.compiled import compiled
from motor_model.effects import SPEC_BY_NAME

BLOCK_TURNS = 8.0  # turns
POINTS_PER_LINE = 4.0  # grid points to the width of a line
ROUGH_PEAKS, PEAK_REACH = 32, 2.0  # of the rough spectrum, and how many of its grid points around each are searched
FINE_CANDIDATES = 3  # of those, which are searched in the whole recording
KNOT_DISTANCE = 16  # grid points
SLIP_CHANCE, SLIP_CHANCE_BASE = (
    4.0,
    12,
)  # of the sum of white squares, for each counted run and so many more: slips explain by chance


@dataclass(frozen=True)
class Ripple:
    """A load amplitude·sin(cycles·θ + phase), with a phase for every recording: there is no index pulse."""

    cycles: float  # [1/rev]
    amplitude: float  # [V]
    phases: tuple[float, ...]  # [rad]
    tracks: tuple[Track, ...]  # the measured angles with the slips that it reveals
    explained: float  # of the sum of white squares


@dataclass(frozen=True)
class _Run:
    """One recording's residual, whitened, with what is needed to whiten a response; arrays of shape (I,)."""

    encoder: Encoder
    colour: Autoregression
    course: Course
    white: Floats  # of measured minus simulated increments, without what an initial speed explains
    transient: Floats  # whitened increments that an initial speed of every counted run makes, of length 1 in each


def find_ripples(estimate: Estimate, tracks: Sequence[Track], least: float = 0.0) -> list[Ripple]:
    """Find the most likely ripples in what an estimate leaves on measured angles, best first, each another line.

    None where the spectrum promises less than `least` of the sum of white squares.
    """
    problem, runs = estimate.problem, _make_runs(estimate, tracks)
    low, high = SPEC_BY_NAME["ripple_cycles"].box(problem.unknowns.extent)
    turns = max(np.ptp(np.concatenate([run.course.start, run.course.end])) for run in runs) / tau
    width = 1.0 / (POINTS_PER_LINE * min(BLOCK_TURNS, max(turns, 1.0)))
    rough = np.arange(low, high, width)
    blocks = [_blocks(run) for run in runs]
    spectrum = _spectrum(runs, rough, blocks, problem.raise_if_stopped)
    if spectrum.max() - 2.0 * sum(int(block.max()) + 1 for block in blocks) < least:
        return []
    counted = [run.course.run for run in runs]
    of_run = 1.0 / (POINTS_PER_LINE * max(1.0, *(_longest_run(run) for run in runs)))
    around = np.arange(-PEAK_REACH * width, PEAK_REACH * width, of_run)
    likely: list[tuple[float, float]] = []  # how much each peak explains at best, and where
    for peak in _peaks(spectrum, ROUGH_PEAKS):
        closer = _spectrum(runs, rough[peak] + around, counted, problem.raise_if_stopped)
        likely.append((float(closer.max()), float((rough[peak] + around)[np.argmax(closer)])))
    found, slots = [], [(data.slot, data.gear) for data in problem.intervals]
    around = np.arange(-PEAK_REACH * of_run, PEAK_REACH * of_run, 1.0 / (POINTS_PER_LINE * max(turns, 1.0)))
    for middle in _apart([cycles for _, cycles in sorted(likely, reverse=True)], of_run)[:FINE_CANDIDATES]:
        problem.raise_if_stopped()
        lines = [_fit_line(runs, tracks, cycles, slots) for cycles in middle + around]
        found.append(max(lines, key=lambda line: line.explained))
    chance = SLIP_CHANCE * sum(int(run.course.run.max()) + SLIP_CHANCE_BASE for run in runs) if least > 0.0 else 0.0
    return sorted((line for line in found if line.explained > max(least, chance)), key=lambda line: -line.explained)


def _longest_run(run: _Run) -> float:
    """Measure the longest counted run of a recording in turns."""
    begin, end = np.full((2, int(run.course.run.max(initial=0)) + 1), [[np.inf], [-np.inf]])
    for angle in (run.course.start, run.course.end):
        np.minimum.at(begin, run.course.run, angle)
        np.maximum.at(end, run.course.run, angle)
    return float((end - begin).max()) / tau


def _apart(cycles: Sequence[float], width: float) -> list[float]:
    """Leave out what is within a line's width of one before."""
    kept: list[float] = []
    for one in cycles:
        if all(abs(one - other) > POINTS_PER_LINE * width for other in kept):
            kept.append(one)
    return kept


def _spectrum(runs: Sequence[_Run], cycles: Floats, blocks: Sequence[Integers], go_on: Callable[[], None]) -> Floats:
    """How much a ripple of each number of cycles explains, each block of every recording on its own."""
    return np.asarray(np.sum([_powers(run, cycles, block, go_on) for run, block in zip(runs, blocks, strict=True)], 0))


def _powers(run: _Run, cycles: Floats, block: Integers, go_on: Callable[[], None]) -> Floats:
    """The same in one recording.

    The products with the residual are exact; those of the responses among themselves change slowly with the cycles, and
    are had at every KNOT_DISTANCE-th only.
    """
    shapes = np.array([_sums(run, knot, block) for knot in cycles[::KNOT_DISTANCE]])
    knots = 0.5 * (shapes[:, :, 0] + shapes[:, :, 2])  # sine and cosine are as good as independent in every block
    powers: list[Floats] = []
    for along, across in run.course.products(run.encoder.pull(run.colour.whiten_adjoint(run.white)), cycles, block):
        go_on()
        at = (sum(map(len, powers)) + np.arange(len(along))) / KNOT_DISTANCE
        low, part = np.divmod(np.minimum(at, len(knots) - 1.0), 1.0)
        first = low.astype(np.int64)
        second = np.minimum(first + 1, len(knots) - 1)
        sizes = knots[first] * (1.0 - part)[:, None] + knots[second] * part[:, None]
        squares = along**2 + across**2
        powers.append(np.divide(squares, sizes, where=sizes > 0.0, out=np.zeros_like(squares)).sum(axis=1))
    return np.concatenate(powers)


def fit_ripple(estimate: Estimate, tracks: Sequence[Track], cycles: float) -> Ripple:
    """Fit the most likely ripple of so many cycles a turn."""
    slots = [(data.slot, data.gear) for data in estimate.problem.intervals]
    return _fit_line(_make_runs(estimate, tracks), tracks, cycles, slots)


def _fit_line(
    runs: Sequence[_Run], tracks: Sequence[Track], cycles: float, slots: Sequence[tuple[float, float]]
) -> Ripple:
    """Fit a ripple of so many cycles, with every recording's slips; `slots` [rad] and gear of every recording."""
    weights, straightened, explained = [], [], 0.0
    for run, track, (slot, gear) in zip(runs, tracks, slots, strict=True):
        aligned = align_runs(_sums(run, cycles, run.course.run), cycles * slot * gear)
        weights.append(aligned.weight)
        explained += aligned.explained
        straightened.append(track.slipped(np.asarray(aligned.slips * slot)))
    amplitude, phases = float(np.mean(np.abs(weights))), tuple(float(np.angle(weight)) for weight in weights)
    return Ripple(cycles, amplitude, phases, tuple(straightened), explained)


def _make_runs(estimate: Estimate, tracks: Sequence[Track]) -> list[_Run]:
    # Slower, a ripple holds or turns back the shaft: no linear response.
    slow = tuple(np.abs(data.speed) < SLOW_SPEED * np.abs(data.speed).max() for data in estimate.problem.intervals)
    estimate = estimate.on(estimate.problem.without(slow))
    runs = []
    rows = zip(estimate.problem.intervals, tracks, estimate.increments, learn_encoders(estimate), strict=True)
    for data, track, increments, encoder in rows:
        angle, begun = data.gear * track.at(data.time), data.time[data.first]  # of the encoder's (the motor's) shaft
        course = Course(
            np.argsort(begun, kind="stable"), track.run_at(begun), angle[data.first], angle[data.last], data.duration,
            data.slack == 0.0, *estimate.lag,
        )  # fmt: skip
        moved = np.where(course.moving, -increments, 0.0)
        colour = fit_autoregression(encoder.white(moved)[: len(moved)], course.order)
        run = _Run(encoder, colour, course, -increments, increments)
        white, transient = _whitened(run, run.white), _whitened(run, course.transient())
        length = np.sqrt(np.bincount(course.run, transient**2))[course.run]
        run = replace(run, white=white, transient=np.divide(transient, length, where=length > 0.0, out=0.0 * length))
        runs.append(replace(run, white=_without_transient(run, white)))
    return runs


def _without_transient(run: _Run, white: Floats) -> Floats:
    """What is left of whitened increments (I,) once every counted run has an initial speed of its own."""
    along = np.bincount(run.course.run, run.transient * white)
    return white - along[run.course.run] * run.transient


def _sums(run: _Run, cycles: float, block: Integers) -> Floats:
    """What least squares of a ripple of so many cycles needs to know of every block, shape (B, 5)."""
    sums = np.zeros((int(block.max()) + 1, 5))
    sine, cosine = (_without_transient(run, _whitened(run, part)) for part in run.course.response(cycles))
    _products(run.white, sine, cosine, block, sums)
    return sums


def _blocks(run: _Run) -> Integers:
    """Number the stretches of a few turns within which the phase is surely kept, shape (I,)."""
    pairs = np.column_stack([run.course.run, np.floor(run.course.start / (tau * BLOCK_TURNS)).astype(np.int64)])
    return np.asarray(np.unique(pairs, axis=0, return_inverse=True)[1].reshape(-1))


def _whitened(run: _Run, increments: Floats) -> Floats:
    return run.colour.whiten(run.encoder.white(np.where(run.course.moving, increments, 0.0))[: len(increments)])


@compiled
def _products(white: Floats, sine: Floats, cosine: Floats, block: Integers, sums: Floats) -> None:
    """Add up, for every block, the products that least squares needs: (B, 5)."""
    for i in range(len(white)):
        row = sums[block[i]]
        row[0] += sine[i] * sine[i]
        row[1] += sine[i] * cosine[i]
        row[2] += cosine[i] * cosine[i]
        row[3] += sine[i] * white[i]
        row[4] += cosine[i] * white[i]


def _peaks(spectrum: Floats, count: int) -> list[int]:
    """Indices of the highest local maxima, highest first."""
    padded = np.concatenate([[-np.inf], spectrum, [-np.inf]])
    tops = np.flatnonzero((padded[1:-1] >= padded[:-2]) & (padded[1:-1] > padded[2:]))
    return [int(i) for i in tops[np.argsort(-spectrum[tops])][:count]]
