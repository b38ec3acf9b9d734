"""Closed-form motion while nothing happens: the linear equation of one piece, of first or second order.

    inertia·dω/dt = v − torque − slope·(ω − ω0),   dθ/dt = ω
    first order   v = source − back_emf·ω
    second order  τ dv/dt = source − back_emf·ω − v   (armature inductance)

Both are x(h) = x0 + h φ1(hM) f0 with f0 the derivative at the start, φ1(z) = (e^z − 1)/z and φ2(z) = (φ1(z) − 1)/z for
its integral: no steady state is divided by, so that a motor without any damping is no special case.
"""

from math import cos, exp, expm1, sin
from typing import NamedTuple

from motor_model.compiled import compiled


class Coefficients(NamedTuple):
    """The equation of one piece; the symbols are those above."""

    inertia: float
    torque: float
    slope: float
    source: float
    back_emf: float


@compiled
def _phi(z: float) -> tuple[float, float]:
    """φ1 = (1 − e^(−z))/z and φ2 = (z − 1 + e^(−z))/z² = (1 − φ1)/z; short pieces need no exponential."""
    if abs(z) < 0.03:
        second = 0.5 - z * (1 / 6 - z * (1 / 24 - z * (1 / 120 - z * (1 / 720 - z * (1 / 5040 - z / 40320)))))
        return 1.0 - z * second, second
    first = -expm1(-z) / z
    return first, (1.0 - first) / z


@compiled
def first_order(c: Coefficients, speed: float, h: float) -> tuple[float, float]:
    """Speed and travel after h of inertia·dω/dt = source − torque − back_emf·ω − slope·(ω − ω0)."""
    z = (c.back_emf + c.slope) * h / c.inertia
    start = (c.source - c.torque - c.back_emf * speed) / c.inertia
    first, second = _phi(z)
    return speed + start * h * first, h * (speed + start * h * second)


@compiled
def _phi_pair(z: complex) -> tuple[complex, complex]:
    """(e^z − 1)/z and (e^z − 1 − z)/z² of a complex number."""
    if abs(z) < 1e-2:
        second = 0.5 + z * (1.0 / 6.0 + z * (1.0 / 24.0 + z * (1.0 / 120.0 + z * (1.0 / 720.0 + z / 5040.0))))
        return 1.0 + z * second, second
    growth = exp(z.real) * complex(cos(z.imag), sin(z.imag)) - 1.0
    return growth / z, (growth - z) / (z * z)


@compiled
def second_order(c: Coefficients, tau: float, speed: float, drive: float, h: float) -> tuple[float, float, float]:
    """Speed, v and travel after h of the motor with inductance: x1 = x0 + h φ1(hM) f0, exact by eigenvalues of M."""
    a, b = -c.slope / c.inertia, 1.0 / c.inertia
    d, e = -c.back_emf / tau, -1.0 / tau
    f0 = (drive - c.torque) * b
    f1 = (c.source - c.back_emf * speed - drive) / tau
    mean = 0.5 * (a + e)
    gap = complex(0.25 * (a - e) * (a - e) + b * d, 0.0) ** 0.5
    if abs(gap) * h < 1e-5:
        gap = complex(1e-5 / h, 0.0)
    upper1, upper2 = _phi_pair((mean + gap) * h)
    lower1, lower2 = _phi_pair((mean - gap) * h)
    even1, odd1 = 0.5 * (upper1 + lower1).real, (0.5 * (upper1 - lower1) / gap).real
    even2, odd2 = 0.5 * (upper2 + lower2).real, (0.5 * (upper2 - lower2) / gap).real
    g0 = (a - mean) * f0 + b * f1
    g1 = d * f0 + (e - mean) * f1
    travel = h * (speed + h * (even2 * f0 + odd2 * g0))
    return speed + h * (even1 * f0 + odd1 * g0), drive + h * (even1 * f1 + odd1 * g1), travel
