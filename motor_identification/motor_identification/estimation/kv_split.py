"""Split kv into back-EMF and viscous friction, where an effect tells the two apart.

kv is both: what turns with the shaft and takes a voltage. A supply that sags, and a winding that heats up, change what
a torque takes and not the back-EMF: with all of kv as back-EMF the rest of a motor with viscous friction is taken for
other effects.
"""

from collections.abc import Callable

import numpy as np
from scipy.special import chdtri

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import Residuals, fit_residuals
from motor_identification.estimation.parameter_space import map_theta
from motor_identification.estimation.problem import Problem
from motor_identification.estimation.whitened_fit import WhitenedFit, fit_whitened
from motor_identification.recording import Floats
from motor_model.effects import VISCOUS_SHARE, do_split_kv

ITERATIONS, TOLERANCE = 20, 1e-8
NEAR_END = 0.98  # of the largest share
CHANCE = 1e-3  # of splitting where there is no viscous friction


def can_split_kv(problem: Problem) -> bool:
    """Decide whether kv may be split in a problem: some effect tells its parts apart, and it is not split yet."""
    return do_split_kv(problem.unknowns.effects) and not problem.unknowns.splits_kv


def fit_split_kv(estimate: Estimate, make_target: Callable[[Problem], Residuals]) -> Estimate:
    """Fit an estimate again, and the share of kv that is viscous friction beside it; from the best of its starts.

    make_target: makes what is minimised, of the problem with that unknown more.
    """
    old = estimate.problem.unknowns
    larger = estimate.problem.with_effects(old.effects, split=True)
    target, best, least, spent = make_target(larger), estimate.theta, np.inf, estimate.simulations
    for share in VISCOUS_SHARE.starts:
        theta = map_theta(old, estimate.theta, larger.unknowns, {VISCOUS_SHARE.name: np.array(share)})
        end = fit_residuals(Estimate(larger, theta, spent), target, np.inf, ITERATIONS, TOLERANCE)
        cost, spent = _sum_squares(target, end.theta), end.simulations
        if cost < least:
            best, least = end.theta, cost
    return Estimate(larger, best, spent)


def is_split_of_motor(split: Estimate) -> bool:
    """Decide whether the viscous share ended within what is searched; at its end it stands in for something else.

    A supply that ran down was taken for a warming-up of a motor with nothing but viscous friction.
    """
    share = split.theta[split.problem.unknowns.names.index(VISCOUS_SHARE.name)]
    return bool(share < NEAR_END * VISCOUS_SHARE.high)


def split_kv_if_needed(fit: WhitenedFit) -> WhitenedFit:
    """Split kv of a fit where its white squares fall by more than chance makes of one parameter more."""
    if not can_split_kv(fit.problem):
        return fit
    split = fit_split_kv(fit.estimate, fit.residuals.on)
    before, after = _sum_squares(fit.residuals, fit.theta), _sum_squares(fit.residuals.on(split.problem), split.theta)
    noise = max(after / len(fit.problem.weight), 1.0)
    better = before - after > float(chdtri(1, CHANCE)) * noise and is_split_of_motor(split)
    return fit_whitened(split) if better else fit


def _sum_squares(target: Residuals, theta: Floats) -> float:
    return float(np.sum(target.residuals(theta) ** 2))
