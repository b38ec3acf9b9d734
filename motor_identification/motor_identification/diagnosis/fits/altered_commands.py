"""Fit a motor to commands that something outside the table altered before they reached it, and judge it as a model is.

A bridge that slews and a supply that runs down are judged so, against the effects that stand in for them.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import exp

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.fits.disturbed_fit import fit_beside_torque, list_error_data
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.noise.gain_learning import score_under_own_errors
from motor_identification.recording import Recording


def fit_altered(estimate: Estimate, current: Model, recordings: Sequence[Recording]) -> Estimate:
    """Fit an estimate again to its recordings with other commands, as a model was fitted."""
    begin = estimate.on(replace(estimate.problem, recordings=tuple(recordings)))
    return fit_speeds(begin) if current.learned is None else fit_beside_torque(begin, current.learned)


def score_alone(estimate: Estimate, current: Model) -> float:
    """Compute the log likelihood of what is left, under errors that are learned of it; a model's to begin with."""
    rows = list_error_data(estimate)
    return score_under_own_errors(rows, estimate.lag, current.errors, thresholds.CANDIDATE_EVALUATIONS)


def measure_share(altered: Estimate, without: Model, gain: float) -> float:
    """Measure which share it takes of what a model leaves, likelier by a gain; of the white rest if that is more.

    The sensor may hide it.
    """
    count = sum(len(data.first) for data in altered.problem.intervals)
    return max(1.0 - altered.cost / without.estimate.cost, 1.0 - exp(-2.0 * gain / count))
