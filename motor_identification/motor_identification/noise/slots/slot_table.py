"""Estimate a table of irregular slots, jointly with the motor: the same error every turn, which many turns know.

The disc's flanks are off by a table a of 2N offsets [rad]: N seen turning forward, N (the other flanks) backward. An
interval's increment is off by a[last] − a[first]. The table enters linearly, so that for any motor the best one, and
with it the residual that no table explains, is had in closed form (variable projection; Golub & Pereyra, SIAM J. Numer.
Anal. 10, 1973), under a Gaussian prior of variance σ² that makes unseen slots no special case.

Per direction the table has no mean, which is the starting angle. Its first harmonic is eccentricity: where that is
fitted as an effect of its own, the table may not take it too. The linear algebra is in
`eigenmodes.py`, and for many slots in `conjugate_gradient.py`.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.noise.angle_noise import Whitening
from motor_identification.noise.slots.conjugate_gradient import TOLERANCE, IterativeSolver
from motor_identification.noise.slots.eigenmodes import Modes, compute_eigenmodes, forbidden_shapes, prior_root
from motor_identification.noise.slots.normal_equations import fill_diagonal, fill_explained, fill_gram, fill_scores
from motor_identification.recording import Bools, Floats, Integers
from motor_model.compiled import compiled

MOST_MODES = 400  # entries: their eigenmodes take some 20 ms, about as long as all else that a fit asks of them
VARIANCE_TOLERANCE = 1e-4  # relative change of the variance at which expectation maximisation ends


@dataclass(frozen=True)
class SlotIndex:
    """Which entry of the table each interval's ends are, shape (I,); −1 where an end is no edge."""

    first: Integers
    last: Integers
    size: int  # 2N

    def increments(self, table: Floats) -> Floats:
        """Compute what a table (2N,) adds to the increments [rad], shape (I,)."""
        with_blank = np.append(table, 0.0)
        return np.asarray(with_blank[self.last] - with_blank[self.first])


def index_slots(intervals: Intervals, angle: Floats) -> SlotIndex:
    """Index the slots at every interval's ends; where runs are broken, the simulated angle [rad] bridges the gap."""
    n = round(2.0 * np.pi / intervals.slot / intervals.gear)  # of the encoder's shaft, behind whatever gear
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
            if direction[k] == -way:
                shift = -offset if way > 0 else offset
            place += int(round(start[k] - at + shift))
        begun, way = True, direction[k] if direction[k] != 0 else way
        base = 0 if way > 0 else n
        first[k] = base + place % n
        place += way * abs(edge[k, 1] - edge[k, 0])  # two channels count down backward
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
        """AᵀA of the whitened table, shape (2N, 2N)."""
        half = np.zeros((self.index.size + 1, self.index.size + 1))
        fill_gram(*self._filter, half)
        return np.asarray((half + half.T)[:-1, :-1])

    @property
    def may_be_off(self) -> bool:
        """Whether a table has any shape but those that it may not have: that of a single slot has none."""
        return self.index.size // 2 > (1 if self.first_harmonic else 3)

    @property
    def _filter(self) -> tuple[Bools, Floats, Floats, Integers, Integers]:
        return self.whitening.fresh, self.whitening.gain, self.whitening.scale, self.index.first, self.index.last

    @cached_property
    def seen(self) -> Integers:
        """How many interval ends each entry has, shape (2N,)."""
        both = np.concatenate([self.index.first, self.index.last])
        return np.bincount(both[both >= 0], minlength=self.index.size)

    def scores(self, white: Floats) -> Floats:
        """Aᵀz, shape (2N,)."""
        sums = np.zeros(self.index.size + 1)
        fill_scores(*self._filter, np.ascontiguousarray(white), sums)
        return sums[:-1]

    def left(self, white: Floats, table: Floats) -> Floats:
        """Take a table's part from whitened residuals (I,)."""
        left = np.array(white, dtype=np.float64)
        fill_explained(*self._filter, np.append(table, 0.0), left)
        return left

    @cached_property
    def solver(self) -> Modes | IterativeSolver:
        """What solves for the table: by eigenmodes, or where those would take long by conjugate gradients."""
        if self.index.size <= MOST_MODES:
            return compute_eigenmodes(self.gram, self.seen > 0, self.first_harmonic)
        forbidden = forbidden_shapes(self.index.size // 2, self.first_harmonic)
        root = prior_root(forbidden, np.arange(self.index.size))
        diagonal = np.zeros(self.index.size + 1)
        fill_diagonal(*self._filter, diagonal)
        return IterativeSolver(self._filter, np.ascontiguousarray(root.T), diagonal[:-1], self.seen > 0)


@dataclass(frozen=True)
class Projection:
    """Removes from whitened residuals what a table with prior variance σ² [rad²] explains."""

    table: SlotTable
    variance: float
    tolerance: float = TOLERANCE  # that a table of many slots is solved within

    @property
    def solver(self) -> Modes | IterativeSolver:
        """What solves for the table within the tolerance."""
        return self.table.solver.within(self.tolerance)

    def best(self, white: Floats) -> Floats:
        """Compute the most likely table [rad] for whitened residuals (I,), shape (2N,)."""
        solver = self.solver
        return solver.table(solver.coordinates(self.table.scores(white), self.variance))

    def __call__(self, white: Floats) -> Floats:
        """(I,) → (I + 2N,): what is left, then the table's own share of the cost."""
        solver = self.solver
        coordinates = solver.coordinates(self.table.scores(white), self.variance)
        left = self.table.left(white, solver.table(coordinates))
        return np.concatenate([left, coordinates / np.sqrt(self.variance)])


def estimate_slot_variance(table: SlotTable, white: Floats, guess: float, most: float, rounds: int) -> float:
    """Estimate the variance σ² [rad²] of the seen slots' offsets, by expectation maximisation on white residuals (I,).

    It stays below `most` [rad²]: what is beyond any real disc is an error of the model, and shall not pass for noise.
    Where no slot is seen, as in a few edges of which none follow each other, or a disc has so few that none of them may
    be off, the guess is all there is.
    """
    count = np.count_nonzero(table.seen)
    if count == 0 or not table.may_be_off:
        return guess
    solver, scores = table.solver, table.scores(white)
    variance, coordinates = guess, None
    for _ in range(rounds):
        coordinates = solver.coordinates(scores, variance, coordinates)
        mean = solver.table(coordinates)
        before, variance = variance, min((float(mean @ mean) + solver.posterior(variance)) / count, most)
        if abs(variance - before) < VARIANCE_TOLERANCE * before:
            break
    return variance
