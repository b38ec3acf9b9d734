"""The whole box is searched, and the end is the least-squares fit of all intervals."""

import numpy as np
import pytest
from small import THETA, TRUE, small_problem

from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.request import Request, SearchConfig
from motor_identification.estimation.search.global_search import search_globally


def test_it_ends_where_least_squares_from_the_truth_does() -> None:
    problem = small_problem()
    told: list[float] = []
    estimate, report = search_globally(problem, SearchConfig(particles=20), told.append)
    best = fit_speeds(estimate.on(problem), tolerance=1e-12)
    assert estimate.problem is problem and best.cost == pytest.approx(estimate.cost, rel=1e-6)
    assert estimate.parameters.values == pytest.approx(TRUE, rel=5e-3)
    assert np.abs(report.theta - THETA).max() < 0.02  # on joined intervals, before
    assert estimate.simulations > report.evaluations > 30 and told == sorted(told) and told


def test_a_request_is_effects_a_search_and_cores() -> None:
    request = Request()
    assert (request.effects, request.workers) == ((), 1)
    assert (request.search.particles, request.search.epochs, request.search.seed) == (50, 200, 0)
    assert request.search.budget == 50 * 201
