"""What a global search looks at: a box, residuals over it, and how low the cost can be expected to lie."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_identification.estimation.problem import Problem

Floats = NDArray[np.float64]

IRREGULAR = 0.015  # of a slot: how far a disc may be off without the model being wrong
NOTHING = 1e-12  # of the mean square speed: a cost as good as 0


@dataclass(frozen=True)
class Landscape:
    """What is searched: residuals over a box, the sum of whose squares is the cost.

    `costs` and `residuals` take places (S, D), which they may share among cores.
    """

    low: Floats  # (D,)
    high: Floats  # (D,)
    turns: NDArray[np.bool_]  # (D,) which unknowns have no walls, because the low and the high end are the same place
    costs: Callable[[Floats], Floats]  # → (S,)
    residuals: Callable[[Floats], Floats]  # → (S, I)
    explained: float = 0.0  # a cost that noise alone explains
    nothing: float = 0.0  # a cost as good as 0


def landscape_of(problem: Problem) -> Landscape:
    """A fitting problem as what a search looks at."""
    root = np.sqrt(problem.weight)
    noise = [data.floor_squared(IRREGULAR * data.slot) for data in problem.intervals]
    low, high = problem.unknowns.low, problem.unknowns.high
    return Landscape(
        low,
        high,
        np.zeros(len(low), dtype=bool),  # phases are not searched here, see `periodic.py`
        problem.costs,
        lambda places: np.asarray(problem.evaluate(places) * root),
        explained=float(problem.weight @ np.concatenate(noise)),
        nothing=NOTHING * float(problem.weight @ problem.speed**2),
    )
