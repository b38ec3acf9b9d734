"""One solver: walls, phases without walls, robust loss; and fits that are never worse than where they began."""

from dataclasses import replace

import numpy as np
import pytest
from small import THETA, small_estimate

from motor_identification.estimation.least_squares import (
    LEAST_GAIN,
    Box,
    SpeedResiduals,
    Tolerance,
    fit_residuals,
    fit_speeds,
    improves_fit,
    measure_scatter,
    minimise_squares,
)
from motor_identification.recording import Floats

BOX = Box(np.array([-3.0, -2.0]), np.array([4.0, 5.0]))
GOAL = np.array([1.0, 2.0])


@pytest.mark.parametrize("jacobian", [None, lambda theta: np.eye(2)], ids=["differences", "derivative"])
def test_the_minimum_of_a_bowl(jacobian) -> None:  # type: ignore[no-untyped-def]
    found = minimise_squares(lambda theta: theta - GOAL, jacobian, np.array([3.0, -1.0]), BOX, Tolerance())
    assert found.theta == pytest.approx(GOAL, abs=1e-6) and found.cost < 1e-12
    assert found.residual_calls >= 2 and found.jacobian_calls >= 1


def test_a_minimum_outside_is_found_on_the_wall_and_a_start_there_is_no_trouble() -> None:
    outside = np.array([9.0, 2.0])
    for start in (np.array([0.0, 0.0]), np.array([4.0, 5.0]), np.array([99.0, -99.0])):
        found = minimise_squares(lambda theta: theta - outside, lambda theta: np.eye(2), start, BOX, Tolerance())
        assert found.theta == pytest.approx([4.0, 2.0], abs=1e-4) and found.theta[0] <= 4.0
        assert found.cost == pytest.approx(25.0, rel=1e-4)


def test_a_phase_has_no_walls_and_ends_inside_the_box() -> None:
    box = Box(np.array([-np.pi]), np.array([np.pi]), np.array([True]))

    def wave(theta: Floats) -> Floats:
        return np.array([np.cos(theta[0]) - np.cos(3.0), np.sin(theta[0]) - np.sin(3.0)])

    start = np.array([-2.5])  # the way over the end of the box is the short one
    free = minimise_squares(wave, None, start, box, Tolerance())
    assert free.theta[0] == pytest.approx(3.0, abs=1e-5)
    held = minimise_squares(wave, None, start, Box(box.low, box.high), Tolerance())
    assert held.theta[0] == pytest.approx(-np.pi, abs=1e-3)


@pytest.mark.parametrize(("scale", "pulled"), [(np.inf, True), (0.1, False)])
def test_a_few_false_residuals_do_not_pull_a_robust_fit(scale: float, pulled: bool) -> None:
    data = np.append(np.random.default_rng(0).normal(2.0, 0.05, 40), [9.0, 9.0, 9.0])
    box = Box(np.array([-10.0]), np.array([10.0]))

    def residuals(theta: Floats) -> Floats:
        return np.asarray(theta[0] - data)

    found = minimise_squares(residuals, None, np.array([0.0]), box, Tolerance(), robust_scale=scale)
    assert (abs(found.theta[0] - 2.0) > 0.3) == pulled


def test_iterations_are_limited() -> None:
    start, far = small_estimate(THETA + [0.2, -0.2, 0.3]), Tolerance(iterations=3)
    target = SpeedResiduals(start.problem)
    unknowns = start.problem.unknowns
    box = Box(unknowns.low, unknowns.high)
    assert minimise_squares(target.residuals, target.jacobian, start.theta, box, far).residual_calls <= 3
    assert fit_speeds(start, iterations=3).simulations < fit_speeds(start).simulations


def test_a_motor_is_fitted_from_a_few_per_cent_away() -> None:
    start = small_estimate(THETA + [0.05, -0.05, 0.1])
    end = fit_speeds(start)
    assert np.abs(end.theta - THETA).max() < 2e-3 < np.abs(start.theta - THETA).max()
    assert end.cost < 1e-2 * start.cost
    target = SpeedResiduals(start.problem)
    assert np.sum(target.residuals(end.theta) ** 2) == pytest.approx(end.cost)
    slope = target.jacobian(end.theta).T @ target.residuals(end.theta)
    away = target.jacobian(start.theta).T @ target.residuals(start.theta)
    assert np.abs(slope).max() < 1e-4 * np.abs(away).max()


def test_what_is_not_improved_is_kept() -> None:
    class Worse:
        """Least squares is led uphill by a derivative of the wrong sign."""

        def residuals(self, theta: Floats) -> Floats:
            return theta - THETA

        def jacobian(self, theta: Floats) -> Floats:
            return -np.eye(3)

    start = small_estimate()
    assert fit_residuals(start, Worse()).theta == pytest.approx(THETA)


def test_a_start_without_numbers_is_kept() -> None:
    class Nowhere:
        """A motor that cannot be simulated."""

        def residuals(self, theta: Floats) -> Floats:
            return np.full(3, np.nan)

        def jacobian(self, theta: Floats) -> Floats:
            raise AssertionError("nobody asks how it changes")

    start = small_estimate()
    assert fit_residuals(start, Nowhere()) is start


@pytest.mark.parametrize(("gained", "enough"), [(0.99 * LEAST_GAIN, False), (1.01 * LEAST_GAIN, True)])
def test_a_gain_of_four_squared_standard_deviations(gained: float, enough: bool) -> None:
    count, after = 200, 3.0  # mean square of the residuals
    assert improves_fit(after * (1.0 + gained / count), after, count) is enough


def test_the_scatter_by_the_middle_half_does_not_mind_tails() -> None:
    clean = small_estimate()
    scatter = measure_scatter(clean)
    assert 0.5 < scatter.robust / scatter.rms < 1.5
    (data,) = clean.problem.intervals
    wrong = np.where(np.arange(len(data.speed)) % 40 == 0, 50.0, 0.0)
    spoilt = clean.on(clean.problem.with_intervals((replace(data, speed=data.speed + wrong),)))
    assert measure_scatter(spoilt).rms > 5.0 * scatter.rms
    assert measure_scatter(spoilt).robust == pytest.approx(scatter.robust, rel=0.1)


def test_the_scatter_of_a_motor_that_mostly_stands_is_that_of_its_motion() -> None:
    moving = small_estimate()
    (data,) = moving.problem.intervals
    rest = np.arange(len(data.speed)) % 3 > 0
    slack = np.where(rest, 1e9, data.slack)  # two thirds of the residuals are exactly 0, as at a standstill
    standing = moving.on(moving.problem.with_intervals((replace(data, slack=slack),)))
    scatter, whole = measure_scatter(standing), measure_scatter(moving)
    assert scatter.robust == pytest.approx(whole.robust, rel=0.3) and scatter.robust > 0.0
    still = moving.on(moving.problem.with_intervals((replace(data, slack=np.full(len(rest), 1e9)),)))
    assert (measure_scatter(still).rms, measure_scatter(still).robust) == (0.0, 0.0)
