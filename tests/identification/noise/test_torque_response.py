"""Responses to a torque against SciPy's quadrature, where the two lags are apart and where they are one."""

from math import exp

import numpy as np
import pytest
from scipy.integrate import quad

from motor_identification.noise.torque_response import angle_response, fill_growth, lag_response, ramp

LAGS = [(12.0, 20.0), (20.0, 12.0), (12.0, 12.0), (12.0, 12.0001), (0.5, 2000.0)]  # [1/s]


@pytest.mark.parametrize("x", [0.0, 1e-14, 1e-6, 0.3, 50.0])
def test_a_ramp_has_no_pole(x: float) -> None:
    assert ramp(x) == pytest.approx(quad(lambda s: exp(-x * s), 0.0, 1.0)[0], rel=1e-12)


@pytest.mark.parametrize(("alpha", "beta"), LAGS)
@pytest.mark.parametrize("after", [1e-4, 0.004, 0.02])
def test_a_lag_behind_a_lag(alpha: float, beta: float, after: float) -> None:
    """Where both lags are one the angle is had by quadrature, which is exact over less than a time constant."""
    speed = quad(lambda s: exp(-alpha * (after - s) - beta * s), 0.0, after, epsrel=1e-12)[0]
    assert lag_response(alpha, beta, after) == pytest.approx(speed, rel=1e-9)
    angle = quad(lambda s: lag_response(alpha, beta, s), 0.0, after, epsabs=0.0, epsrel=1e-12)[0]
    assert angle_response(alpha, beta, after) == pytest.approx(angle, rel=1e-9)


@pytest.mark.parametrize(("alpha", "beta"), LAGS)
def test_growth_is_the_integral_of_products(alpha: float, beta: float) -> None:
    growth, duration = np.empty(6), 0.05

    def responses(s: float) -> tuple[float, float, float]:
        return angle_response(alpha, beta, s), lag_response(alpha, beta, s), exp(-beta * s)

    fill_growth(alpha, beta, duration, growth)
    for value, (i, j) in zip(growth, [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)], strict=True):
        points = [min(duration, share / max(alpha, beta)) for share in (1.0, 5.0)]
        exact = quad(lambda s, i=i, j=j: responses(s)[i] * responses(s)[j], 0.0, duration, points=points, limit=400)[0]
        assert value == pytest.approx(exact, rel=1e-5)


def test_the_speed_comes_to_its_stationary_variance() -> None:
    growth = np.empty(6)
    fill_growth(12.0, 20.0, 5.0, growth)
    assert 2.0 * 20.0 * growth[3] == pytest.approx(1.0 / (12.0 * (12.0 + 20.0)), rel=1e-6)
