"""Judge models of several runs whose gains may differ, as those of a battery do: a nuisance of each run."""

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import judge_beside_torque
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import likelihood_threshold
from motor_identification.diagnosis.selection.selection import SelectionStep
from motor_identification.noise.run_gain import FEWEST_RUNS
from motor_identification.validation.held_out import list_held_errors
from motor_identification.validation.hold_out import HoldOut


def gains_may_differ(model: Model) -> bool:
    """Decide whether what a model leaves of several runs is likelier where each has a gain of its own."""
    several = len(model.estimate.problem.recordings) >= FEWEST_RUNS
    return several and model.errors_beside_torque.gain > 0.0


def may_be_of_gains(step: SelectionStep, hold_out: HoldOut) -> bool:
    """Decide whether a step that was found has no evidence left where each run has a gain of its own."""
    if not gains_may_differ(step.before):
        return False
    before, after = (
        judge_beside_torque(model, hold_out, None, thresholds.CANDIDATE_EVALUATIONS)
        for model in (step.before, step.found.model)
    )
    return after.likelihood - before.likelihood <= likelihood_threshold()


def find_gap_less_gains(model: Model) -> float:
    """Find the gap [rad/s] without what the gain of each run adds, which no other run tells."""
    held = model.held
    if model.errors.gain == 0.0:
        return held.gap
    left = [row.increments / row.duration for row in model.less_gains(list_held_errors(held))]
    return float(np.sqrt(held.weight @ np.concatenate(left)[held.counted] ** 2))
