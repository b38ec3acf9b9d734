"""A slotted disc before one light barrier: a motion becomes rising edges at exact times, with the truth beside them.

Hole k of N fills the first half of slot k. A rising edge is the light's return: moving forward it comes at the flank
where the hole begins, moving backward at the one where it ends, half a slot away. Each flank sits off its place by a
Gaussian share of a slot of its own. A motor that rocks over one flank makes an edge with every forward pass;
two channels see it come back, too.

The disc shows θ + e·sin(θ + phase) with θ from the recording's start, and stands at `start_angle` [rad] on top of that;
so at θ = 0 it already shows e·sin(phase). An edge that is missed is neither counted nor stamped, and the period after
it spans the gap; each edge is missed independently of the others.
"""

from dataclasses import dataclass, fields
from math import floor, pi, sin

import numpy as np
from numba import njit
from numpy.typing import NDArray

from motor_model.errors import ModelError

from .motor import Motion

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Disc:
    """Where the two flanks of each hole are, as shares of a slot; arrays of shape (N,)."""

    begin: Floats  # near 0: the flank that forward motion sees
    end: Floats  # near 0.5: the flank that backward motion sees

    @classmethod
    def cut(cls, slots: int = 96, irregularity: float = 0.0, seed: int = 0) -> "Disc":
        """A disc whose flanks are off by `irregularity` [share of a slot, standard deviation], zero in the mean.

        Raises:
            ModelError: no slots, or so irregular that flanks would change places.
        """
        if slots < 1 or not 0.0 <= irregularity <= 0.1:
            raise ModelError(f"No disc has {slots} slots with irregularity {irregularity}: at least 1 and 0 to 0.1.")
        off = np.clip(np.random.default_rng(seed).standard_normal((2, slots)), -4.0, 4.0)
        off = irregularity * (off - off.mean(axis=1, keepdims=True))
        return cls(off[0], 0.5 + off[1])


@dataclass(frozen=True)
class Edges:
    """Rising edges in order of time; every array has shape (E,)."""

    time: Floats  # [s] since the start of the motion, exact
    angle: Floats  # [rad] true angle of the shaft since the start
    speed: Floats  # [rad/s] true speed of the shaft
    direction: NDArray[np.int64]  # +1, -1
    flank: NDArray[np.int64]  # slots passed since the disc's own zero: the flank is hole flank % N

    def __len__(self) -> int:
        return len(self.time)

    def only(self, which: NDArray[np.bool_] | NDArray[np.int64]) -> "Edges":
        """The edges at which `which`, shape (E,), is true, or of those numbers."""
        return Edges(self.time[which], self.angle[which], self.speed[which], self.direction[which], self.flank[which])


def edges_of(
    motion: Motion, disc: Disc, *, start_angle: float = 0.0, eccentricity: float = 0.0, phase: float = 0.0
) -> Edges:
    """Every rising edge of a motion."""
    nodes = np.column_stack([motion.time, motion.angle, motion.speed])
    found, flank = _passes(nodes, disc.begin, disc.end, start_angle, eccentricity, phase)
    return Edges(found[:, 0], found[:, 1], found[:, 2], found[:, 3].astype(np.int64), flank)


def with_returns(
    motion: Motion,
    disc: Disc,
    rises: Edges,
    *,
    start_angle: float = 0.0,
    eccentricity: float = 0.0,
    phase: float = 0.0,
) -> tuple[Edges, NDArray[np.bool_]]:
    """Rising edges and, where the shaft leaves a hole by the flank by which it entered it, the falling edge there.

    Second, shape (E,): which of them are such returns. Two channels see them, and take the rising edge back.
    """
    nodes = np.column_stack([motion.time, motion.angle, motion.speed])
    found, flank = _passes(nodes, disc.end, disc.begin, start_angle, eccentricity, phase)
    falls = Edges(found[:, 0], found[:, 1], found[:, 2], found[:, 3].astype(np.int64), flank)
    every = _joined(rises, falls)
    falling = np.repeat([False, True], [len(rises), len(falls)])
    by_begin = (every.direction > 0) != falling  # which of the hole's two flanks is passed
    order = np.lexsort((falling, every.time))
    hole, by_begin, falling = every.flank[order], by_begin[order], falling[order]
    back = np.zeros(len(order), dtype=np.bool_)  # by the flank of the edge before, which was a rising one
    back[1:] = falling[1:] & ~falling[:-1] & (hole[1:] == hole[:-1]) & (by_begin[1:] == by_begin[:-1])
    kept = ~falling | back
    return every.only(order[kept]), back[kept]


def _joined(first: Edges, second: Edges) -> Edges:
    """All of them, one after the other."""
    names = (field.name for field in fields(Edges))
    return Edges(*(np.concatenate([getattr(first, name), getattr(second, name)]) for name in names))


def missed(edges: Edges, rate: float, random: np.random.Generator) -> NDArray[np.bool_]:
    """Which edges the board misses, shape (E,)."""
    return random.random(len(edges)) < rate


@njit(cache=True)
def _angle_that_shows(shown: float, eccentricity: float, phase: float) -> float:
    """Solve θ + e·sin(θ + phase) = shown; a contraction for e < 1, Newton from its third iterate."""
    angle = shown
    for _ in range(3):
        angle = shown - eccentricity * sin(angle + phase)
    for _ in range(4):
        excess = angle + eccentricity * sin(angle + phase) - shown
        angle -= excess / (1.0 + eccentricity * np.cos(angle + phase))
    return angle


@njit(cache=True)
def _when(a: Floats, b: Floats, angle: float) -> tuple[float, float]:
    """(time, speed) at which the cubic through two nodes' angles and speeds passes an angle between theirs."""
    dt = b[0] - a[0]
    m0, m1, rise = a[2] * dt, b[2] * dt, b[1] - a[1]
    c2, c3 = 3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise
    want = angle - a[1]
    low, high = 0.0, 1.0
    x = want / rise
    slope = rise
    for _ in range(60):
        excess = x * (m0 + x * (c2 + x * c3)) - want
        if (excess > 0.0) == (rise > 0.0):
            high = x
        else:
            low = x
        slope = m0 + x * (2.0 * c2 + 3.0 * x * c3)
        newton = x - excess / slope if slope * rise > 0.0 else -1.0
        new = newton if low <= newton <= high else 0.5 * (low + high)
        if abs(new - x) < 1e-13:
            break
        x = new
    return a[0] + x * dt, slope / dt


@njit(cache=True)
def _passes(
    nodes: Floats, begin: Floats, end: Floats, start_angle: float, eccentricity: float, phase: float
) -> tuple[Floats, NDArray[np.int64]]:
    """(time, angle, speed, direction), shape (E, 4), and the flank, shape (E,), of every rising edge."""
    slots = len(begin)
    pitch = 2.0 * pi / slots
    found: Floats = np.empty((1024, 4))
    flank: NDArray[np.int64] = np.empty(1024, dtype=np.int64)
    count = 0
    before = nodes[0, 1] + eccentricity * sin(nodes[0, 1] + phase) + start_angle
    for i in range(1, len(nodes)):
        after = nodes[i, 1] + eccentricity * sin(nodes[i, 1] + phase) + start_angle
        way = 1 if after > before else -1
        places = begin if way > 0 else end
        first, last = int(floor(before / pitch)) - way, int(floor(after / pitch)) + way
        for k in range(first, last + way, way):
            place = (k + places[k % slots]) * pitch
            if not (before < place <= after or after <= place < before):
                continue
            if count == len(found):
                found = np.concatenate((found, np.empty_like(found)))
                flank = np.concatenate((flank, np.empty_like(flank)))
            angle = _angle_that_shows(place - start_angle, eccentricity, phase)
            time, speed = _when(nodes[i - 1], nodes[i], angle)
            found[count, 0], found[count, 1], found[count, 2], found[count, 3] = time, angle, speed, way
            flank[count] = k
            count += 1
        before = after
    return found[:count], flank[:count]
