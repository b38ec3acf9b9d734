"""Closed-form motion while nothing happens: the linear equation of one piece, of first or second order.

    inertia·dω/dt = v − torque − gradient·t − slope·(ω − ω0),   dθ/dt = ω
    first order   v = source − back_emf·ω
    second order  τ dv/dt = source − back_emf·ω − v   (armature inductance)

Both are x(h) = x0 + h φ1(hM) f0 + h² φ2(hM) f1 with f0 the derivative at the start, f1 what the load's gradient makes
of it, φ1(z) = (e^z − 1)/z, φ(n+1)(z) = (φn(z) − 1/n!)/z, and the travel its integral, one index higher: no steady state
is divided by, so that a motor without any damping is no special case.
"""

from math import cos, exp, expm1, sin, sqrt
from typing import NamedTuple, TypeVar

from motor_model.compiled import compiled

Number = TypeVar("Number", float, complex)

SMALL = 0.1  # below it φ by their series
DOUBLE = 1e-5  # of h·(half the gap of two eigenvalues): what is closer is taken as so far apart, good to its square


class Coefficients(NamedTuple):
    """The equation of one piece; the symbols are those above."""

    inertia: float
    torque: float
    slope: float
    source: float
    back_emf: float
    gradient: float


@compiled
def _phi2(z: float) -> float:
    """φ2(−z) = (z − 1 + e^(−z))/z²; the series is summed in a tree, which is quicker than an exponential."""
    if abs(z) < 0.3:
        w = z * z
        w2 = w * w
        first = (0.5 - z / 6.0) + w * (1.0 / 24.0 - z / 120.0)
        second = (1.0 / 720.0 - z / 5040.0) + w * (1.0 / 40320.0 - z / 362880.0)
        third = (1.0 / 3628800.0 - z / 39916800.0) + w * (1.0 / 479001600.0 - z / 6227020800.0)
        return first + w2 * (second + w2 * third)
    return (z + expm1(-z)) / (z * z)


@compiled
def _phi3(z: float) -> float:
    """φ3(−z) = (1/2 − φ2(−z))/z."""
    if abs(z) < 0.05:
        return 1 / 6 - z * (1 / 24 - z * (1 / 120 - z * (1 / 720 - z * (1 / 5040 - z * (1 / 40320 - z / 362880)))))
    return (0.5 - _phi2(z)) / z


@compiled
def relaxed(rate: float, acceleration: float, speed: float, h: float) -> tuple[float, float]:
    """Speed and travel after h of dω/dt = acceleration − rate·(ω − speed): an exponential approach."""
    z = rate * h
    second = _phi2(z)
    gained = acceleration * h
    return speed + gained * (1.0 - z * second), h * (speed + gained * second)


@compiled
def first_order(c: Coefficients, speed: float, h: float) -> tuple[float, float]:
    """Speed and travel after h of inertia·dω/dt = source − torque − gradient·t − back_emf·ω − slope·(ω − ω0)."""
    rate = (c.back_emf + c.slope) / c.inertia
    later, travel = relaxed(rate, (c.source - c.torque - c.back_emf * speed) / c.inertia, speed, h)
    if c.gradient != 0.0:
        z = rate * h
        bend = -c.gradient / c.inertia * h * h
        later += bend * _phi2(z)
        travel += bend * h * _phi3(z)
    return later, travel


@compiled
def _phi_series(z: Number) -> tuple[Number, Number, Number]:
    """φ1, φ2 and φ3 of a small number."""
    third = 1 / 6 + z * (1 / 24 + z * (1 / 120 + z * (1 / 720 + z * (1 / 5040 + z * (
        1 / 40320 + z * (1 / 362880 + z * (1 / 3628800 + z / 39916800)))))))  # fmt: skip
    second = 0.5 + z * third
    return 1.0 + z * second, second, third


@compiled
def _phi_from_growth(z: Number, growth: Number) -> tuple[Number, Number, Number]:
    """φ1, φ2 and φ3 of a number that is not small, from e^z − 1."""
    first = growth / z
    second = (first - 1.0) / z
    return first, second, (second - 0.5) / z


@compiled
def phi_triple(z: float) -> tuple[float, float, float]:
    """φ1, φ2 and φ3 of a real number."""
    if abs(z) < SMALL:
        return _phi_series(z)
    return _phi_from_growth(z, exp(z) - 1.0)


@compiled
def _complex_phi_triple(z: complex) -> tuple[complex, complex, complex]:
    """φ1, φ2 and φ3 of a complex number."""
    if abs(z) < SMALL:
        return _phi_series(z)
    return _phi_from_growth(z, exp(z.real) * complex(cos(z.imag), sin(z.imag)) - 1.0)


class Halves(NamedTuple):
    """φ1, φ2, φ3 of h·M: φ = even + odd·(M − mean)."""

    even1: float
    odd1: float
    even2: float
    odd2: float
    even3: float
    odd3: float


@compiled
def _halves(mean: float, square: float, h: float) -> Halves:
    """Split φ by the eigenvalues of M, mean ± √square: real ones one by one, of a complex pair one is enough."""
    gap = sqrt(abs(square))
    if square < 0.0 and gap * h >= DOUBLE:
        one, two, three = _complex_phi_triple(complex(mean * h, gap * h))
        return Halves(one.real, one.imag / gap, two.real, two.imag / gap, three.real, three.imag / gap)
    gap = max(gap, DOUBLE / h)
    upper1, upper2, upper3 = phi_triple((mean + gap) * h)
    lower1, lower2, lower3 = phi_triple((mean - gap) * h)
    share = 0.5 / gap
    return Halves(
        0.5 * (upper1 + lower1), share * (upper1 - lower1),
        0.5 * (upper2 + lower2), share * (upper2 - lower2),
        0.5 * (upper3 + lower3), share * (upper3 - lower3),
    )  # fmt: skip


@compiled
def halves_of(c: Coefficients, tau: float, h: float) -> Halves:
    """Split φ of the motor with inductance: the same for every motion over h [s], whatever its start and voltage."""
    a, e = -c.slope / c.inertia, -1.0 / tau
    return _halves(0.5 * (a + e), 0.25 * (a - e) * (a - e) + 1.0 / c.inertia * (-c.back_emf / tau), h)


@compiled
def second_order(c: Coefficients, tau: float, speed: float, drive: float, h: float) -> tuple[float, float, float]:
    """Speed, v and travel after h of the motor with inductance, exact by the eigenvalues of M."""
    return second_order_by(halves_of(c, tau, h), c, tau, speed, drive, h)


@compiled
def second_order_by(
    phi: Halves, c: Coefficients, tau: float, speed: float, drive: float, h: float
) -> tuple[float, float, float]:
    """Do the same by the halves of φ, which are the same for all motions over h."""
    a, b = -c.slope / c.inertia, 1.0 / c.inertia
    d, e = -c.back_emf / tau, -1.0 / tau
    f0 = (drive - c.torque) * b
    f1 = (c.source - c.back_emf * speed - drive) / tau
    mean = 0.5 * (a + e)
    g0 = (a - mean) * f0 + b * f1
    g1 = d * f0 + (e - mean) * f1
    travel = h * (speed + h * (phi.even2 * f0 + phi.odd2 * g0))
    later = speed + h * (phi.even1 * f0 + phi.odd1 * g0)
    then = drive + h * (phi.even1 * f1 + phi.odd1 * g1)
    if c.gradient != 0.0:
        bend = -c.gradient * b
        later += h * h * bend * (phi.even2 + phi.odd2 * (a - mean))
        then += h * h * bend * phi.odd2 * d
        travel += h * h * h * bend * (phi.even3 + phi.odd3 * (a - mean))
    return later, then, travel
