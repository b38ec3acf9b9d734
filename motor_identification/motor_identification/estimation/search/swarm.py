"""Particle swarm optimisation: find the minimum of a cost over a box; knows nothing about motors.

A ring of neighbours shares the best θ it knows, inertia and pulls are Clerc and Kennedy's constriction values:

    v ← χ v + c·r1·(own best − x) + c·r2·(neighbours' best − x),   x ← x + v,   χ = 0.7298, c = 1.49618

(M. Clerc, J. Kennedy, IEEE Trans. Evol. Comput. 6(1), 2002; ring: Kennedy & Mendes, CEC 2002.) The ring keeps several
local minima alive for longer than one global best does. A particle that leaves the box is put back on its wall and
loses the velocity that carried it out, so that a minimum on the wall is found and nothing outside is ever evaluated.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Cost = Callable[[Floats], Floats]  # θ (S, D) → costs (S,)
Progress = Callable[[int, float], None]  # epoch, best cost so far

INERTIA = 0.7298
PULL = 1.49618
FASTEST_MOVE = 0.5  # of the box per epoch


@dataclass(frozen=True, slots=True)
class SwarmConfig:
    """How to search; `stall` epochs without an improvement by `tolerance` (relative) end it early, 0 never does."""

    particles: int
    epochs: int
    seed: int
    neighbours: int = 2  # on each side of the ring
    stall: int = 40
    tolerance: float = 1e-9


@dataclass(frozen=True)
class SwarmResult:
    """The best θ found; `thetas` and `costs` are every particle's own best, best first."""

    theta: Floats  # (D,)
    cost: float
    trace: Floats  # best cost after each epoch, the first entry before any
    evaluations: int
    thetas: Floats  # (S, D)
    costs: Floats  # (S,)


def minimise(
    cost: Cost, low: Floats, high: Floats, config: SwarmConfig, progress: Progress | None = None
) -> SwarmResult:
    """Minimise a cost over the box low..high, both of shape (D,); one that is not a number counts as infinite.

    Raises:
        ValueError: the box is empty or not finite, or there are fewer than two particles.
    """
    low, high = _checked_box(low, high)
    if config.particles < 2:
        raise ValueError("a swarm has at least two particles")
    random = np.random.default_rng(config.seed)

    def evaluate(x: Floats) -> Floats:
        costs = np.asarray(cost(_scale_to_box(low, high, x)), dtype=np.float64)
        return np.where(np.isfinite(costs), costs, np.inf)

    x = _latin_hypercube(random, config.particles, len(low))
    velocity = (random.random(x.shape) - 0.5) * FASTEST_MOVE
    best, best_cost = x.copy(), evaluate(x)
    trace, stalled = [float(best_cost.min())], 0
    for epoch in range(config.epochs):
        leader = best[_ring_leaders(best_cost, config.neighbours)]
        x, velocity = _fly(random, x, velocity, best, leader)
        costs = evaluate(x)
        better = costs < best_cost
        best[better], best_cost[better] = x[better], costs[better]
        trace.append(float(best_cost.min()))
        stalled = 0 if _is_better(trace[-2], trace[-1], config.tolerance) else stalled + 1
        if progress is not None:
            progress(epoch + 1, trace[-1])
        if config.stall and stalled >= config.stall:
            break
    return _result(_scale_to_box(low, high, best), best_cost, np.array(trace))


def _checked_box(low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """The box as its low and its high corner, both (D,)."""
    low, high = np.asarray(low, dtype=np.float64), np.asarray(high, dtype=np.float64)
    if not (np.all(np.isfinite(low)) and np.all(np.isfinite(high)) and np.all(low < high)):
        raise ValueError("the box must have finite bounds, each low below its high")
    return low, high


def _scale_to_box(low: Floats, high: Floats, x: Floats) -> Floats:
    """Scale x in the unit box to the box; rounding does not carry it outside."""
    return np.asarray(np.clip(low + (high - low) * x, low, high))


def _is_better(before: float, after: float, tolerance: float) -> bool:
    """Whether a cost fell by more than a share of its size, whatever its sign; from none to any is progress too."""
    return after < before - (tolerance * abs(before) if np.isfinite(before) else 0.0)


def _result(thetas: Floats, costs: Floats, trace: Floats) -> SwarmResult:
    """The outcome, the best particle first."""
    order = np.argsort(costs, kind="stable")
    return SwarmResult(
        theta=thetas[order[0]],
        cost=float(costs[order[0]]),
        trace=trace,
        evaluations=len(thetas) * len(trace),
        thetas=thetas[order],
        costs=costs[order],
    )


def _fly(
    random: np.random.Generator, x: Floats, velocity: Floats, best: Floats, leader: Floats
) -> tuple[Floats, Floats]:
    """Move particles by one epoch; strays are put on the wall they crossed and stopped there."""
    own, others = random.random(x.shape), random.random(x.shape)
    velocity = INERTIA * velocity + PULL * (own * (best - x) + others * (leader - x))
    velocity = np.clip(velocity, -FASTEST_MOVE, FASTEST_MOVE)
    inside = np.clip(x + velocity, 0.0, 1.0)
    return inside, np.where(inside == x + velocity, velocity, 0.0)


def _latin_hypercube(random: np.random.Generator, particles: int, dimensions: int) -> Floats:
    """Spread particles in the unit box such that every row of every axis holds one."""
    rows = np.array([random.permutation(particles) for _ in range(dimensions)]).T
    return np.asarray((rows + random.random((particles, dimensions))) / particles)


def _ring_leaders(costs: Floats, neighbours: int) -> NDArray[np.intp]:
    """Index of the best among each particle and its neighbours on the ring, shape (S,)."""
    index = np.arange(len(costs))
    around = (index[:, None] + np.arange(-neighbours, neighbours + 1)) % len(costs)
    return np.asarray(around[index, np.argmin(costs[around], axis=1)])
