"""Compute the contaminated density of an innovation: an interval may hold an error that no noise makes.

A wrong stamp, an unseen reversal: with a probability of ε the innovation comes from a Cauchy density instead of a
normal one. It is a density, so that likelihood ratios mean what they say; a clipped square is none.
"""

from math import exp, log, pi, sqrt

from motor_model.compiled import compiled

OUTLIERS = 1e-4  # ε: share of intervals whose error is none of the noise
WIDTH = 10.0  # scale of their density, in standard deviations of the others
REGULAR = 9.0  # squared standard deviations up to which the other part is below 1e-4 of a density
LOG_REGULAR = log((1.0 - OUTLIERS) / sqrt(2.0 * pi))  # of a regular one, beside its variance and its square


@compiled
def compute_log_density(off: float, variance: float) -> float:
    """Compute the logarithm of the contaminated density of an innovation [rad] of a variance [rad²]."""
    square = off * off / variance
    regular = -0.5 * (square + log(2.0 * pi * variance))
    if square < REGULAR:
        return regular + log(1.0 - OUTLIERS)
    wide = log(OUTLIERS / (pi * WIDTH)) - 0.5 * log(variance) - log(1.0 + square / (WIDTH * WIDTH))
    regular += log(1.0 - OUTLIERS)
    top = max(regular, wide)
    return top + log(exp(regular - top) + exp(wide - top))


@compiled
def compute_trust(off: float, variance: float) -> float:
    """Compute the probability that an innovation [rad] of a variance [rad²] is regular."""
    square = off * off / variance
    if square < REGULAR:
        return 1.0
    regular = (1.0 - OUTLIERS) * exp(-0.5 * square) / sqrt(2.0 * pi)
    wide = OUTLIERS / (pi * WIDTH * (1.0 + square / (WIDTH * WIDTH)))
    return regular / (regular + wide)
