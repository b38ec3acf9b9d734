"""What a recording could not have shown: effects of a size that matters whose trace other parameters would imitate."""

import numpy as np

from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.effect_fit import noticeable
from motor_identification.diagnosis.effect_test import lacking, threshold
from motor_identification.noise.likelihood import log_likelihood
from motor_identification.recording import Floats
from motor_model.effects import EFFECT_BY_NAME


def undetectable(model: Model) -> tuple[str, ...]:
    """Effects that a model lacks and that would not have been found in its recordings, had they been there.

    Each is added at a size that matters; what of its trace the model's own parameters cannot imitate, by least squares
    on the training data, is what there would have been to find.
    """
    problem, place = model.problem, model.place
    columns, without = problem.jacobian(place), problem.residuals(place)
    root = np.sqrt(problem.weight)
    weighted = root[:, None] * columns
    hidden = []
    for effect in lacking(model.effects):
        if EFFECT_BY_NAME[effect].periodic:
            continue
        larger, there = noticeable(problem, place, effect)
        trace = larger.residuals(there) - without
        imitation = np.linalg.lstsq(weighted, root * trace, rcond=1e-9)[0]
        left = trace - columns @ imitation
        if _evidence(model, left) < threshold():
            hidden.append(effect)
    return tuple(hidden)


def _evidence(model: Model, left: Floats) -> float:
    """The logarithm of the likelihood ratio that a trace [rad/s] would bring."""
    rows = zip(model.problem.intervals, model.problem.travelled(left), strict=True)
    return sum(
        log_likelihood(data, 0.0 * part, model.noise) - log_likelihood(data, part, model.noise) for data, part in rows
    )
