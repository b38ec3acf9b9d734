"""Search θ globally: multi-start search of an excerpt of joined intervals, then least squares on everything."""

from collections.abc import Callable

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import Problem
from motor_identification.estimation.request import SearchConfig, SearchReport
from motor_identification.estimation.search.excerpt import take_excerpt
from motor_identification.estimation.search.multistart import search
from motor_identification.estimation.search.objective import make_objective

COARSE_SAMPLES = 4.0  # in the intervals that a search compares: many slots at speed, a part of a time constant


def search_globally(
    problem: Problem, config: SearchConfig, progress: Callable[[float], None] | None = None
) -> tuple[Estimate, SearchReport]:
    """Search the whole box on an excerpt of joined intervals, then fit all intervals by least squares from there."""
    coarse = problem.coarsen(COARSE_SAMPLES)
    excerpt = take_excerpt(coarse)
    report = search(make_objective(excerpt), config, progress)
    estimate = Estimate(excerpt, report.theta, report.evaluations)
    if excerpt is not coarse:  # the rest of the way is shorter from the excerpt's own minimum
        estimate = fit_speeds(estimate)
    return fit_speeds(estimate.on(problem)), report
