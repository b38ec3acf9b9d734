"""Ripple: a load periodic in the shaft angle, searched where no swarm finds it, in a spectrum of narrow lines.

A load sin(cθ + φ) of 1 V moves the speed of a fitted motor by a linear response that is had in closed form between two
measured angles; the residual's part along it, for any number of cycles c a turn, is a periodogram over the angle (over
time: N. R. Lomb, Astrophys. Space Sci. 39, 1976). A line is as narrow as the angle range is wide, so that blocks of a
few turns are searched first, their powers added, and then the whole recording around the best.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import tau

import numpy as np

from motor_identification.alignment import align
from motor_identification.problem import Problem
from motor_identification.recording import Bools, Floats, Integers
from motor_identification.refine import Encoder, learn
from motor_identification.track import Track
from motor_model.compiled import compiled
from motor_model.effects import SPEC_BY_NAME

BLOCK = 8.0  # turns
FINENESS = 4.0  # grid points to the width of a line
CANDIDATES = 4


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
    order: Integers  # of the intervals in time
    stretch: Integers  # number of the counted run, see `Track`
    start: Floats  # [rad] measured angle
    end: Floats  # [rad]
    duration: Floats  # [s]
    moving: Bools
    white: Floats  # of measured minus simulated increments


def ripples(problem: Problem, place: Floats, tracks: Sequence[Track]) -> list[Ripple]:
    """The most likely ripples in what a fitted place (D,) leaves on measured angles, best first, each another line."""
    values = problem.unknowns.parameters(place, "").values
    rate, inertia = values["kv"] / values["ka"], values["ka"]
    runs = _runs(problem, place, tracks)
    spec = SPEC_BY_NAME["ripple_cycles"]
    turns = max(np.ptp(np.concatenate([run.start, run.end])) for run in runs) / tau

    def power(cycles: float, parts: Sequence[Integers]) -> float:
        rows = zip(runs, parts, strict=True)
        return sum(float(_explained(_sums(run, cycles, rate, inertia, part))) for run, part in rows)

    blocks = [_blocks(run) for run in runs]
    width = 1.0 / (FINENESS * min(BLOCK, max(turns, 1.0)))
    rough = np.arange(spec.low, spec.high, width)
    spectrum = np.array([power(cycles, blocks) for cycles in rough])
    found = []
    for peak in _peaks(spectrum, CANDIDATES):
        fine = rough[peak] + np.arange(-width, width, 1.0 / (FINENESS * max(turns, 1.0)))
        lines = [_line(runs, tracks, cycles, rate, inertia, problem) for cycles in fine]
        found.append(max(lines, key=lambda line: line.explained))
    return sorted(found, key=lambda line: -line.explained)


def ripple_of(problem: Problem, place: Floats, tracks: Sequence[Track], cycles: float) -> Ripple:
    """The most likely ripple of so many cycles a turn."""
    values = problem.unknowns.parameters(place, "").values
    return _line(_runs(problem, place, tracks), tracks, cycles, values["kv"] / values["ka"], values["ka"], problem)


def _line(
    runs: Sequence[_Run], tracks: Sequence[Track], cycles: float, rate: float, inertia: float, problem: Problem
) -> Ripple:
    """The best ripple of so many cycles, with every recording's slips."""
    weights, straightened, explained = [], [], 0.0
    for run, track, data in zip(runs, tracks, problem.intervals, strict=True):
        aligned = align(_sums(run, cycles, rate, inertia, run.stretch), cycles * data.slot)
        weights.append(aligned.weight)
        explained += aligned.explained
        straightened.append(track.slipped(np.asarray(aligned.slips * data.slot)))
    amplitude, phases = float(np.mean(np.abs(weights))), tuple(float(np.angle(weight)) for weight in weights)
    return Ripple(cycles, amplitude, phases, tuple(straightened), explained)


def _runs(problem: Problem, place: Floats, tracks: Sequence[Track]) -> list[_Run]:
    runs = []
    rows = zip(problem.intervals, tracks, problem.increments(place), learn(problem, place), strict=True)
    for data, track, increments, encoder in rows:
        angle, moving = track.at(data.time), data.slack == 0.0
        order = np.argsort(data.time[data.first], kind="stable")
        white = encoder.white(np.where(moving, -increments, 0.0))[: len(moving)]
        stretch = track.run_at(data.time[data.first])
        runs.append(_Run(encoder, order, stretch, angle[data.first], angle[data.last], data.duration, moving, white))
    return runs


def _sums(run: _Run, cycles: float, rate: float, inertia: float, block: Integers) -> Floats:
    """What least squares of a ripple of so many cycles needs to know of every block, shape (B, 5)."""
    sums = np.zeros((int(block.max()) + 1, 5))
    _products(run.white, *_response(run, cycles, rate, inertia), block, sums)
    return sums


def _blocks(run: _Run) -> Integers:
    """Number the stretches of a few turns within which the phase is surely kept, shape (I,)."""
    pairs = np.column_stack([run.stretch, np.floor(run.start / (tau * BLOCK)).astype(np.int64)])
    return np.asarray(np.unique(pairs, axis=0, return_inverse=True)[1].reshape(-1))


def _whitened(run: _Run, increments: Floats) -> Floats:
    return run.encoder.white(np.where(run.moving, increments, 0.0))[: len(increments)]


def _response(run: _Run, cycles: float, rate: float, inertia: float) -> tuple[Floats, Floats]:
    """Whitened increments that loads of sin(cycles·θ) and of cos(cycles·θ), 1 V each, make."""
    sine, cosine = np.zeros(len(run.start)), np.zeros(len(run.start))
    _fill_response(run.order, run.start, run.end, run.duration, run.moving, cycles, rate, inertia, sine, cosine)
    return _whitened(run, sine), _whitened(run, cosine)


@compiled
def _fill_response(
    order: Integers, start: Floats, end: Floats, duration: Floats, moving: Bools,
    cycles: float, rate: float, inertia: float, sine: Floats, cosine: Floats,
) -> None:  # fmt: skip
    """Increments of dx/dt = −rate·x − e^(i·cycles·θ)/inertia, θ turning evenly within an interval."""
    speed = complex(0.0, 0.0)
    for i in order:
        h = duration[i]
        if not moving[i] or h <= 0.0:
            speed = complex(0.0, 0.0)
            continue
        here = complex(np.cos(cycles * start[i]), np.sin(cycles * start[i]))
        there = complex(np.cos(cycles * end[i]), np.sin(cycles * end[i]))
        frequency = cycles * (end[i] - start[i]) / h
        fade = np.exp(-rate * h)
        then = speed * fade - (there - fade * here) / complex(rate, frequency) / inertia
        load = (there - here) / complex(0.0, frequency) if abs(frequency) * h > 1e-6 else here * h
        travel = -((then - speed) + load / inertia) / rate
        sine[i], cosine[i] = travel.imag, travel.real
        speed = then


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


@compiled
def _explained(sums: Floats) -> float:
    """How much of the sum of squares the best wave in each block explains."""
    total = 0.0
    for b in range(len(sums)):
        ss, sc, cc, sw, cw = sums[b]
        determinant = ss * cc - sc * sc
        if determinant > 1e-9 * ss * cc:
            total += (cc * sw * sw - 2.0 * sc * sw * cw + ss * cw * cw) / determinant
    return total


def _peaks(spectrum: Floats, count: int) -> list[int]:
    """Indices of the highest local maxima, highest first."""
    padded = np.concatenate([[-np.inf], spectrum, [-np.inf]])
    tops = np.flatnonzero((padded[1:-1] >= padded[:-2]) & (padded[1:-1] > padded[2:]))
    return [int(i) for i in tops[np.argsort(-spectrum[tops])][:count]]
