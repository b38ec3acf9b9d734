"""The state's own operations against the textbook's matrices."""

import numpy as np
import pytest
from filter_bench import state
from numpy.typing import NDArray

from motor_control.filter.filter_state import Covariance, correct_angle, inflate_covariance, mirror_motion

COVARIANCE = Covariance(4e-6, 1e-4, -2e-5, 0.04, -1e-3, 0.01)


def matrix(c: Covariance) -> NDArray[np.float64]:
    return np.array([[c.aa, c.as_, c.al], [c.as_, c.ss, c.sl], [c.al, c.sl, c.ll]])


def test_a_correction_is_kalmans() -> None:
    before = state(10.0, 0.01, 0.2, COVARIANCE).estimate
    shift, variance = 0.003, COVARIANCE.aa + 1e-6
    after = correct_angle(before, shift, variance, 1.0)
    p, h = matrix(COVARIANCE), np.array([1.0, 0.0, 0.0])
    gain = p @ h / variance
    assert matrix(after.covariance) == pytest.approx(p - np.outer(gain, h @ p), rel=1e-12)
    moved = (after.motor.angle - 0.01, after.motor.speed - 10.0, after.load - 0.2)
    assert moved == pytest.approx(gain * shift, rel=1e-12)


def test_an_inflation_adds_an_outer_product() -> None:
    doubt = np.array([1e-3, 0.3, -0.2])
    after = inflate_covariance(COVARIANCE, *doubt)
    assert matrix(after) == pytest.approx(matrix(COVARIANCE) + np.outer(doubt, doubt), rel=1e-12)


def test_a_mirrored_motion_is_its_own_mirror() -> None:
    x = state(10.0, 0.01, 0.2, COVARIANCE)
    there = mirror_motion(x, -0.2)
    assert (there.estimate.motor.speed, there.estimate.motor.angle, there.history.edge.side) == (-10.0, -0.01, -1.0)
    turned = np.diag([-1.0, -1.0, 1.0])
    assert matrix(there.estimate.covariance) == pytest.approx(turned @ matrix(COVARIANCE) @ turned)
    back = mirror_motion(there, 0.2)
    assert back.estimate == x.estimate and back.history.edge == x.history.edge
