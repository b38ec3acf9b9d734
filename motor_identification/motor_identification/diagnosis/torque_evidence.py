"""Judge a model beside a random torque: how likely is all motion under what model, torque and sensor leave?

Training motion counts with its maximum, less half the logarithm of its intervals for every unknown (G. Schwarz, Ann.
Stat. 6, 1978), held-out motion as it comes: together that is the logarithm of a Bayes factor, in which a small effect
has all recordings speak for it. A random torque drowns in a few held-out seconds what half a minute shows.

Every model is scored on one common set of intervals, whole blocks of held-out motion: a density with wide tails takes
what an uncounted edge does, so that nothing has to be left out, and no model chooses what it is judged by.
"""

from dataclasses import replace
from math import log

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.noise.error_model import ErrorData, ErrorModel, log_likelihood, make_error_data
from motor_identification.validation.held_out import UNFORESEEN_DRIFTS, mix_likelihoods
from motor_identification.validation.hold_out import HoldOut

UNFORESEEN_TORQUES = (1.5, 3.0)  # times the training data's: held-out motion may be rougher


def score_training(estimate: Estimate, errors: ErrorModel) -> float:
    """Compute the log likelihood of training motion under an estimate and the errors that it leaves, less its price."""
    values = estimate.parameters.values
    rows = zip(estimate.problem.intervals, estimate.increments, strict=True)
    data = [make_error_data(*row) for row in rows]
    count = sum(len(row.fresh) for row in data)
    best = log_likelihood(data, errors, values["kv"] / values["ka"], values["ka"])
    return best - 0.5 * log(count) * len(estimate.theta)


def score_held_out(hold_out: HoldOut, estimate: Estimate, errors: ErrorModel) -> float:
    """Compute the log likelihood of held-out motion under an estimate and the errors that it leaves.

    Under the training data's torque, or one of a few larger ones, or an angle that drifts: one restart that nobody
    could predict must not refute a model.
    """
    values = estimate.parameters.values
    here = hold_out.apply(estimate)
    rows: list[ErrorData] = []
    for data, increments in zip(here.problem.intervals, here.increments, strict=True):
        rows.append(make_error_data(data, increments, hold_out.scored_blocks.mark(data)))
    unit = max(row.unit for row in rows)
    others = [replace(errors, white=share * unit**2) for share in UNFORESEEN_DRIFTS]
    if errors.rms_voltage > 0.0:
        others += [replace(errors, rms_voltage=factor * errors.rms_voltage) for factor in UNFORESEEN_TORQUES]

    def under(model: ErrorModel) -> float:
        return log_likelihood(rows, model, values["kv"] / values["ka"], values["ka"])

    return mix_likelihoods(under(errors), [under(model) for model in others])


def count_scored(hold_out: HoldOut) -> int:
    """Count the intervals of the common set."""
    return int(sum(np.count_nonzero(hold_out.scored_blocks.mark(data)) for data in hold_out.problem.intervals))
