"""Edges that were not counted, or counted twice: intervals off by whole slots say nothing of speed."""

import numpy as np

from motor_identification.estimation.least_squares import Speeds, descend, typical
from motor_identification.estimation.problem import Problem
from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Bools, Floats

WITHIN = 4.0  # standard deviations from a whole number of slots
HEAVY = 2.0  # times its middle half, from which on a distribution has tails that no noise makes
CLEANINGS = 8  # rounds at most of leaving out miscounted intervals: each makes the next easier to see


def miscounted(data: Intervals, increments: Floats) -> Bools:
    """Which intervals' travel [rad] is off by a whole number of slots, within 4 σ of all the others' scatter.

    Shapes are (I,). Where the model is so far off that 4 σ reach half a slot, nothing is marked.
    """
    moving = (data.slack == 0.0) & (data.edge[:, 0] >= 0)
    if data.slot == 0.0 or not np.any(moving):
        return np.zeros(len(increments), dtype=bool)
    middle = float(np.median(increments[moving]))
    sigma = 1.4826 * float(np.median(np.abs(increments[moving] - middle)))
    slots = np.round(increments / data.slot)
    near = np.abs(increments - slots * data.slot) < max(WITHIN * sigma, 1e-3 * data.slot)
    return np.asarray(moving & (slots != 0.0) & near & (WITHIN * sigma < 0.5 * data.slot))


def find_miscounted(problem: Problem, place: Floats) -> tuple[Bools, ...]:
    """The miscounted intervals of every recording, judged at a fitted place (D,)."""
    rows = zip(problem.intervals, problem.increments(place), strict=True)
    return tuple(miscounted(data, increments) for data, increments in rows)


def without_tails(problem: Problem, place: Floats) -> tuple[Floats, int] | None:
    """The fit of most intervals and its simulations, where some are so far off that they pull a fit (D,) of all."""
    whole, middle = typical(problem, place)
    return descend(problem, Speeds(problem), place, most=middle) if whole > HEAVY * middle else None


def cleaned(problem: Problem, place: Floats) -> tuple[Problem, Floats, int]:
    """Fit mean speeds from a place (D,), leave out what is off by whole slots, and again.

    Returns what is kept, its best fit, and the number of simulations.
    """
    evaluations = 0
    for _ in range(CLEANINGS):
        place, more = descend(problem, Speeds(problem), place)
        evaluations += more
        most = without_tails(problem, place)
        if most is not None:  # else false intervals hide each other
            place, more = most
            evaluations += more
        bad = find_miscounted(problem, place)
        if not any(marks.any() for marks in bad):
            break
        problem = problem.without(bad)
    return problem, place, evaluations
