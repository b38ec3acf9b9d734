"""Residuals of intervals, and of a swarm on any number of threads."""

import numpy as np
import pytest
from small import THETA, small_recording

from motor_identification.estimation import residual
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.residual import Latest, compute_residuals
from motor_identification.measurement.edit_intervals import append_standstills
from motor_identification.measurement.intervals import index_intervals

SLOT = 0.1  # [rad]


def test_a_moving_interval_leaves_the_difference_of_speeds() -> None:
    data = index_intervals(np.array([0.0, 0.5]), np.array([0.5, 0.7]), np.array([2.0, -3.0]), np.zeros(2))
    angle = np.array([0.0, 1.1, 0.6])  # 2.2 and −2.5 rad/s
    assert compute_residuals(data, angle) == pytest.approx([0.2, 0.5])


@pytest.mark.parametrize(
    ("travel", "left"), [(0.0, 0.0), (0.099, 0.0), (-0.099, 0.0), (0.3, 0.2 / 0.4), (-0.3, -0.2 / 0.4)]
)
def test_without_an_edge_a_slot_is_free(travel: float, left: float) -> None:
    nothing = index_intervals(np.empty(0), np.empty(0), np.empty(0), np.empty(0), edge=np.empty((0, 2), dtype=np.int64))
    data = append_standstills(nothing, (np.array([0.1]), np.array([0.5])), SLOT)
    angle = np.where(data.time < 0.3, 0.0, travel)
    assert compute_residuals(data, angle) == pytest.approx([left])


@pytest.mark.parametrize("workers", [1, 2, 3])
def test_a_swarm_has_the_residuals_of_its_motors(workers: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(residual, "LEAST_THREADED_STEPS", 0)
    problem = make_problem([small_recording(0), small_recording(1)], ("coulomb_friction",), workers)
    thetas = THETA + 0.02 * np.random.default_rng(0).standard_normal((7, 3))
    together = problem.evaluate(thetas)
    assert together.shape == (7, len(problem.weight))
    for theta, row in zip(thetas, together, strict=True):
        assert np.array_equal(problem.residuals(theta), row)
        angles = problem.angles(theta)
        rows = zip(problem.intervals, angles, strict=True)
        assert np.array_equal(np.concatenate([compute_residuals(data, angle) for data, angle in rows]), row)


def test_the_latest_values_are_computed_once() -> None:
    latest, computed = Latest[float](2), []

    def find(x: float) -> float:
        return latest.find(np.array([x, 1.0]), lambda: computed.append(x) or 10.0 * x)  # type: ignore[func-returns-value]

    assert [find(x) for x in (1.0, 2.0, 1.0, 2.0)] == [10.0, 20.0, 10.0, 20.0] and computed == [1.0, 2.0]
    assert find(3.0) == 30.0 and find(1.0) == 10.0 and computed == [1.0, 2.0, 3.0, 1.0]  # two are kept
    forgetful = Latest[float](0)
    assert forgetful.find(THETA, lambda: 1.0) == 1.0 and forgetful.find(THETA, lambda: 2.0) == 2.0
