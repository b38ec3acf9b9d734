"""Fit one more effect: all parameters again by least squares, from a few start values of the effect's own.

The rest of the model is near its minimum already; the local minima along an effect's own parameters decide how many
start values are needed.
"""

from itertools import product

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import LEAST_GAIN, fit_speeds, improves_fit
from motor_identification.estimation.parameter_space import map_theta
from motor_identification.estimation.problem import Problem
from motor_identification.periodic import periodic_fit
from motor_identification.recording import Floats
from motor_model.effects import EFFECT_BY_NAME, normalised

QUICK_INTERVAL = 0.02  # [s] of the intervals of a quick look from every start,
QUICK_ITERATIONS, QUICK_TOLERANCE = 10, 1e-4  # which shall only tell the starts apart
ITERATIONS, TOLERANCE = 20, 1e-8  # of the fit from the best of them


def fit_with_effect(estimate: Estimate, effect: str, least: float = 0.0) -> Estimate | None:
    """Fit a motor with one more effect, all parameters again, from a fit without it.

    None where a quick look from every start promises nothing, or, of a line in a spectrum, less than `least` of the sum
    of squared standard deviations.
    """
    if EFFECT_BY_NAME[effect].periodic:
        return periodic_fit.add_periodic_effect(estimate, effect, max(least, LEAST_GAIN))
    larger = estimate.problem.with_effects(normalised((*estimate.problem.unknowns.effects, effect)))
    quick, bare = larger.coarsen(QUICK_INTERVAL), estimate.problem.coarsen(QUICK_INTERVAL)
    best, start, spent = np.inf, estimate.theta, estimate.simulations
    for begin in _list_starts(estimate, larger):
        end = fit_speeds(Estimate(quick, begin, spent), iterations=QUICK_ITERATIONS, tolerance=QUICK_TOLERANCE)
        spent, cost = end.simulations, end.cost
        if cost < best:
            best, start = cost, end.theta
    if not improves_fit(estimate.on(bare).cost, best, len(bare.weight)):
        return None
    return fit_speeds(Estimate(larger, start, spent), iterations=ITERATIONS, tolerance=TOLERANCE)


def add_noticeable_effect(estimate: Estimate, effect: str) -> Estimate:
    """Add an effect to a fitted motor, of a size that would matter to its user; not fitted."""
    larger = estimate.problem.with_effects(normalised((*estimate.problem.unknowns.effects, effect)))
    return Estimate(larger, _list_starts(estimate, larger)[0], estimate.simulations)


def _list_starts(estimate: Estimate, larger: Problem) -> list[Floats]:
    old, new = estimate.problem.unknowns, larger.unknowns
    added = [spec for spec in new.specs if spec.name not in old.names]
    starts = []
    for shares in product(*(spec.starts for spec in added)):
        sizes: dict[str, float] = {}
        for spec, share in zip(added, shares, strict=True):
            sizes[spec.name] = share * new.extent.of(spec)
            if spec.at_least is not None:
                least = spec.at_least
                sizes[spec.name] += sizes[least] if least in sizes else float(estimate.theta[old.names.index(least)])
        values = {name: np.array(size) for name, size in sizes.items()}
        starts.append(map_theta(old, estimate.theta, new, values))
    return starts
