"""Least squares from a place in the box: the end of a search that a swarm began."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.optimize import least_squares

from motor_identification.estimation.problem import Problem
from motor_identification.recording import Floats

LEAST_GAIN = 4.0  # of a sum of squared standard deviations, for a closer look


class Residuals(Protocol):
    """Something least squares can minimise."""

    def residuals(self, place: Floats) -> Floats:
        """(D,) → any number of residuals."""

    def jacobian(self, place: Floats) -> Floats:
        """Their derivative, one column for each unknown."""


@dataclass(frozen=True)
class Speeds:
    """The swarm's cost as residuals: mean speeds weighted by the root of their share of the time."""

    problem: Problem

    def residuals(self, place: Floats) -> Floats:
        """Weighted residuals at a place (D,), shape (I,)."""
        return np.asarray(np.sqrt(self.problem.weight) * self.problem.residuals(place))

    def jacobian(self, place: Floats) -> Floats:
        """Their derivative, shape (I, D)."""
        return np.asarray(np.sqrt(self.problem.weight)[:, None] * self.problem.jacobian(place))


def descend(
    problem: Problem,
    target: Residuals,
    place: Floats,
    most: float = np.inf,
    iterations: int = 60,
    tolerance: float = 1e-12,
) -> tuple[Floats, int]:
    """Least squares (trust region reflective) from a place, kept if it is not improved; and the simulations.

    Residuals far above `most` count by their size, not by its square (SciPy's soft_l1): a few false ones do not pull.
    """
    low, high = problem.unknowns.low, problem.unknowns.high
    margin = 1e-9 * (high - low)
    robust = bool(np.isfinite(most))
    solution = least_squares(
        target.residuals,
        np.clip(place, low + margin, high - margin),
        jac=target.jacobian,
        bounds=(low, high),
        x_scale=high - low,
        ftol=tolerance,
        xtol=tolerance,
        gtol=0.01 * tolerance,
        max_nfev=iterations,
        loss="soft_l1" if robust else "linear",
        f_scale=most if robust else 1.0,
    )
    evaluations = int(solution.nfev + 2 * len(place) * (solution.njev or 0)) + 1
    better = robust or 2.0 * solution.cost <= float(np.sum(target.residuals(place) ** 2))
    return np.asarray(solution.x if better else place), evaluations


def gains(before: float, after: float, count: int) -> bool:
    """Whether a cost fell by more than LEAST_GAIN squared standard deviations of so many residuals."""
    return (before - after) * count >= LEAST_GAIN * after


def typical(problem: Problem, place: Floats) -> tuple[float, float]:
    """The scatter of the weighted mean speeds at a place: their root mean square, and by the middle half alone."""
    residuals = Speeds(problem).residuals(place)
    return float(np.sqrt(np.mean(residuals**2))), 1.4826 * float(np.median(np.abs(residuals)))
