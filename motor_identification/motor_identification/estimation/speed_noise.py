"""Learn the white noise of logged speeds from what a fit leaves, where that is less than was assumed.

What neighbours do not share, and what their past does not predict (`sensor/white_noise.py`), is noise and motion: an
upper bound, far above the noise where rows are as slow as the motor. A model that leaves less has shown so: the noise
is at most what is left, and its maximum likelihood is the RMS of that, with the degrees of freedom that the unknowns
took (profile likelihood; Y. Pawitan, In All Likelihood, 2001, 3.4). One that leaves more lacks something, which says
nothing of the sensor.
"""

from dataclasses import replace
from math import sqrt

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.sensor.white_noise import LEAST_SAMPLES

LEAST_SHARE = 1e-3  # of what was assumed: the least noise that is learned


def measure_noise(estimate: Estimate) -> float:
    """Measure what an estimate leaves of speeds, as a share of the white noise that was assumed of them.

    1 at most; and where nothing was assumed, or speeds are too few to tell. Two intervals are worth the square root of
    two of them: what is left of one recording alone does not tell its own noise from another's.
    """
    rows = zip(estimate.problem.intervals, estimate.increments, strict=True)
    squares, counts = zip(*(data.sum_noise(part) for data, part in rows), strict=True)
    freedom = sum(counts) - len(estimate.theta)
    return float(np.clip(sqrt(sum(squares) / freedom), LEAST_SHARE, 1.0)) if freedom >= LEAST_SAMPLES else 1.0


def learn_noise(estimate: Estimate) -> Estimate:
    """Learn the noise of logged speeds from what an estimate leaves: the same estimate, of speeds that are so noisy."""
    return set_noise(estimate, measure_noise(estimate))


def set_noise(estimate: Estimate, share: float) -> Estimate:
    """Set the noise of logged speeds to a share of what was assumed: the same estimate, of speeds that are so noisy."""
    intervals = estimate.problem.intervals
    if all(data.learned == share for data in intervals if data.has_assumed_noise):
        return estimate
    return estimate.on(replace(estimate.problem, intervals=tuple(data.with_noise(share) for data in intervals)))
