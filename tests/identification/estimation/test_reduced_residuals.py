"""Reduced residuals lead a solver the same way as all of them, and it is not asked for derivatives where it ends."""

import numpy as np
import pytest
from scipy.optimize import least_squares
from small import THETA, small_estimate

from motor_identification.estimation.least_squares import Box, SpeedResiduals, Tolerance, minimise_squares
from motor_identification.estimation.reduced_residuals import ReducedResiduals
from motor_identification.recording import Floats

START = THETA + [0.2, -0.2, 0.3]
TARGET = SpeedResiduals(small_estimate(START).problem)
UNKNOWNS = TARGET.problem.unknowns
BOX = Box(UNKNOWNS.low, UNKNOWNS.high)


def reduced(calls: int = 60, cost: float = 1e-8, unknowns: float = 1e-8) -> ReducedResiduals:
    return ReducedResiduals(TARGET.residuals, TARGET.jacobian, cost, unknowns, calls)


def test_cost_gradient_and_curvature_are_those_of_all_residuals() -> None:
    one, residuals, slopes = reduced(), TARGET.residuals(START), TARGET.jacobian(START)
    few, derivative = one.residuals(START), one.jacobian(START)
    assert few.shape == (4,) and derivative.shape == (4, 3)
    assert few @ few == pytest.approx(residuals @ residuals, rel=1e-13)
    assert derivative.T @ few == pytest.approx(slopes.T @ residuals, rel=1e-9)
    assert derivative.T @ derivative == pytest.approx(slopes.T @ slopes, rel=1e-9)
    again = reduced()
    assert again.residuals(THETA)[0] == pytest.approx(np.linalg.norm(TARGET.residuals(THETA)))
    assert again.jacobian(START) == pytest.approx(derivative)  # wherever it is asked for


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
@pytest.mark.parametrize("iterations", [3, 60])
def test_the_solver_goes_the_same_way(tolerance: float, iterations: int) -> None:
    """As many steps, and to the same end, whether it ends by the cost, by the step or by what it may ask."""
    how = Tolerance(tolerance, tolerance, 0.01 * tolerance, iterations)
    end = minimise_squares(TARGET.residuals, TARGET.jacobian, START, BOX, how, reduced=True)
    whole = least_squares(
        TARGET.residuals, START, TARGET.jacobian, (BOX.low, BOX.high), ftol=tolerance, xtol=tolerance,
        gtol=0.01 * tolerance, max_nfev=iterations, x_scale=BOX.high - BOX.low,
    )  # fmt: skip
    assert end.theta == pytest.approx(whole.x, abs=1e-7) and end.cost == pytest.approx(2.0 * whole.cost, rel=1e-7)
    assert abs(end.residual_calls - whole.nfev) <= (1 if tolerance < 1e-8 else 0)  # the last digits may differ


def count_derivatives(iterations: int, tolerance: float) -> tuple[int, int]:
    """How often a descent asks for derivatives, and how often the solver believes that it does."""
    asked: list[Floats] = []

    def jacobian(theta: Floats) -> Floats:
        asked.append(theta)
        return TARGET.jacobian(theta)

    how = Tolerance(tolerance, tolerance, 1e-15, iterations)
    end = minimise_squares(TARGET.residuals, jacobian, START, BOX, how, reduced=True)
    return len(asked), end.jacobian_calls


@pytest.mark.parametrize(("iterations", "tolerance"), [(3, 1e-12), (60, 1e-3)])
def test_no_derivative_is_computed_where_it_ends(iterations: int, tolerance: float) -> None:
    computed, believed = count_derivatives(iterations, tolerance)
    assert 1 < computed == believed - 1


def test_a_small_gain_of_which_more_was_predicted_is_not_the_end() -> None:
    """As at a kink: the solver makes its steps shorter there, and goes on."""
    one = ReducedResiduals(
        lambda theta: np.array([10.0 - 1e-4 * theta[0], 0.0]), lambda theta: np.array([[-1.0], [0.0]]), 1e-3, 0.0, 60
    )
    for at in (np.array([0.0]), np.array([1.0])):
        one.residuals(at)
        assert np.any(one.jacobian(at))  # 2e-5 of the cost, a ten thousandth of what was predicted
    right = ReducedResiduals(
        lambda theta: np.array([10.0 - 1e-4 * theta[0], 0.0]), lambda theta: np.array([[-1e-4], [0.0]]), 1e-3, 0.0, 60
    )
    right.residuals(np.array([0.0]))
    assert np.any(right.jacobian(np.array([0.0])))
    right.residuals(np.array([1.0]))
    assert not np.any(right.jacobian(np.array([1.0])))


def test_fewer_residuals_than_unknowns() -> None:
    one = ReducedResiduals(lambda theta: theta[:1] - 2.0, lambda theta: np.array([[1.0, 0.0]]), 1e-8, 1e-8, 60)
    few, derivative = one.residuals(np.zeros(2)), one.jacobian(np.zeros(2))
    assert few == pytest.approx([2.0, 0.0, 0.0]) and derivative.T @ few == pytest.approx([-2.0, 0.0])
