"""Bound the eccentricity that a disc has by chance: the first harmonic of slots that are irregular at random."""

from math import sqrt, tau

# Times the standard deviation that random slots give to sine and cosine of their first harmonic: the amplitude has a
# Rayleigh distribution, beyond 5 with a chance of e^-12.5 = 4e-6.
CHANCE_HARMONIC = 5.0
# Of a slot: no disc is known to be more even. Measured: of six slots a first harmonic of 6e-5 of one was named, beside
# which what is left of five offsets was smaller still.
LEAST_SHARE = 1e-4


def bound_chance_eccentricity(slot: float, share: float) -> float:
    """Bound the first harmonic [rad] of slots [rad] that are irregular by a share of one.

    Of N = 2π/slot independent offsets of standard deviation σ, sine and cosine of a harmonic have the variance 2σ²/N.
    """
    return CHANCE_HARMONIC * max(share, LEAST_SHARE) * slot * sqrt(2.0 * slot / tau)
