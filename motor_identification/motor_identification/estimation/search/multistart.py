"""Search for the global minimum from many starts: short swarms from several seeds, each handed over to least squares.

A swarm finds the neighbourhood of a minimum where least squares alone would stall (a motor that never starts has no
derivative), least squares finds its bottom in a tenth of what a swarm would need. Swarms begin short, because most
problems need no more, and double in length for as long as the descents from their best particles do not agree. That
independent descents end at the same cost is also the evidence that this local minimum is the global one.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from motor_identification.estimation.least_squares import Box, Tolerance, minimise_squares
from motor_identification.estimation.request import Descent, SearchConfig, SearchReport
from motor_identification.estimation.search.multistart_stop import meets_stopping_rule, select_agreeing
from motor_identification.estimation.search.objective import Objective
from motor_identification.estimation.search.swarm import SwarmConfig, SwarmResult, minimise
from motor_model.errors import MotorError

Floats = NDArray[np.float64]
Progress = Callable[[float], None]  # share of the evaluations that may be spent, 0 to 1

FIRST_PARTICLES = 10  # of the first swarm, for one epoch; both double from swarm to swarm up to what they may be
MOST_DESCENTS = 3  # after each swarm
START_DISTANCE = 0.1  # of the box: particles closer than this in every unknown are one start to descend from
SWARM_STALL, SWARM_TOLERANCE = 25, 1e-3  # a swarm ends after so many epochs without a relative improvement by this
DIFFERENCE_STEP = 1e-6  # of the box: step of forward differences
DESCENT_TOLERANCE = Tolerance(cost=1e-6, unknowns=1e-9, gradient=1e-14, iterations=60)  # of a descent


def search(objective: Objective, config: SearchConfig, progress: Progress | None = None) -> SearchReport:
    """Search the box for the θ of least cost; it depends on the seed, not on the number of threads.

    Raises:
        MotorError: the cost is not a number anywhere.
        ValueError: the box is empty or not finite.
    """
    tell = progress or (lambda share: None)
    log = _Log()
    for number, plan in enumerate(_plan_swarms(config)):
        left = (config.budget - log.evaluations) // plan.particles - 1
        if number and left < 0:
            break
        swarm = minimise(objective.costs, objective.low, objective.high, replace(plan, epochs=min(plan.epochs, left)))
        log.add_swarm(swarm)
        for start in _select_starts(swarm, objective.high - objective.low):
            log.add_descent(_descend(objective, start, number))
            tell(min(log.evaluations / config.budget, 1.0))
            if meets_stopping_rule(log.descents, objective):
                return log.report(objective, number + 1, agreed=True)
            if log.evaluations >= config.budget:
                break
    if not log.descents:
        raise MotorError(
            "no parameters in the search range give a finite simulation: check the recording's voltages and times."
        )
    tell(1.0)  # what is left of the budget is no swarm
    return log.report(objective, number, agreed=False)


def _plan_swarms(config: SearchConfig) -> Iterator[SwarmConfig]:
    """Plan one swarm after the other, each with a seed of its own, twice as long as the one before."""
    particles, epochs, number = min(FIRST_PARTICLES, config.particles), 1, 0
    while True:
        seed = int(np.random.SeedSequence((config.seed, number)).generate_state(1)[0])
        yield SwarmConfig(particles, min(epochs, config.epochs), seed, stall=SWARM_STALL, tolerance=SWARM_TOLERANCE)
        particles, epochs, number = min(2 * particles, config.particles), 2 * epochs, number + 1


def _select_starts(swarm: SwarmResult, span: Floats) -> list[Floats]:
    """Select the best few particles that are not at the same θ."""
    chosen: list[Floats] = []
    for theta in swarm.thetas[np.isfinite(swarm.costs)]:
        if all(np.max(np.abs(theta - other) / span) > START_DISTANCE for other in chosen):
            chosen.append(theta)
        if len(chosen) == MOST_DESCENTS:
            break
    return chosen


def _descend(objective: Objective, start: Floats, swarm: int) -> Descent:
    """Descend with forward differences: half the evaluations of central ones, and a later fit refines anyway."""
    low, high = objective.low, objective.high
    step = DIFFERENCE_STEP * (high - low)
    evaluations = 0
    known: tuple[Floats, Floats] = (np.empty(0), np.empty(0))  # the latest θ and its residuals

    def residuals(theta: Floats) -> Floats:
        nonlocal evaluations, known
        if not np.array_equal(known[0], theta):
            known = (theta.copy(), objective.residuals(theta[None])[0])
            evaluations += 1
        return known[1]

    def jacobian(theta: Floats) -> Floats:
        nonlocal evaluations
        steps = np.where((theta + step > high) & ~objective.periodic, -step, step)
        here = residuals(theta)
        evaluations += len(theta)
        slopes = (objective.residuals(theta + np.diag(steps)) - here) / steps[:, None]
        return np.asarray(np.where(np.isfinite(slopes), slopes, 0.0).T)

    end = minimise_squares(residuals, jacobian, start, Box(low, high, objective.periodic), DESCENT_TOLERANCE)
    return Descent(end.theta, end.cost, evaluations, swarm)


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
            self._note(float(cost), len(swarm.thetas))

    def add_descent(self, descent: Descent) -> None:
        self.descents.append(descent)
        self._note(descent.cost, descent.evaluations)

    def report(self, objective: Objective, swarms: int, agreed: bool) -> SearchReport:
        best: Sequence[Descent] = sorted(self.descents, key=lambda descent: descent.cost)
        return SearchReport(
            theta=best[0].theta,
            cost=best[0].cost,
            evaluations=self.evaluations,
            trace=np.array(self.trace),
            spent=np.array(self.spent),
            descents=tuple(best),
            agreeing=len(select_agreeing(best, objective)),
            swarms=swarms,
            agreed=agreed,
        )
