"""Closed-form motion of one piece against a fine integration of its equation by the Runge-Kutta method."""

import numpy as np
import pytest
from numpy.typing import NDArray

from motor_model.dynamics.linear import Coefficients, first_order, relaxed, second_order

STEPS = 2000
H = 0.02
PLAIN = Coefficients(inertia=0.0055, torque=0.4, slope=0.0, source=6.0, back_emf=0.069, gradient=0.0)


def integrated(c: Coefficients, tau: float, speed: float, drive: float, h: float) -> tuple[float, float, float]:
    """Speed, v and travel after h; without tau, v follows the speed at once."""

    def derivative(t: float, x: NDArray[np.float64]) -> NDArray[np.float64]:
        omega, v, _ = x
        if tau == 0.0:
            v = c.source - c.back_emf * omega
        gained = (v - c.torque - c.gradient * t - c.slope * (omega - speed)) / c.inertia
        return np.array([gained, (c.source - c.back_emf * omega - v) / tau if tau else 0.0, omega])

    x, dt = np.array([speed, drive, 0.0]), h / STEPS
    for k in range(STEPS):
        t = k * dt
        k1 = derivative(t, x)
        k2 = derivative(t + dt / 2, x + dt / 2 * k1)
        k3 = derivative(t + dt / 2, x + dt / 2 * k2)
        k4 = derivative(t + dt, x + dt * k3)
        x = x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return float(x[0]), float(x[1]), float(x[2])


@pytest.mark.parametrize("rate", [-30.0, 0.0, 1e-9, 12.5, 16.0, 5000.0])
def test_an_approach_is_an_exponential_for_any_rate(rate: float) -> None:
    speed, travel = relaxed(rate, 1000.0, 20.0, H)
    if abs(rate) < 1e-6:
        assert (speed, travel) == pytest.approx((40.0, 20.0 * H + 500.0 * H * H), rel=1e-9)
    else:
        gained = -np.expm1(-rate * H) / rate
        assert speed == pytest.approx(20.0 + 1000.0 * gained, rel=1e-12)
        assert travel == pytest.approx(20.0 * H + 1000.0 * (H - gained) / rate, rel=1e-12)


@pytest.mark.parametrize(
    "c",
    [
        PLAIN,
        PLAIN._replace(gradient=30.0),
        PLAIN._replace(slope=-0.2),
        PLAIN._replace(slope=0.3, gradient=-50.0),
        PLAIN._replace(back_emf=0.0),
        PLAIN._replace(back_emf=0.0, gradient=30.0),
        PLAIN._replace(inertia=2e-5, gradient=30.0),
    ],
)
@pytest.mark.parametrize("speed", [0.0, 40.0, -40.0])
def test_first_order(c: Coefficients, speed: float) -> None:
    later, _, travel = integrated(c, 0.0, speed, 0.0, H)
    assert first_order(c, speed, H) == pytest.approx((later, travel), rel=1e-8, abs=1e-9)


@pytest.mark.parametrize(
    "tau", [0.001, PLAIN.inertia / PLAIN.back_emf / 4.0, 0.02, 0.1]
)  # the second: critical damping
@pytest.mark.parametrize("c", [PLAIN, PLAIN._replace(slope=-0.2, gradient=30.0), PLAIN._replace(back_emf=0.0)])
def test_second_order(c: Coefficients, tau: float) -> None:
    for speed, drive in ((0.0, 0.0), (40.0, -2.0)):
        expected = integrated(c, tau, speed, drive, H)
        later, then, travel = second_order(c, tau, speed, drive, H)
        assert (later, then, travel) == pytest.approx(expected, rel=1e-7, abs=1e-8)


def test_a_piece_can_be_cut_where_one_likes() -> None:
    half = second_order(PLAIN, 0.02, 40.0, -2.0, H / 2)
    whole, again = second_order(PLAIN, 0.02, 40.0, -2.0, H), second_order(PLAIN, 0.02, half[0], half[1], H / 2)
    assert (again[0], again[1], half[2] + again[2]) == pytest.approx(whole, rel=1e-12)
    part = first_order(PLAIN, 40.0, H / 2)
    later = first_order(PLAIN, part[0], H / 2)
    assert (later[0], part[1] + later[1]) == pytest.approx(first_order(PLAIN, 40.0, H), rel=1e-12)
