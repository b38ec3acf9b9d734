"""An effect joins a fitted model: all parameters again by least squares, from a few values of its own.

The rest of the model is near its place already; what an effect's own valley looks like decides how many are needed.
"""

from collections.abc import Sequence
from itertools import product

import numpy as np

from motor_identification.estimation.least_squares import LEAST_GAIN, Speeds, descend, gains
from motor_identification.estimation.parameter_space import carried
from motor_identification.estimation.problem import Problem
from motor_identification.periodic import periodic_fit
from motor_identification.recording import Floats
from motor_model.effects import EFFECT_BY_NAME, SPEC_BY_NAME, normalised

QUICK = 0.02  # [s] intervals of the quick look
LOOK = 10  # iterations of it

# Shares of the largest voltage, speed or duration for what is scaled by these; plain values for the others.
VALUES: dict[str, Sequence[float]] = {
    "ks": (0.03,),
    "breakaway_voltage": (0.1, 0.03),  # above ks
    "stribeck_speed": (0.01, 0.035, 0.1),
    "drag": (0.05,),
    "bias_voltage": (0.02,),
    "step_voltage": (0.03, -0.03),
    "step_time": (0.1, 0.3, 0.5, 0.7, 0.9),
    "dead_zone_voltage": (0.03,),
    "limit_voltage": (0.97, 0.85, 0.7),
    "reverse_gain": (0.97,),
    "coast_share": (0.2,),
    "sag": (0.05,),
    "electrical_time_constant": (5e-4, 4e-3),
    "delay": (2e-3, 1e-2, 4e-2),
    "backlash_angle": (0.05, 0.4),
    "load_fraction": (0.3, 0.7),
    "resistance_rise": (0.1,),
    "warm_up_time": (2.0, 15.0, 100.0),
}


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
    names = [name for name in new.names if name not in old.names]
    friction = float(place[old.names.index("ks")]) if "ks" in old.names else 0.0
    starts = []
    for shares in product(*(VALUES[name] for name in names)):
        sizes = {name: share * new.extent.of(SPEC_BY_NAME[name]) for name, share in zip(names, shares, strict=True)}
        if "breakaway_voltage" in sizes:
            sizes["breakaway_voltage"] += sizes.get("ks", friction)
        starts.append(carried(old, place, new, {name: np.array(size) for name, size in sizes.items()}))
    return starts
