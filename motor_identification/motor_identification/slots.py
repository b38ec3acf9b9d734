"""Irregular slots: the same error every turn, so that many turns know it; estimated jointly with the motor.

The disc's flanks are off by a table a of 2N offsets [rad]: N seen turning forward, N (the other flanks) backward. An
interval's increment is off by a[last] − a[first]. The table enters linearly, so that for any motor the best one, and
with it the residual that no table explains, is had in closed form (variable projection; Golub & Pereyra, SIAM J. Numer.
Anal. 10, 1973), under a Gaussian prior of variance σ² that makes unseen slots no special case.

Per direction the table has no mean, which is the starting angle. Its first harmonic is eccentricity: where that is
fitted as an effect of its own, the table may not take it too.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import eigh

from motor_identification.intervals import Intervals
from motor_identification.noise import Whitening, adjoint, whiten
from motor_identification.recording import Bools, Floats, Integers
from motor_model.compiled import compiled

STIFF = 1e6  # prior variances that mean and first harmonic are kept below


@dataclass(frozen=True)
class SlotIndex:
    """Which entry of the table each interval's ends are, shape (I,); −1 where an end is no edge."""

    first: Integers
    last: Integers
    size: int  # 2N

    def increments(self, table: Floats) -> Floats:
        """What a table (2N,) adds to the increments [rad], shape (I,)."""
        with_blank = np.append(table, 0.0)
        return np.asarray(with_blank[self.last] - with_blank[self.first])

    def gathered(self, increments: Floats) -> Floats:
        """The transpose of `increments`: (I,) → (2N,)."""
        sums = np.bincount(self.last + 1, increments, self.size + 1) - np.bincount(
            self.first + 1, increments, self.size + 1
        )
        return np.asarray(sums[1:])


def slot_index(intervals: Intervals, angle: Floats) -> SlotIndex:
    """Follow the disc through a recording; where runs are broken, the simulated angle [rad] bridges the gap."""
    n = round(2.0 * np.pi / intervals.slot)
    known = intervals.edge[:, 0] >= 0
    direction = np.sign(intervals.speed).astype(np.int64)
    turns = angle / intervals.slot
    first, last = np.full(len(known), -1), np.full(len(known), -1)
    _follow(
        intervals.fresh, known, direction, intervals.edge, turns[intervals.first], turns[intervals.last],
        _flank_offset(intervals, known, direction, turns), n, first, last,
    )  # fmt: skip
    return SlotIndex(first, last, 2 * n)


def _flank_offset(intervals: Intervals, known: Bools, direction: Integers, turns: Floats) -> float:
    """How far the backward flanks lie after the forward ones, as a share of a slot: a circular mean over reversals."""
    starts = np.flatnonzero(intervals.fresh & known)
    ends = np.append(starts[1:], known.sum()) - 1
    before, after = ends[:-1], starts[1:]
    turned = direction[before] != direction[after]
    travel = turns[intervals.first[after]] - turns[intervals.last[before]]
    phases = 2.0 * np.pi * travel[turned] * direction[before][turned]
    return float(np.angle(np.exp(1j * phases).sum()) / (2.0 * np.pi)) if len(phases) else 0.5


@compiled
def _follow(
    fresh: Bools,
    known: Bools,
    direction: Integers,
    edge: Integers,
    start: Floats,
    end: Floats,
    offset: float,
    n: int,
    first: Integers,
    last: Integers,
) -> None:
    """Number the flanks: within a run by counting, from run to run by the simulated travel in slots."""
    place, at, way, begun = 0, 0.0, 0, False
    for k in range(len(known)):
        if not known[k]:
            continue
        if fresh[k] and begun:
            shift = 0.0
            if direction[k] != way:
                shift = -offset if way > 0 else offset
            place += int(round(start[k] - at + shift))
        begun, way = True, direction[k]
        base = 0 if way > 0 else n
        first[k] = base + place % n
        place += way * (edge[k, 1] - edge[k, 0])
        last[k] = base + place % n
        at = end[k]


@dataclass(frozen=True)
class SlotTable:
    """The table's part in whitened residuals, for one whitening."""

    whitening: Whitening
    index: SlotIndex
    first_harmonic: bool  # whether the table may have one

    @cached_property
    def gram(self) -> Floats:
        """AᵀA of the whitened table, shape (2N, 2N); a column costs one pass over the intervals."""
        columns = np.zeros((self.index.size, self.index.size))
        for h in np.flatnonzero(self.seen):
            unit = np.zeros(self.index.size)
            unit[h] = 1.0
            columns[h] = self.index.gathered(adjoint(self.whitening, self.whitened(unit)))
        return columns

    @cached_property
    def seen(self) -> Integers:
        """How many interval ends each entry has, shape (2N,)."""
        both = np.concatenate([self.index.first, self.index.last])
        return np.bincount(both[both >= 0], minlength=self.index.size)

    def whitened(self, table: Floats) -> Floats:
        """What a table adds to whitened residuals, shape (I,)."""
        return whiten(self.whitening, self.index.increments(table))

    def scores(self, white: Floats) -> Floats:
        """Aᵀz, shape (2N,)."""
        return self.index.gathered(adjoint(self.whitening, white))

    @cached_property
    def modes(self) -> tuple[Floats, Floats]:
        """AᵀA in the prior's own coordinates: eigenvalues (2N,) and vectors (2N, 2N) with VᵀPV = 1, VᵀAᵀAV = diag."""
        values, vectors = eigh(self.gram, _prior(self.index.size, self.first_harmonic))
        return np.maximum(values, 0.0), vectors


def _prior(size: int, first_harmonic: bool) -> Floats:
    """The prior's precision for unit variance, (2N, 2N): stiff against what a direction's table may not have."""
    n = size // 2
    phase = 2.0 * np.pi * np.arange(n) / n
    shapes = [np.full(n, 1.0 / np.sqrt(n))]
    if not first_harmonic:
        shapes += [np.sqrt(2.0 / n) * np.cos(phase), np.sqrt(2.0 / n) * np.sin(phase)]
    columns = np.column_stack(shapes)
    return np.kron(np.eye(2), np.eye(n) + STIFF * columns @ columns.T)


@dataclass(frozen=True)
class Projection:
    """Removes from whitened residuals what a table with prior variance σ² [rad²] explains."""

    table: SlotTable
    variance: float

    def _coordinates(self, white: Floats) -> Floats:
        values, vectors = self.table.modes
        return np.asarray(vectors.T @ self.table.scores(white) / (values + 1.0 / self.variance))

    def best(self, white: Floats) -> Floats:
        """The most likely table [rad] for whitened residuals (I,), shape (2N,)."""
        return np.asarray(self.table.modes[1] @ self._coordinates(white))

    def __call__(self, white: Floats) -> Floats:
        """(I,) → (I + 2N,): what is left, then the table's own share of the cost."""
        coordinates = self._coordinates(white)
        left = white - self.table.whitened(self.table.modes[1] @ coordinates)
        return np.concatenate([left, coordinates / np.sqrt(self.variance)])


def likely_variance(table: SlotTable, white: Floats, guess: float, most: float, rounds: int) -> float:
    """The variance σ² [rad²] of the seen slots' offsets for whitened residuals (I,), by expectation maximisation.

    It stays below `most` [rad²]: what is beyond any real disc is an error of the model, and shall not pass for noise.
    """
    values, vectors = table.modes
    scores = vectors.T @ table.scores(white)
    seen = table.seen > 0
    variance = guess
    for _ in range(rounds):
        precision = values + 1.0 / variance
        mean = vectors @ (scores / precision)
        posterior = np.sum(vectors**2 / precision, axis=1)
        variance = min(float(np.mean(mean[seen] ** 2 + posterior[seen])), most)
    return variance
