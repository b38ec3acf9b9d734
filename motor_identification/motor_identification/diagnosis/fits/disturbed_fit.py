"""Fit beside a random torque: generalised least squares, whitened by the filter of angle, speed and torque errors.

Where a random torque leaves most of what is left, mean speeds of neighbouring intervals err alike for as long as motor
and torque remember: ordinary least squares is right but wasteful there, and a small effect drowns in it. Whitened
residuals (A. C. Aitken, Proc. R. Soc. Edinburgh 55, 1935) see what happens faster than the torque changes.
"""

from dataclasses import dataclass, replace

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_residuals
from motor_identification.estimation.problem import Problem
from motor_identification.estimation.whitened_fit import (
    FilteredResiduals,
    WhitenedFit,
    WhitenedResiduals,
    learn_encoders,
)
from motor_identification.noise.error_data import ErrorData, TorqueWhitening, make_error_data, make_whitening
from motor_identification.noise.error_model import ErrorModel
from motor_identification.noise.run_gain import FEWEST_RUNS
from motor_identification.recording import Floats

ITERATIONS, TOLERANCE = 8, 1e-6  # it begins at the minimum of ordinary least squares

DisturbedResiduals = FilteredResiduals[TorqueWhitening]


@dataclass(frozen=True)
class WhitenedBesideTorque(WhitenedResiduals):
    """Residuals whitened beside a random torque, with the statistics of every recording's encoder."""

    whitenings: tuple[TorqueWhitening, ...]

    @property
    def gains_differ(self) -> bool:
        """Whether each recording has a gain of its own, so that they need not agree."""
        return any(one.along is not None for one in self.whitenings)

    def on(self, problem: Problem) -> "WhitenedBesideTorque":
        """The same whitening of another model's motion in the same recordings."""
        return replace(self, problem=problem)

    def white(self, residuals: Floats) -> Floats:
        """From mean speeds' residuals [rad/s] (I,) to white ones, all recordings one after the other."""
        rows = zip(self.whitenings, self.problem.to_travel(residuals), strict=True)
        return np.concatenate([one.white(increments) for one, increments in rows])


def list_error_data(estimate: Estimate) -> list[ErrorData]:
    """List what an estimate leaves in its training data, recording by recording, for the error filter."""
    intervals = estimate.problem.intervals
    several = len(intervals) >= FEWEST_RUNS
    responses = estimate.supply_responses if several else (None,) * len(intervals)
    rows = zip(intervals, estimate.increments, responses, strict=True)
    return [make_error_data(data, increments, None, response) for data, increments, response in rows]


def make_disturbed_residuals(estimate: Estimate, errors: ErrorModel) -> DisturbedResiduals:
    """Make the residuals of an estimate's problem, whitened beside the random torque of an error model.

    The filter's gains are those of what the estimate leaves: an angle that jumps there has no weight.
    """
    whitenings = tuple(make_whitening(data, errors, estimate.lag) for data in list_error_data(estimate))
    return DisturbedResiduals(estimate.problem, whitenings)


def fit_beside_torque(
    estimate: Estimate, errors: ErrorModel, iterations: int = ITERATIONS, tolerance: float = TOLERANCE
) -> Estimate:
    """Fit an estimate again by generalised least squares beside the random torque of an error model."""
    return fit_residuals(estimate, make_disturbed_residuals(estimate, errors), np.inf, iterations, tolerance)


def whiten_beside_torque(estimate: Estimate, errors: ErrorModel) -> WhitenedFit:
    """Whiten the residuals of a fit beside the random torque of an error model, its unknowns as they are.

    No table of slots is projected out: these errors have a share of independent ones.
    """
    encoders = tuple(replace(encoder, projection=None) for encoder in learn_encoders(estimate))
    whitenings = make_disturbed_residuals(estimate, errors).filters
    return WhitenedFit(estimate, WhitenedBesideTorque(estimate.problem, encoders, whitenings))
