"""Score increments under an error model: the log likelihood that `error_filter.py` gives one row, and nothing else.

A search for the error model asks for it a hundred times, where white residuals are wanted once.
"""

from math import log

import numpy as np

from motor_identification.noise.contaminated_density import LOG_REGULAR, REGULAR, compute_log_density, compute_trust
from motor_identification.noise.error_filter import LONG, respond
from motor_identification.noise.torque_response import (
    ANGLE_D,
    ANGLE_T,
    BY_T,
    LEFT_D,
    LEFT_T,
    RESPONSES,
    TERMS,
    fill_series,
)
from motor_identification.noise.torque_state import (
    Covariance,
    pass_pause,
    propagate,
    stationary_covariance,
    update,
)
from motor_identification.recording import Bools, Floats
from motor_model.compiled import compiled


@compiled
def score_increments(  # noqa: C901
    fresh: Bools,
    still: Bools,
    pause: Floats,
    duration: Floats,
    blur: Floats,
    still_end: Floats,
    own: float,
    alpha: float,
    beta: float,
    strength: float,
    growth: float,
    increments: Floats,
    counted: Bools,
) -> float:
    """Score increments [rad] (I,): the log likelihood of those that are counted; see `run_filter`.

    blur, own: [rad²] of the angle at either end of an interval, what is its own and what all have in common; still_end:
    [rad²] instead, where the motor stood.
    """
    disturbed, noise, fastest = strength > 0.0, 2.0 * beta * strength, max(alpha, beta)
    level = b = d = t = 0.0
    p = stationary_covariance(alpha, beta, strength)
    speed_variance = p.dd
    series, q, over_pause = np.zeros((TERMS, RESPONSES)), np.zeros(RESPONSES), np.zeros(RESPONSES)
    fill_series(alpha, beta, series)
    of_interval, of_pause = -1.0, -1.0  # [s] what the responses are known for
    value, squares, product, regular = 0.0, 0.0, 1.0, 0
    for k in range(len(fresh)):
        h = duration[k]
        if still[k]:
            if counted[k]:
                value += compute_log_density(increments[k], still_end[k] + speed_variance * h * h)
            continue
        end = blur[k] + own
        if fresh[k]:
            if disturbed and not min(alpha, beta) * pause[k] < LONG:
                p, d, t = stationary_covariance(alpha, beta, strength), 0.0, 0.0
            elif disturbed:
                of_pause = respond(series, fastest, pause[k], of_pause, over_pause)
                p, d, t = _wait(p, d, t, over_pause, noise)
            p = Covariance(end, 0.0, 0.0, p.dd, p.dt, p.tt)
            b = level = 0.0
        if disturbed:
            of_interval = respond(series, fastest, h, of_interval, q)
            b += q[ANGLE_D] * d + q[ANGLE_T] * t
            d, t = q[LEFT_D] * d + q[BY_T] * t, q[LEFT_T] * t
            p = propagate(p, q, noise)
        p = Covariance(p.bb + growth * h, p.bd, p.bt, p.dd, p.dt, p.tt)
        variance = p.bb + end
        level += increments[k]
        off = level - b
        square = off * off / variance
        if counted[k] and square < REGULAR:
            squares, product, regular = squares + square, product * variance, regular + 1
            if not 1e-200 < product < 1e200:  # one logarithm for many intervals
                value, product = value - 0.5 * log(product), 1.0
        elif counted[k]:
            value += compute_log_density(off, variance)
        trust = compute_trust(off, variance)
        p, kb, kd, kt = update(p, off, variance, trust, end, (off / h) ** 2 if disturbed else 0.0)
        b, d, t = b + kb * off, d + kd * off, t + kt * off
    return value - 0.5 * (squares + log(product)) + regular * LOG_REGULAR


@compiled
def _wait(p: Covariance, d: float, t: float, response: Floats, noise: float) -> tuple[Covariance, float, float]:
    """Pass a pause: the covariance after it, and what is left of the estimates of speed and torque."""
    d, t = response[LEFT_D] * d + response[BY_T] * t, response[LEFT_T] * t
    return pass_pause(p, response, noise), d, t
