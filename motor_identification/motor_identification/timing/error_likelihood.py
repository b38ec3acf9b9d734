"""Measure how likely the errors of speeds are that a timing leaves: with heavy tails, and larger the faster it turns.

A slot over a time between edges is off by a share of itself, since the slots are; a count or a tachogenerator by as
much at any speed. So the scale is as they have it: sqrt(1 + (growth · speed)²), of the growths that are tried the
likeliest. Part of an error is that of the row before (AR(1)), and some rows are off by far, which a normal density
would have decide alone: Student's t with four degrees of freedom (K. L. Lange, R. J. A. Little, J. M. G. Taylor,
Robust statistical modeling using the t distribution, JASA 84, 1989), fitted by reweighting.
"""

from math import inf

import numpy as np

from motor_identification.recording import Floats

GROWTHS = (0.0, 0.3, 1.0, 3.0, 10.0)  # of the errors, from rest to the usual speed
FREEDOM = 4.0  # degrees of it
ROUNDS = 20  # of reweighting
LEAST_SCALE = 1e-12  # of the errors' size: below it they are none


def measure_log_likelihood(errors: Floats, speed: Floats) -> float:
    """Measure the log likelihood of errors (K,) [rad/s] at speeds (K,) [rad/s], but for constants of K.

    Minus infinity of fewer than two, or where one is no number: nothing is told by such.
    """
    if len(errors) < 2 or not (np.isfinite(errors).all() and np.isfinite(speed).all()):
        return -inf
    usual = float(np.median(np.abs(speed))) or 1.0
    scales = (np.hypot(1.0, growth * speed / usual) for growth in GROWTHS)
    return max(_measure_alike(errors / scale) - float(np.sum(np.log(scale[1:]))) for scale in scales)


def _measure_alike(errors: Floats) -> float:
    """Log likelihood of errors (K,) of one scale, each with a share of the one before."""
    before, now = errors[:-1], errors[1:]
    least = (LEAST_SCALE * float(np.abs(errors).max())) ** 2 or LEAST_SCALE**2
    weight: Floats = np.ones(len(now))
    left, square = now, 0.0
    for _ in range(ROUNDS):
        share = float((weight * before) @ now) / max(float((weight * before) @ before), least)
        left = now - share * before
        square = max(float(np.mean(weight * left**2)), least)
        weight = (FREEDOM + 1.0) / (FREEDOM + left**2 / square)
    tails = 0.5 * (FREEDOM + 1.0) * float(np.sum(np.log1p(left**2 / square / FREEDOM)))
    return -tails - 0.5 * len(now) * float(np.log(square))
