"""The objective of a search is the problem's output error, with the cost that noise alone leaves."""

import numpy as np
import pytest
from small import THETA, small_problem, small_recording

from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.search.objective import NEGLIGIBLE, USUAL_IRREGULARITY, make_objective


def test_costs_are_the_sums_of_squared_residuals() -> None:
    problem = small_problem()
    objective = make_objective(problem)
    thetas = THETA + 0.02 * np.random.default_rng(0).standard_normal((5, 3))
    assert objective.costs(thetas) == pytest.approx(np.sum(objective.residuals(thetas) ** 2, axis=1))
    assert objective.costs(thetas)[0] == pytest.approx(problem.cost(thetas[0]))
    assert np.array_equal(objective.low, problem.unknowns.low) and not objective.periodic.any()


@pytest.mark.parametrize(("irregularity", "explained"), [(0.0, True), (0.01, True), (0.04, False)])
def test_noise_explains_discs_as_they_are_made(irregularity: float, explained: bool) -> None:
    problem = make_problem([small_recording(3, irregularity)], ("coulomb_friction",))
    objective = make_objective(problem)
    assert (objective.costs(THETA[None])[0] < objective.noise_cost) == explained
    assert 0.01 < USUAL_IRREGULARITY < 0.04


def test_a_wrong_motor_is_not_noise() -> None:
    objective = make_objective(small_problem())
    wrong = THETA + [0.05, 0.0, 0.0]
    assert objective.costs(wrong[None])[0] > 3.0 * objective.noise_cost
    assert 0.0 < objective.negligible < 1e-6 * objective.noise_cost and NEGLIGIBLE < 1e-9
