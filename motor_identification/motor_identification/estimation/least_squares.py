"""Descend to a local minimum by least squares within a box, whatever the residuals are.

One solver serves all of them (SciPy's trust region reflective algorithm): the output error of a fit, its whitened
residuals, the descents of a global search, the nuisance parameters of held-out recordings.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.optimize import least_squares

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import Problem
from motor_identification.recording import Bools, Floats

LEAST_GAIN = 4.0  # squared standard deviations: chance alone gains 1 by a parameter more, and 4 in one case of 20
INNER_MARGIN = 1e-9  # of the box: the solver takes no start on a wall
ROBUST_SIGMA = 1.4826  # standard deviation of a normal distribution over the median of its absolute values


class Residuals(Protocol):
    """Something least squares can minimise."""

    def residuals(self, theta: Floats) -> Floats:
        """(D,) → any number of residuals."""

    def jacobian(self, theta: Floats) -> Floats:
        """Their derivative, one column for each unknown."""


@dataclass(frozen=True)
class Box:
    """Where the unknowns may lie, shape (D,) each; `periodic` ones have no walls, their ends are the same value."""

    low: Floats
    high: Floats
    periodic: Bools | None = None


@dataclass(frozen=True)
class Tolerance:
    """When the solver stops: relative changes of cost and unknowns, scaled gradient, and iterations at most."""

    cost: float = 1e-8
    unknowns: float = 1e-8
    gradient: float = 1e-8
    iterations: int = 60


@dataclass(frozen=True)
class LocalMinimum:
    """Where a descent ended, the sum of squares there, and how often it asked for residuals and derivatives."""

    theta: Floats  # (D,)
    cost: float
    residual_calls: int
    jacobian_calls: int


def minimise_squares(
    residuals: Callable[[Floats], Floats],
    jacobian: Callable[[Floats], Floats] | None,
    start: Floats,
    box: Box,
    tolerance: Tolerance,
    step: float | None = None,
    robust_scale: float = np.inf,
) -> LocalMinimum:
    """Minimise a sum of squares within a box from a start (D,), by trust region reflective least squares.

    Without a `jacobian` it is had by forward differences of relative size `step`. Residuals far above `robust_scale`
    count by their size, not by its square (soft L1 loss): a few false ones do not pull.
    """
    span = box.high - box.low
    free = np.zeros(len(span), dtype=bool) if box.periodic is None else box.periodic
    robust = bool(np.isfinite(robust_scale))
    end = least_squares(
        residuals,
        np.clip(start, box.low + INNER_MARGIN * span, box.high - INNER_MARGIN * span),
        jac="2-point" if jacobian is None else jacobian,
        diff_step=step,
        bounds=(np.where(free, -np.inf, box.low), np.where(free, np.inf, box.high)),
        x_scale=span,
        ftol=tolerance.cost,
        xtol=tolerance.unknowns,
        gtol=tolerance.gradient,
        max_nfev=tolerance.iterations,
        loss="soft_l1" if robust else "linear",
        f_scale=robust_scale if robust else 1.0,
    )
    theta = np.where(free, box.low + (end.x - box.low) % span, end.x)
    return LocalMinimum(theta, float(2.0 * end.cost), int(end.nfev), int(end.njev or 0))


@dataclass(frozen=True)
class SpeedResiduals:
    """The output error as residuals: mean speeds weighted by the root of their share of the time."""

    problem: Problem

    def residuals(self, theta: Floats) -> Floats:
        """Weighted residuals at θ (D,), shape (I,)."""
        return np.asarray(np.sqrt(self.problem.weight) * self.problem.residuals(theta))

    def jacobian(self, theta: Floats) -> Floats:
        """Their derivative, shape (I, D)."""
        return np.asarray(np.sqrt(self.problem.weight)[:, None] * self.problem.jacobian(theta))


def fit_speeds(
    start: Estimate, robust_scale: float = np.inf, iterations: int = 60, tolerance: float = 1e-12
) -> Estimate:
    """Minimise the output error in mean speeds from an estimate; see `fit_residuals`."""
    return fit_residuals(start, SpeedResiduals(start.problem), robust_scale, iterations, tolerance)


def fit_residuals(
    start: Estimate,
    target: Residuals,
    robust_scale: float = np.inf,
    iterations: int = 60,
    tolerance: float = 1e-12,
) -> Estimate:
    """Minimise the squares of `target` from an estimate, which is kept if they are not improved, or no numbers."""
    theta, unknowns = start.theta, start.problem.unknowns
    before = float(np.sum(target.residuals(theta) ** 2))
    if not np.isfinite(before):
        return start
    minimum = minimise_squares(
        target.residuals,
        target.jacobian,
        theta,
        Box(unknowns.low, unknowns.high),
        Tolerance(tolerance, tolerance, 0.01 * tolerance, iterations),
        robust_scale=robust_scale,
    )
    better = np.isfinite(robust_scale) or minimum.cost <= before
    simulations = minimum.residual_calls + 2 * len(theta) * minimum.jacobian_calls + 1
    return Estimate(start.problem, minimum.theta if better else theta, start.simulations + simulations)


def improves_fit(before: float, after: float, count: int) -> bool:
    """Decide whether a cost fell by more than LEAST_GAIN squared standard deviations of so many residuals."""
    return (before - after) * count >= LEAST_GAIN * after


@dataclass(frozen=True)
class Scatter:
    """How far weighted speed residuals scatter: root mean square, and the standard deviation of the middle half."""

    rms: float
    robust: float


def measure_scatter(estimate: Estimate) -> Scatter:
    """Measure the scatter of the weighted speed residuals of an estimate, but for those of exactly 0.

    While model and motor both stand, the residuals are exactly 0; more than half of them would make the middle half's
    standard deviation 0, too.
    """
    every = SpeedResiduals(estimate.problem).residuals(estimate.theta)
    residuals = every[every != 0.0]
    if len(residuals) == 0:
        return Scatter(0.0, 0.0)
    return Scatter(float(np.sqrt(np.mean(residuals**2))), ROBUST_SIGMA * float(np.median(np.abs(residuals))))
