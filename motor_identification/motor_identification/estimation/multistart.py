"""Global search: short swarms from several seeds, each handed over to least squares, until independent ones agree.

A swarm finds the valley where least squares alone would stall (a motor that never starts has no derivative), least
squares finds its bottom in a tenth of what a swarm would need. Swarms begin short, because most problems need no more,
and double in length for as long as the descents from their best places do not agree. That independent descents end at
the same cost is also the evidence that it is the least one.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from motor_identification.estimation.multistart_stop import Descent, agreed, alike
from motor_identification.estimation.objective import Landscape
from motor_identification.estimation.swarm import SwarmConfig, SwarmResult, minimise
from motor_model.errors import MotorError

Floats = NDArray[np.float64]
Progress = Callable[[float], None]  # share of the evaluations that may be spent, 0 to 1

FIRST = 10  # particles of the first swarm, for one epoch; both double from swarm to swarm up to what they may be
FEW = 3  # descents after each swarm at most
APART = 0.1  # of the box: places closer than this in every unknown are one place to descend from
ENOUGH, PATIENCE = 1e-3, 25  # a swarm ends after so many epochs without a relative improvement by this
STEP = 1e-6  # of the box: forward differences
ITERATIONS = 60  # of a descent at most


@dataclass(frozen=True)
class SearchConfig:
    """Upper limits: `particles` and `epochs` of every swarm, and their product for all evaluations."""

    particles: int = 50
    epochs: int = 200
    seed: int = 0

    @property
    def budget(self) -> int:
        """Evaluations after which nothing more is begun."""
        return self.particles * (self.epochs + 1)


@dataclass(frozen=True)
class Found:
    """The best place, what it took, and how far it is to be trusted."""

    place: Floats  # (D,)
    cost: float
    evaluations: int  # simulations of one motor, those for derivatives included
    trace: Floats  # best cost after each epoch of a swarm and each descent
    spent: NDArray[np.int64]  # evaluations until then
    descents: tuple[Descent, ...]  # best first
    agreeing: int  # how many of them ended at the best cost
    swarms: int
    agreed: bool  # whether that was the reason to stop; else the evaluations were used up
    spread: Floats  # (D,) of the agreeing descents' places, as a share of the box: large where the data leave it open


def search(landscape: Landscape, config: SearchConfig, progress: Progress | None = None) -> Found:
    """The place of least cost in the box; it depends on the seed, not on the number of threads.

    Raises:
        MotorError: the cost is not a number anywhere.
        ValueError: the box is empty or not finite, or there are fewer than two particles.
    """
    tell = progress or (lambda share: None)
    log = _Log()
    for number, plan in enumerate(_plans(config)):
        left = (config.budget - log.evaluations) // plan.particles - 1
        if number and left < 0:
            break
        swarm = minimise(landscape.costs, landscape.low, landscape.high, replace(plan, epochs=min(plan.epochs, left)))
        log.add_swarm(swarm)
        for start in _distinct(swarm, landscape.high - landscape.low):
            log.add_descent(_descend(landscape, start, number))
            tell(min(log.evaluations / config.budget, 1.0))
            if agreed(log.descents, landscape):
                return log.found(landscape, number + 1, agreed=True)
            if log.evaluations >= config.budget:
                break
    if not log.descents:
        raise MotorError(
            "no parameters in the search range give a finite simulation: check the recording's voltages and times."
        )
    return log.found(landscape, number, agreed=False)


def _plans(config: SearchConfig) -> Iterator[SwarmConfig]:
    """One swarm after the other, each with a seed of its own, twice as long as the one before."""
    particles, epochs, number = min(FIRST, config.particles), 1, 0
    while True:
        seed = int(np.random.SeedSequence((config.seed, number)).generate_state(1)[0])
        yield SwarmConfig(particles, min(epochs, config.epochs), seed, stall=PATIENCE, tolerance=ENOUGH)
        particles, epochs, number = min(2 * particles, config.particles), 2 * epochs, number + 1


def _distinct(swarm: SwarmResult, span: Floats) -> list[Floats]:
    """The best few places that are not the same."""
    chosen: list[Floats] = []
    for place in swarm.places[np.isfinite(swarm.costs)]:
        if all(np.max(np.abs(place - other) / span) > APART for other in chosen):
            chosen.append(place)
        if len(chosen) == FEW:
            break
    return chosen


def _descend(landscape: Landscape, start: Floats, swarm: int) -> Descent:
    """Least squares with forward differences: half the evaluations of central ones, and a later fit refines anyway."""
    low, high = landscape.low, landscape.high
    step, margin = STEP * (high - low), 1e-9 * (high - low)
    evaluations = 0
    known: tuple[Floats, Floats] = (np.empty(0), np.empty(0))  # the latest place and its residuals

    def residuals(place: Floats) -> Floats:
        nonlocal evaluations, known
        if not np.array_equal(known[0], place):
            known = (place.copy(), landscape.residuals(place[None])[0])
            evaluations += 1
        return known[1]

    def jacobian(place: Floats) -> Floats:
        nonlocal evaluations
        steps = np.where((place + step > high) & ~landscape.turns, -step, step)
        here = residuals(place)
        evaluations += len(place)
        slopes = (landscape.residuals(place + np.diag(steps)) - here) / steps[:, None]
        return np.asarray(np.where(np.isfinite(slopes), slopes, 0.0).T)

    end = least_squares(
        residuals, np.clip(start, low + margin, high - margin), jacobian, x_scale=high - low,
        bounds=(np.where(landscape.turns, -np.inf, low), np.where(landscape.turns, np.inf, high)),
        ftol=1e-6, xtol=1e-9, gtol=1e-14, max_nfev=ITERATIONS,
    )  # fmt: skip
    place = np.where(landscape.turns, low + (end.x - low) % (high - low), end.x)
    return Descent(place, float(2.0 * end.cost), evaluations, swarm)


@dataclass
class _Log:
    """What a search has seen so far."""

    evaluations: int = 0
    best: float = np.inf
    trace: list[float] = field(default_factory=list)
    spent: list[int] = field(default_factory=list)
    descents: list[Descent] = field(default_factory=list)

    def _note(self, cost: float, evaluations: int) -> None:
        self.evaluations += evaluations
        self.best = min(self.best, cost)
        self.trace.append(self.best)
        self.spent.append(self.evaluations)

    def add_swarm(self, swarm: SwarmResult) -> None:
        for cost in swarm.trace:
            self._note(float(cost), len(swarm.places))

    def add_descent(self, descent: Descent) -> None:
        self.descents.append(descent)
        self._note(descent.cost, descent.evaluations)

    def found(self, landscape: Landscape, swarms: int, agreed: bool) -> Found:
        best = sorted(self.descents, key=lambda descent: descent.cost)
        best_ones = alike(best, landscape)
        places = np.array([descent.place for descent in best_ones])
        return Found(
            place=best[0].place,
            cost=best[0].cost,
            evaluations=self.evaluations,
            trace=np.array(self.trace),
            spent=np.array(self.spent),
            descents=tuple(best),
            agreeing=len(best_ones),
            swarms=swarms,
            agreed=agreed,
            spread=np.ptp(places, axis=0) / (landscape.high - landscape.low),
        )
