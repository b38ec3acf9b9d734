"""Fit beside a random torque: generalised least squares, whitened by the filter of angle, speed and torque errors.

Where a random torque leaves most of what is left, mean speeds of neighbouring intervals err alike for as long as motor
and torque remember: ordinary least squares is right but wasteful there, and a small effect drowns in it. Whitened
residuals (A. C. Aitken, Proc. R. Soc. Edinburgh 55, 1935) see what happens faster than the torque changes.
"""

from dataclasses import dataclass

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_residuals
from motor_identification.estimation.problem import Problem
from motor_identification.noise.error_model import ErrorModel, TorqueWhitening, make_error_data, make_whitening
from motor_identification.recording import Floats

ITERATIONS, TOLERANCE = 8, 1e-6  # it begins at the minimum of ordinary least squares


@dataclass(frozen=True)
class DisturbedResiduals:
    """Residuals of a problem, whitened recording by recording."""

    problem: Problem
    whitenings: tuple[TorqueWhitening, ...]

    def white(self, residuals: Floats) -> Floats:
        """Whiten the residuals [rad/s] of mean speeds, shape (I,), all recordings one after the other."""
        rows = zip(self.whitenings, self.problem.to_travel(residuals), strict=True)
        return np.concatenate([whitening.white(increments) for whitening, increments in rows])

    def residuals(self, theta: Floats) -> Floats:
        """White residuals at θ (D,)."""
        return self.white(self.problem.residuals(theta))

    def jacobian(self, theta: Floats) -> Floats:
        """Their derivative, one column for each unknown."""
        return np.stack([self.white(column) for column in self.problem.jacobian(theta).T], axis=1)


def make_disturbed_residuals(estimate: Estimate, errors: ErrorModel) -> DisturbedResiduals:
    """Make the residuals of an estimate's problem, whitened beside the random torque of an error model.

    The filter's gains are those of what the estimate leaves: an angle that jumps there has no weight.
    """
    values = estimate.parameters.values
    rows = zip(estimate.problem.intervals, estimate.increments, strict=True)
    rate, ka = values["kv"] / values["ka"], values["ka"]
    whitenings = tuple(make_whitening(make_error_data(*row), errors, rate, ka) for row in rows)
    return DisturbedResiduals(estimate.problem, whitenings)


def fit_beside_torque(
    estimate: Estimate, errors: ErrorModel, iterations: int = ITERATIONS, tolerance: float = TOLERANCE
) -> Estimate:
    """Fit an estimate again by generalised least squares beside the random torque of an error model."""
    return fit_residuals(estimate, make_disturbed_residuals(estimate, errors), np.inf, iterations, tolerance)
