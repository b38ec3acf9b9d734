"""Find effects that a fit was asked for and that are not there: without them it is as good.

A standard error says how sharp the minimum is that was found, not whether it is needed: where an effect is absent, its
parameters end in one of many shallow minima of the noise. So each effect is taken out, all else is fitted again, and
the sum of white squares may not grow by more than chance makes of so many parameters (likelihood ratio test; S. Wilks,
Ann. Math. Stat. 9(1), 1938); a ripple is also the best of many lines (Bonferroni's rule).
"""

from math import log, tau

import numpy as np
from scipy.special import chdtri

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_residuals
from motor_identification.estimation.parameter_space import map_theta
from motor_identification.estimation.whitened_fit import WhitenedFit
from motor_model.effects import EFFECT_BY_NAME, SPEC_BY_NAME

SHOWN_SIGMA = 10.0  # standard deviations of a trace that no recording hides
CHANCE = 1e-3  # of calling an effect there that is not
ITERATIONS, TOLERANCE = 20, 1e-8  # of the fit without it


def find_absent_effects(fit: WhitenedFit) -> tuple[str, ...]:
    """Find the effects of a fit without which its white residuals are as small, all of them together.

    None of those of which only one at a time can go: each of them does for the other.
    """
    effects = fit.problem.unknowns.effects
    alone = [name for name in effects if not any(EFFECT_BY_NAME[other].implies == name for other in effects)]
    spare = tuple(name for name in alone if _is_spare(fit, (name,)) and _would_show(fit, name))
    return spare if len(spare) < 2 or _is_spare(fit, spare) else ()


def _is_spare(fit: WhitenedFit, effects: tuple[str, ...]) -> bool:
    """Whether the sum of white squares hardly grows where these effects are taken out and all else is fitted again."""
    with_them = float(np.sum(fit.residuals.residuals(fit.theta) ** 2))
    unknowns = fit.problem.unknowns
    problem = fit.problem.with_effects(tuple(name for name in unknowns.effects if name not in effects))
    start = Estimate(problem, map_theta(unknowns, fit.theta, problem.unknowns, {}))
    residuals = fit.residuals.on(problem)
    without = fit_residuals(start, residuals, iterations=ITERATIONS, tolerance=TOLERANCE)
    squares = float(np.sum(residuals.residuals(without.theta) ** 2))
    count = len(fit.problem.weight)
    return squares - with_them < _allowance(fit, effects) * max(with_them / count, 1.0)


def _would_show(fit: WhitenedFit, effect: str) -> bool:
    """Whether the effect at a size that matters would leave a trace that the other unknowns cannot imitate."""
    specs = EFFECT_BY_NAME[effect].parameters
    if not all(spec.starts for spec in specs):  # a line in a spectrum is like nothing else
        return True
    unknowns, extent = fit.problem.unknowns, fit.problem.unknowns.extent
    left = fit.problem.with_effects(tuple(name for name in unknowns.effects if name != effect))
    bare = map_theta(unknowns, fit.theta, left.unknowns, {})
    sizes = {spec.name: np.array(spec.starts[-1] * spec.scale.of(extent)) for spec in specs}
    for spec in specs:
        if spec.at_least is not None:
            sizes[spec.name] += fit.theta[unknowns.names.index(spec.at_least)]
    noticed = map_theta(left.unknowns, bare, unknowns, sizes)
    residuals = fit.residuals.on(left)
    trace = fit.residuals.residuals(noticed) - residuals.residuals(bare)
    columns = residuals.jacobian(bare)
    imitation = np.linalg.lstsq(columns, trace, rcond=1e-10)[0]
    return bool(np.linalg.norm(trace - columns @ imitation) > SHOWN_SIGMA)


def _allowance(fit: WhitenedFit, effects: tuple[str, ...]) -> float:
    """By how much the squares grow by chance."""
    lines = 1.0
    if any(spec.of_encoder for name in effects for spec in EFFECT_BY_NAME[name].parameters):
        low, high = SPEC_BY_NAME["ripple_cycles"].box(fit.problem.unknowns.extent)
        turns = max(np.ptp(angle) for angle in fit.estimate.angles) / tau * fit.problem.unknowns.gear
        lines = turns * (high - low)
    count = sum(len(EFFECT_BY_NAME[name].parameters) for name in effects)
    return float(chdtri(count, CHANCE)) + 2.0 * log(max(lines, 1.0))
