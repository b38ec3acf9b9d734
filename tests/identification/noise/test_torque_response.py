"""Responses to a torque against SciPy's quadrature, where the two lags are apart and where they are one."""

from math import exp

import numpy as np
import pytest
from scipy.integrate import quad

from motor_identification.noise.torque_response import (
    ANGLE_D,
    ANGLE_T,
    BY_T,
    DD,
    LEFT_D,
    LEFT_T,
    RESPONSES,
    TERMS,
    fill_response,
    fill_series,
)
from motor_identification.recording import Floats

LAGS = [(12.0, 20.0), (20.0, 12.0), (12.0, 12.0), (12.0, 12.0001), (0.5, 2000.0), (2000.0, 0.5)]  # [1/s]


def respond(alpha: float, beta: float, duration: float) -> Floats:
    series, response = np.empty((TERMS, RESPONSES)), np.empty(RESPONSES)
    fill_series(alpha, beta, series)
    fill_response(series, max(alpha, beta), duration, response)
    return response


@pytest.mark.parametrize(("alpha", "beta"), LAGS)
@pytest.mark.parametrize("after", [1e-6, 1e-4, 0.004, 0.05, 0.6])
def test_a_lag_behind_a_lag(alpha: float, beta: float, after: float) -> None:
    response = respond(alpha, beta, after)
    assert response[LEFT_D] == pytest.approx(exp(-alpha * after), rel=1e-9, abs=1e-30)
    assert response[LEFT_T] == pytest.approx(exp(-beta * after), rel=1e-9, abs=1e-30)
    points = [min(after, share / max(alpha, beta)) for share in (1.0, 5.0)]

    def integral(of: object) -> float:
        return float(quad(of, 0.0, after, epsabs=0.0, epsrel=1e-12, points=points, limit=400)[0])

    assert response[ANGLE_D] == pytest.approx(integral(lambda s: exp(-alpha * s)), rel=1e-9)
    speed = integral(lambda s: exp(-alpha * (after - s) - beta * s))
    assert response[BY_T] == pytest.approx(speed, rel=1e-9)
    assert response[ANGLE_T] == pytest.approx(integral(lambda s: respond(alpha, beta, s)[BY_T]), rel=1e-9)


@pytest.mark.parametrize(("alpha", "beta"), LAGS)
@pytest.mark.parametrize("duration", [0.002, 0.05])
def test_growth_is_the_integral_of_products(alpha: float, beta: float, duration: float) -> None:
    def impulse(s: float) -> tuple[float, float, float]:
        response = respond(alpha, beta, s)
        return float(response[ANGLE_T]), float(response[BY_T]), exp(-beta * s)

    pairs, points = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)], [0.3, 1.0, 3.0, 10.0, 30.0]
    ends = np.unique([0.0, *(min(duration, share / max(alpha, beta)) for share in points), duration])
    nodes, weights = np.polynomial.legendre.leggauss(12)
    exact = np.zeros(6)
    for begin, end in zip(ends[:-1], ends[1:], strict=True):
        for node, weight in zip(nodes, weights, strict=True):
            g = impulse(begin + 0.5 * (end - begin) * (1.0 + node))
            exact += 0.5 * (end - begin) * weight * np.array([g[i] * g[j] for i, j in pairs])
    assert respond(alpha, beta, duration)[:6] == pytest.approx(exact, rel=1e-8)


def test_the_speed_comes_to_its_stationary_variance() -> None:
    assert 2.0 * 20.0 * respond(12.0, 20.0, 5.0)[DD] == pytest.approx(1.0 / (12.0 * (12.0 + 20.0)), rel=1e-9)
