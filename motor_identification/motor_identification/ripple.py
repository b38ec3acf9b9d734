"""Ripple: a load periodic in the shaft angle, searched where no swarm finds it, in a spectrum of narrow lines.

A load sin(cθ + φ) of 1 V moves the speed of a fitted motor by a linear response that is had in closed form between two
measured angles; the residual's part along it, for any number of cycles c a turn, is a periodogram over the angle (over
time: N. R. Lomb, Astrophys. Space Sci. 39, 1976). A line is as narrow as the angle range is wide, so that blocks of a
few turns are searched first, their powers added, and then the whole recording around the best. What each counted run's
wrong initial speed leaves (the model came to it without the ripple) is projected out before. Near a standstill, where
the shaft swings on its ripple rather than turns over it, nothing is taken.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
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
CANDIDATES, REACH = 3, 2.0  # peaks of the rough spectrum, and how many of its grid points around each are searched
SLOW = 0.03  # of the largest speed: below that a ripple holds or turns back the shaft, no linear response
KNOTS = 16  # grid points
CHANCE, BASE = 4.0, 12  # of the sum of white squares, for each counted run and so many more: slips explain by chance


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
    white: Floats  # of measured minus simulated increments, without what an initial speed explains
    transient: Floats  # whitened increments that an initial speed of every counted run makes, of length 1 in each


def ripples(problem: Problem, place: Floats, tracks: Sequence[Track], least: float = 0.0) -> list[Ripple]:
    """The most likely ripples in what a fitted place (D,) leaves on measured angles, best first, each another line.

    None where the spectrum promises less than `least` of the sum of white squares.
    """
    values = problem.unknowns.parameters(place, "").values
    rate, inertia = values["kv"] / values["ka"], values["ka"]
    runs = _runs(problem, place, tracks)
    spec = SPEC_BY_NAME["ripple_cycles"]
    turns = max(np.ptp(np.concatenate([run.start, run.end])) for run in runs) / tau
    width = 1.0 / (FINENESS * min(BLOCK, max(turns, 1.0)))
    rough = np.arange(spec.low, spec.high, width)
    spectra = [_spectrum(run, rough, rate, inertia, problem.go_on) for run in runs]
    spectrum = np.sum([powers for powers, _blocks in spectra], axis=0)
    if spectrum.max() - 2.0 * sum(blocks for _powers, blocks in spectra) < least:
        return []
    found = []
    for peak in _peaks(spectrum, CANDIDATES):
        problem.go_on()
        fine = rough[peak] + np.arange(-REACH * width, REACH * width, 1.0 / (FINENESS * max(turns, 1.0)))
        lines = [_line(runs, tracks, cycles, rate, inertia, problem) for cycles in fine]
        found.append(max(lines, key=lambda line: line.explained))
    chance = CHANCE * sum(int(run.stretch.max()) + BASE for run in runs) if least > 0.0 else 0.0
    likely = [line for line in found if line.explained > max(least, chance)]
    return sorted(likely, key=lambda line: -line.explained)


def _spectrum(run: _Run, cycles: Floats, rate: float, inertia: float, go_on: Callable[[], None]) -> tuple[Floats, int]:
    """How much a ripple of each number of cycles explains, each block of a few turns on its own; and how many blocks.

    The products with the residual are exact; those of the responses among themselves change slowly with the cycles, and
    are had at every KNOTS-th only.
    """
    block = _blocks(run)
    blocks = int(block.max()) + 1
    pull = run.encoder.pull(run.white)
    knots = cycles[::KNOTS]
    shapes = np.array([_sums(run, knot, rate, inertia, block) for knot in knots])
    sizes = 0.5 * (shapes[:, :, 0] + shapes[:, :, 2])  # sine and cosine are as good as independent in every block
    powers = np.empty(len(cycles))
    for i, number in enumerate(cycles):
        go_on()
        sine, cosine = _bare_response(run, number, rate, inertia)
        at = min((number - knots[0]) / (knots[1] - knots[0]), len(knots) - 1.0001)
        size = sizes[int(at)] + (at - int(at)) * (sizes[int(at) + 1] - sizes[int(at)])
        along = np.bincount(block, np.where(run.moving, pull * sine, 0.0), blocks)
        across = np.bincount(block, np.where(run.moving, pull * cosine, 0.0), blocks)
        powers[i] = float(np.sum((along**2 + across**2)[size > 0.0] / size[size > 0.0]))
    return powers, blocks


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
    problem = problem.without(tuple(np.abs(data.speed) < SLOW * np.abs(data.speed).max() for data in problem.intervals))
    values = problem.unknowns.parameters(place, "").values
    rate = values["kv"] / values["ka"]
    runs = []
    rows = zip(problem.intervals, tracks, problem.increments(place), learn(problem, place), strict=True)
    for data, track, increments, encoder in rows:
        angle, moving = track.at(data.time), data.slack == 0.0
        order = np.argsort(data.time[data.first], kind="stable")
        stretch = track.run_at(data.time[data.first])
        run = _Run(
            encoder, order, stretch, angle[data.first], angle[data.last], data.duration, moving, -increments, increments
        )
        fading = np.zeros(len(increments))
        _fill_transient(order, stretch, data.duration, moving, rate, fading)
        white, transient = _whitened(run, run.white), _whitened(run, fading)
        length = np.sqrt(np.bincount(stretch, transient**2))[stretch]
        run = replace(run, white=white, transient=np.divide(transient, length, where=length > 0.0, out=0.0 * length))
        runs.append(replace(run, white=_without_transient(run, white)))
    return runs


def _without_transient(run: _Run, white: Floats) -> Floats:
    """What is left of whitened increments (I,) once every run has an initial speed of its own."""
    along = np.bincount(run.stretch, run.transient * white)
    return white - along[run.stretch] * run.transient


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
    sine, cosine = _bare_response(run, cycles, rate, inertia)
    return _without_transient(run, _whitened(run, sine)), _without_transient(run, _whitened(run, cosine))


def _bare_response(run: _Run, cycles: float, rate: float, inertia: float) -> tuple[Floats, Floats]:
    """The same, not whitened [rad]."""
    sine, cosine = np.zeros(len(run.start)), np.zeros(len(run.start))
    _fill_response(run.order, run.start, run.end, run.duration, run.moving, cycles, rate, inertia, sine, cosine)
    return sine, cosine


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
def _fill_transient(
    order: Integers, stretch: Integers, duration: Floats, moving: Bools, rate: float, travel: Floats
) -> None:
    """Increments of dx/dt = −rate·x in every run that begins with x = 1 rad/s."""
    speed, number = 0.0, -1
    for i in order:
        if stretch[i] != number or not moving[i]:
            speed, number = 1.0, stretch[i]
        if moving[i]:
            fade = np.exp(-rate * duration[i])
            travel[i] = speed * (1.0 - fade) / rate
            speed *= fade


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
