"""Make the objective of a global search: residuals over a box, and how low their cost can be expected to lie."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_identification.estimation.problem import Problem

Floats = NDArray[np.float64]

USUAL_IRREGULARITY = 0.015  # of a slot: what real discs have (around 1 %), and half as much again
NEGLIGIBLE = 1e-12  # of the mean square speed: a cost as good as 0


@dataclass(frozen=True)
class Objective:
    """The function to minimise: the sum of squared residuals over a box.

    `costs` and `residuals` take θ (S, D), which they may share among cores.
    """

    low: Floats  # (D,)
    high: Floats  # (D,)
    periodic: NDArray[np.bool_]  # (D,) which unknowns have no walls: low and high end are the same value
    costs: Callable[[Floats], Floats]  # → (S,)
    residuals: Callable[[Floats], Floats]  # → (S, I)
    noise_cost: float = 0.0  # a cost that noise alone explains
    negligible: float = 0.0  # a cost as good as 0


def make_objective(problem: Problem) -> Objective:
    """Make the objective of a fitting problem: its output error."""
    root = np.sqrt(problem.weight)
    noise = [data.floor_squared(USUAL_IRREGULARITY * data.slot) for data in problem.intervals]
    low, high = problem.unknowns.low, problem.unknowns.high
    return Objective(
        low,
        high,
        np.zeros(len(low), dtype=bool),  # phases are not searched here, see `periodic/`
        problem.costs,
        lambda thetas: np.asarray(problem.evaluate(thetas) * root),
        noise_cost=float(problem.weight @ np.concatenate(noise)),
        negligible=NEGLIGIBLE * float(problem.weight @ problem.speed**2),
    )
