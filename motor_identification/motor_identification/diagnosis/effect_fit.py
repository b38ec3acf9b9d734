"""An effect joins a fitted model: all parameters again by least squares, from a few values of its own.

The rest of the model is near its place already; what an effect's own valley looks like decides how many are needed.
"""

from itertools import product

import numpy as np

from motor_identification.estimation.least_squares import LEAST_GAIN, Speeds, descend, gains
from motor_identification.estimation.parameter_space import carried
from motor_identification.estimation.problem import Problem
from motor_identification.periodic import periodic_fit
from motor_identification.recording import Floats
from motor_model.effects import EFFECT_BY_NAME, normalised

QUICK = 0.02  # [s] intervals of the quick look
LOOK = 10  # iterations of it


def extended(problem: Problem, place: Floats, effect: str, least: float = 0.0) -> tuple[Problem, Floats, int] | None:
    """The best fit with one more effect, from a fit (D,) without it: problem, place, simulations.

    None where a quick look from every start promises nothing, or, of a line in a spectrum, less than `least` of the sum
    of squared standard deviations.
    """
    if EFFECT_BY_NAME[effect].periodic:
        return periodic_fit.added(problem, place, effect, max(least, LEAST_GAIN))
    larger = problem.with_effects(normalised((*problem.unknowns.effects, effect)))
    quick, bare = larger.coarse(QUICK), problem.coarse(QUICK)
    best, start, evaluations = np.inf, place, 0
    for begin in _starts(problem, place, larger):
        there, more = descend(quick, Speeds(quick), begin, iterations=LOOK, tolerance=1e-4)
        evaluations += more
        cost = quick.cost(there)
        if cost < best:
            best, start = cost, there
    before = bare.cost(place)
    if not gains(before, best, len(bare.weight)):
        return None
    end, more = descend(larger, Speeds(larger), start, iterations=20, tolerance=1e-8)
    return larger, end, evaluations + more


def noticeable(problem: Problem, place: Floats, effect: str) -> tuple[Problem, Floats]:
    """A fitted motor with one more effect, of a size that would matter to its user."""
    larger = problem.with_effects(normalised((*problem.unknowns.effects, effect)))
    return larger, _starts(problem, place, larger)[0]


def _starts(problem: Problem, place: Floats, larger: Problem) -> list[Floats]:
    old, new = problem.unknowns, larger.unknowns
    added = [spec for spec in new.specs if spec.name not in old.names]
    starts = []
    for shares in product(*(spec.starts for spec in added)):
        sizes: dict[str, float] = {}
        for spec, share in zip(added, shares, strict=True):
            sizes[spec.name] = share * new.extent.of(spec)
            if spec.at_least is not None:
                least = spec.at_least
                sizes[spec.name] += sizes[least] if least in sizes else float(place[old.names.index(least)])
        starts.append(carried(old, place, new, {name: np.array(size) for name, size in sizes.items()}))
    return starts
