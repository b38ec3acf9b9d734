"""Compute how a motor's angle and speed respond to a random torque: impulse responses, growth of their covariance.

The motor is a lag α = kv/ka, the torque an Ornstein–Uhlenbeck process, a lag β = 1/τ (`error_filter.py`).
"""

from math import exp, expm1

from motor_identification.recording import Floats
from motor_model.compiled import compiled

_PANEL = 0.5  # of the faster time constant: first panel of a quadrature, the next ones are twice as long each
_NODES = (0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970262)  # Gauss-Legendre on 0..1
_WEIGHTS = (0.17392742256872692, 0.32607257743127305, 0.32607257743127305, 0.17392742256872692)


@compiled
def ramp(x: float) -> float:
    """Compute (1 − e^(−x))/x."""
    return -expm1(-x) / x if x > 1e-12 else 1.0


@compiled
def lag_response(alpha: float, beta: float, s: float) -> float:
    """Compute (e^(−β s) − e^(−α s))/(α − β): what is left in a lag α, s after an impulse in a lag β."""
    difference = (alpha - beta) * s
    return exp(-beta * s) * s * ramp(difference) if difference >= 0.0 else exp(-alpha * s) * s * ramp(-difference)


@compiled
def angle_response(alpha: float, beta: float, s: float) -> float:
    """Integrate `lag_response` from 0 to s; by quadrature where its difference of two ramps would cancel."""
    if max(alpha, beta) * s > 1e-2 and abs(alpha - beta) > 1e-3 * max(alpha, beta):
        return s * (ramp(beta * s) - ramp(alpha * s)) / (alpha - beta)
    total = 0.0
    for i in range(4):
        total += _WEIGHTS[i] * s * lag_response(alpha, beta, _NODES[i] * s)
    return total


@compiled
def fill_growth(alpha: float, beta: float, duration: float, growth: Floats) -> None:
    """Integrate g gᵀ over a time [s], g = (angle, speed, torque) after an impulse of torque: bb, bd, bT, dd, dT, TT.

    Panels that double resolve the fast part at the beginning and the slow one at the end.
    """
    for i in range(6):
        growth[i] = 0.0
    begin, length = 0.0, _PANEL / max(alpha, beta)
    while begin < duration:
        panel = min(length, duration - begin)
        for i in range(4):
            s, weight = begin + _NODES[i] * panel, _WEIGHTS[i] * panel
            angle, speed, torque = angle_response(alpha, beta, s), lag_response(alpha, beta, s), exp(-beta * s)
            growth[0] += weight * angle * angle
            growth[1] += weight * angle * speed
            growth[2] += weight * angle * torque
            growth[3] += weight * speed * speed
            growth[4] += weight * speed * torque
            growth[5] += weight * torque * torque
        begin += panel
        length = begin  # doubles
