"""Compute how a motor's angle and speed respond to a random torque: transition and growth of their covariance.

The motor is a lag α = kv/ka, the torque an Ornstein–Uhlenbeck process, a lag β = 1/τ (`error_filter.py`). With
g = (angle, speed, torque) after an impulse of torque, the growth over a time h is the integral of g gᵀ. Over a quarter
of the faster time constant all of it is a power series in h, the same for every interval of a recording; what is longer
is doubled from there, F(2h) = F(h)² and Q(2h) = F(h) Q(h) F(h)ᵀ + Q(h): no difference of exponentials cancels.
"""

import numpy as np

from motor_identification.recording import Floats
from motor_model.compiled import compiled

# A response: the growth of angle² , angle·speed, angle·torque, speed², speed·torque, torque² by a unit impulse each
# second, then what is left of a speed and of a torque, the speed that a torque makes, and the angles that both make.
RESPONSES = 11
BB, BD, BT, DD, DT, TT, LEFT_D, LEFT_T, BY_T, ANGLE_D, ANGLE_T = range(RESPONSES)
TERMS = 12  # of a series: the next is 1e-13 of the first
LONGEST = 0.25  # of the faster time constant, for which a series is good
SHORT_TERMS, SHORT = 8, 0.05  # the same of what is as short as most intervals between edges are


@compiled
def fill_series(alpha: float, beta: float, series: Floats) -> None:
    """Fill the coefficients (TERMS, RESPONSES) over h·max(α, β), each over the power of h that it begins with."""
    fastest = max(alpha, beta)
    a, b = alpha / fastest, beta / fastest
    count = TERMS + 5
    # Power series of g over s·fastest: derivatives at 0 follow from each other, over factorials.
    torque, speed, angle = np.zeros(count), np.zeros(count), np.zeros(count)
    of_torque, of_speed, factorial = 1.0, 0.0, 1.0
    for k in range(count):
        factorial *= max(k, 1)
        torque[k], speed[k] = of_torque / factorial, of_speed / factorial
        if k + 1 < count:
            angle[k + 1] = of_speed / (factorial * (k + 1))
        of_torque, of_speed = -b * of_torque, of_torque - a * of_speed
    series[:] = 0.0
    left = 1.0
    for k in range(TERMS):
        series[k, BB] = _product(angle, angle, k + 4) / (k + 5)
        series[k, BD] = _product(angle, speed, k + 3) / (k + 4)
        series[k, BT] = _product(angle, torque, k + 2) / (k + 3)
        series[k, DD] = _product(speed, speed, k + 2) / (k + 3)
        series[k, DT] = _product(speed, torque, k + 1) / (k + 2)
        series[k, TT] = _product(torque, torque, k) / (k + 1)
        series[k, LEFT_D], series[k, LEFT_T] = left, torque[k]
        series[k, BY_T], series[k, ANGLE_T], series[k, ANGLE_D] = speed[k + 1], angle[k + 2], left / (k + 1)
        left *= -a / (k + 1)


@compiled
def _product(one: Floats, other: Floats, power: int) -> float:
    """Compute the coefficient of a power in the product of two series."""
    total = 0.0
    for i in range(power + 1):
        total += one[i] * other[power - i]
    return total


@compiled
def fill_response(series: Floats, fastest: float, duration: float, response: Floats) -> None:
    """Fill the responses (RESPONSES,) over a time [s], fastest: max(α, β) [1/s] of the series."""
    doublings, h = 0, duration
    while h * fastest > LONGEST:
        h *= 0.5
        doublings += 1
    x, square = h * fastest, h * h
    last = (SHORT_TERMS if x < SHORT else TERMS) - 1
    bb, bd, bt, dd, dt, tt = (
        series[last, BB],
        series[last, BD],
        series[last, BT],
        series[last, DD],
        series[last, DT],
        series[last, TT],
    )
    left_d, left_t, by_t = series[last, LEFT_D], series[last, LEFT_T], series[last, BY_T]
    angle_d, angle_t = series[last, ANGLE_D], series[last, ANGLE_T]
    for k in range(last - 1, -1, -1):  # by name, which keeps them in registers: half the time of a loop over an array
        bb = bb * x + series[k, BB]
        bd = bd * x + series[k, BD]
        bt = bt * x + series[k, BT]
        dd = dd * x + series[k, DD]
        dt = dt * x + series[k, DT]
        tt = tt * x + series[k, TT]
        left_d = left_d * x + series[k, LEFT_D]
        left_t = left_t * x + series[k, LEFT_T]
        by_t = by_t * x + series[k, BY_T]
        angle_d = angle_d * x + series[k, ANGLE_D]
        angle_t = angle_t * x + series[k, ANGLE_T]
    response[BB], response[BD], response[BT] = bb * (square * square * h), bd * (square * square), bt * (square * h)
    response[DD], response[DT], response[TT] = dd * (square * h), dt * square, tt * h
    response[LEFT_D], response[LEFT_T], response[BY_T] = left_d, left_t, by_t * h
    response[ANGLE_D], response[ANGLE_T] = angle_d * h, angle_t * square
    for _ in range(doublings):
        _double(response)


@compiled
def _double(response: Floats) -> None:
    """Make responses those over twice the time."""
    bb, bd, bt, dd, dt, tt = response[BB], response[BD], response[BT], response[DD], response[DT], response[TT]
    d, t, by, angle_d, angle_t = (
        response[LEFT_D],
        response[LEFT_T],
        response[BY_T],
        response[ANGLE_D],
        response[ANGLE_T],
    )
    b_d, b_t = bd + angle_d * dd + angle_t * dt, bt + angle_d * dt + angle_t * tt
    d_d, d_t = d * dd + by * dt, d * dt + by * tt
    response[BB] += bb + angle_d * (bd + b_d) + angle_t * (bt + b_t)
    response[BD] += d * b_d + by * b_t
    response[BT] += t * b_t
    response[DD] += d * d_d + by * d_t
    response[DT] += t * d_t
    response[TT] += t * t * tt
    response[ANGLE_T] += angle_d * by + angle_t * t
    response[ANGLE_D] += angle_d * d
    response[BY_T] = by * (d + t)
    response[LEFT_D], response[LEFT_T] = d * d, t * t
