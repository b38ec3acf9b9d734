"""Decide what chance may have given: a size that is none, an instant at no time, a limit beyond all commands."""

from math import inf, isfinite, isnan

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.estimation.whitened_fit import WhitenedFit
from motor_identification.validation.instants import list_instant_columns, needs_instant
from motor_model.effects import EFFECT_BY_NAME


def is_chance(effect: str, model: Model) -> bool:
    """Decide whether an effect has a size, or an instant, that chance may have given it."""
    return is_chance_size(effect, model) or has_vague_instant(effect, model) or may_never_limit(effect, model)


def has_vague_instant(effect: str, model: Model) -> bool:
    """Decide whether what begins at an instant does so at none that any recording places.

    One in a block that no fit may see is placed no better than that, however much it moves. Measured: 0.19 s of 4.7 for
    a load step of a fifth of the supply, likelier by 1,063.
    """
    if not needs_instant(effect):
        return False
    fit, errors = model.whitened, model.uncertainty.errors
    columns = list_instant_columns(fit.problem, [effect])
    least = [max(thresholds.VAGUE_INSTANT * duration, find_blindness(fit, at)) for at, duration in columns]
    return all(errors[at] > limit for (at, _), limit in zip(columns, least, strict=True))


def find_blindness(fit: WhitenedFit, at: int) -> float:
    """Find for how long [s] nothing tells an instant at a place of θ, near a block that no fit may see; 0 elsewhere."""
    problem = fit.problem
    if problem.kept_out is None:
        return 0.0
    number = int(np.argwhere(problem.unknowns.columns == at)[0, 0])
    data = problem.intervals[number]
    return problem.kept_out.measure_blindness(float(fit.theta[at]), data, problem.sample_period, number)


def is_chance_size(effect: str, model: Model) -> bool:
    """Decide whether an effect has a size that is none as far as its standard error goes.

    A line that repeats with the angle is in doubt more, and most where the fits have seen all that it is judged by;
    what has no size, such as a limit, is there or not.
    """
    specs, fit, line = EFFECT_BY_NAME[effect].parameters, model.whitened, EFFECT_BY_NAME[effect].periodic
    if specs[0].logarithmic or not isfinite(specs[0].off):
        return False
    sure = (thresholds.SURE_LINE if model.held.seen else thresholds.LIKELY_LINE) if line else thresholds.SURE_SIZE
    at = fit.problem.unknowns.names.index(specs[0].name)
    error = model.uncertainty.errors[at]
    # A line's cycles are always determined.
    chance = bool(abs(fit.theta[at] - specs[0].off) < sure * error or (line and isnan(error)))
    return chance and (line or not count_errors_beside_torque(effect, model) > thresholds.SURE_BESIDE_TORQUE)


def may_never_limit(effect: str, model: Model) -> bool:
    """Decide whether a limit, as far as its standard error goes, may lie beyond all that was ever commanded.

    Measured: 1.46 ± 0.04 V of a motor of 1.5 V without one, whose loop ran twice for every row of its log.
    """
    spec = EFFECT_BY_NAME[effect].parameters[0]
    if spec.off != inf:
        return False
    fit = model.whitened
    at = fit.problem.unknowns.names.index(spec.name)
    most = fit.problem.unknowns.extent.voltage
    return bool(fit.theta[at] + thresholds.SURE_SIZE * model.uncertainty.errors[at] > most)


def count_errors_beside_torque(effect: str, model: Model) -> float:
    """Count the standard errors that an effect's size is beyond none, by what knows of the random torque.

    0 where more is left than a torque.
    """
    if model.told_beside_torque is None:
        return 0.0
    (fit, uncertainty), spec = model.told_beside_torque, EFFECT_BY_NAME[effect].parameters[0]
    at = fit.problem.unknowns.names.index(spec.name)
    return float(abs(fit.theta[at] - spec.off) / uncertainty.errors[at])
