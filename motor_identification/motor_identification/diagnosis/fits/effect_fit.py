"""Fit one more effect: all parameters again by least squares, from a few start values of the effect's own.

The rest of the model is near its minimum already; the local minima along an effect's own parameters decide how many
start values are needed.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from motor_identification.diagnosis.fits.disturbed_fit import (
    DisturbedResiduals,
    fit_beside_torque,
    make_disturbed_residuals,
)
from motor_identification.diagnosis.fits.score_scan import Promise
from motor_identification.diagnosis.fits.starts import list_starts, start_with
from motor_identification.diagnosis.fits.torque_jumps import list_likely_jumps
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import LEAST_GAIN, SpeedResiduals, fit_residuals, improves_fit
from motor_identification.estimation.parameter_space import map_theta
from motor_identification.estimation.problem import Problem
from motor_identification.noise.error_model import ErrorModel
from motor_identification.periodic import periodic_fit
from motor_identification.recording import Floats
from motor_identification.validation.instants import list_instant_columns, needs_instant, try_instants
from motor_model.effects import EFFECT_BY_NAME

QUICK_SAMPLES = 4.0  # of the intervals of a quick look from every start,
QUICK_ITERATIONS, QUICK_TOLERANCE = 10, 1e-4  # which shall only tell the starts apart
ITERATIONS, TOLERANCE = 20, 1e-8  # of the fit from the best of them
JUMPS_TRIED = 3  # of the steps that a random torque tells of
INSTANTS_TRIED = 60  # of a recording: every half second of the rich profile
DISTURBED_ITERATIONS, DISTURBED_TOLERANCE = 8, 1e-5  # beside a random torque, which leaves more


def fit_with_effect(
    estimate: Estimate, effect: str, least: float = 0.0, errors: ErrorModel | None = None
) -> Estimate | None:
    """Fit a motor with one more effect, all parameters again, from a fit without it.

    errors: of what the fit without it leaves, to fit beside a random torque; None to compare mean speeds as they are.
    None where a quick look from every start promises nothing, or, of a line in a spectrum, less than `least` of the sum
    of squared standard deviations.
    """
    if EFFECT_BY_NAME[effect].periodic:
        periodic = periodic_fit.add_periodic_effect(estimate, effect, max(least, LEAST_GAIN), freely=errors is None)
        return periodic if errors is None or periodic is None else fit_beside_torque(periodic, errors)
    larger = estimate.problem.adding(effect)
    quick, bare = larger.coarsen(QUICK_SAMPLES), estimate.problem.coarsen(QUICK_SAMPLES)
    look = make_target(estimate.on(bare), errors)
    best, start, spent = np.inf, estimate.theta, estimate.simulations
    starts = [one.theta for one in list_starts(estimate, larger)]
    for begin in (*starts, *_list_jumps(estimate, larger, effect, errors)):
        target = replace(look, problem=quick)
        end = fit_residuals(Estimate(quick, begin, spent), target, np.inf, QUICK_ITERATIONS, QUICK_TOLERANCE)
        spent, cost = end.simulations, _sum_squares(target, end.theta)
        if cost < best:
            best, start = cost, end.theta
    start, best = _improve_instants(replace(look, problem=quick), effect, start, best)
    if not promises_gain(_sum_squares(look, estimate.theta), best, len(bare.weight), errors is not None):
        return None
    target = replace(make_target(estimate, errors), problem=larger)
    how = (ITERATIONS, TOLERANCE) if errors is None else (DISTURBED_ITERATIONS, DISTURBED_TOLERANCE)
    return fit_residuals(Estimate(larger, start, spent), target, np.inf, *how)


def fit_promised(estimate: Estimate, promise: Promise, errors: ErrorModel) -> Estimate:
    """Fit a motor beside a random torque with the effects of a promise more, from the sizes that it has."""
    larger = estimate.problem.adding(*promise.effects)
    sizes = {name: size for one in promise.sizes for name, size in one.items()}
    begin = Estimate(larger, start_with(estimate, larger, sizes), estimate.simulations)
    target = replace(make_disturbed_residuals(estimate, errors), problem=larger)
    return fit_residuals(begin, target, np.inf, ITERATIONS, TOLERANCE)


def _list_jumps(estimate: Estimate, larger: Problem, effect: str, errors: ErrorModel | None) -> list[Floats]:
    """List starts of a load that begins at an instant, where the motor tells of it beside a random torque."""
    if errors is None or not needs_instant(effect):
        return []
    size, instant = (spec.name for spec in EFFECT_BY_NAME[effect].parameters)
    old, new = estimate.problem.unknowns, larger.unknowns
    return [
        map_theta(old, estimate.theta, new, {size: np.array(volts), instant: np.array(times)})
        for volts, times in list_likely_jumps(estimate, errors, JUMPS_TRIED)
    ]


def drop_effect(estimate: Estimate, effect: str) -> Estimate:
    """Leave one effect out, and what there is only with it, the rest as it is."""
    unknowns = estimate.problem.unknowns
    left = tuple(name for name in unknowns.effects if name != effect and EFFECT_BY_NAME[name].implies != effect)
    smaller = estimate.problem.with_effects(left)
    return Estimate(smaller, map_theta(unknowns, estimate.theta, smaller.unknowns, {}), estimate.simulations)


def place_instants(estimate: Estimate, errors: ErrorModel) -> Estimate:
    """Fit what begins at an instant anew beside a random torque, for its instant may be elsewhere there."""
    target = make_disturbed_residuals(estimate, errors)
    for effect in filter(needs_instant, estimate.problem.unknowns.effects):
        again = fit_with_effect(drop_effect(estimate, effect), effect, errors=errors)
        if again is not None and _sum_squares(target, again.theta) < _sum_squares(target, estimate.theta):
            estimate = again
    return estimate


def _improve_instants(
    target: SpeedResiduals | DisturbedResiduals, effect: str, theta: Floats, least: float
) -> tuple[Floats, float]:
    """Put the instants of an effect, such as a load step, at the best of many times, the rest of θ (D,) as it is.

    Between two starts there may be a minimum of its own, wherever the motor hardly moves in between. With the least sum
    of squares.
    """
    for column, duration in list_instant_columns(target.problem, [effect]):
        trial, cost = try_instants(partial(_sum_squares, target), theta, column, duration, INSTANTS_TRIED)
        if cost < least:
            theta, least = trial, cost
    return theta, least


def make_target(estimate: Estimate, errors: ErrorModel | None) -> SpeedResiduals | DisturbedResiduals:
    """Make what is minimised: mean speeds as they are, or whitened beside a random torque."""
    return SpeedResiduals(estimate.problem) if errors is None else make_disturbed_residuals(estimate, errors)


def _sum_squares(target: SpeedResiduals | DisturbedResiduals, theta: Floats) -> float:
    return float(np.sum(target.residuals(theta) ** 2))


def promises_gain(before: float, after: float, count: int, white: bool) -> bool:
    """Decide whether a sum of squares fell by more than chance; white residuals have a standard deviation of 1."""
    return before - after >= LEAST_GAIN if white else improves_fit(before, after, count)


def add_noticeable_effect(estimate: Estimate, effect: str) -> Estimate:
    """Add an effect to a fitted motor, of a size that would matter to its user; not fitted."""
    larger = estimate.problem.adding(effect)
    return Estimate(larger, list_starts(estimate, larger)[0].theta, estimate.simulations)
