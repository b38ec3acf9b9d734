"""Estimate the gain of every run: a supply that differs from run to run, more or less, as all runs of a battery do.

The travel of a run is 1 + δ times what the motor would do under the voltages that were logged, and δ is none of the
motor: a nuisance of each run with a normal prior of a standard deviation s that all runs have in common. Around its
most likely value the likelihood without it is Laplace's (exact where everything is normal),

    log p(e) = log p(e − δ a) − δ²/2s² − log(1 + s² |g|²)/2

with increments e, the travel a that a gain of 1 adds, and g what the filter makes of a. White residuals lose √ of it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import log, sqrt

import numpy as np

from motor_identification.recording import Floats

FEWEST_RUNS = 5  # from which on the scatter of their gains is more than a guess
# Of a supply from run to run, as a standard deviation: a lithium cell from full to empty, 4.2 to 3.0 V, is spread by
# 0.1. Measured: 0.01 to 0.03 of batteries; 0.44 of a real motor that a dead zone held in some of its runs, and whose
# speed stayed the same from 90 % of the duty on.
MOST_SCATTER = 0.15
USUAL_SCATTER = 0.02  # the mean of what gains scatter by, of an exponential prior; as above
ONE_IN_A_HUNDRED = 2.326  # standard deviations below the mean of a normal distribution


@dataclass(frozen=True)
class RunGain:
    """How far the gain of a run is from that of all, and what is known of it."""

    deviation: float  # δ
    information: float  # |g|²

    def compute_price(self, scatter: float) -> float:
        """Compute what it costs in log likelihood under a prior of that standard deviation."""
        return 0.5 * (self.deviation / scatter) ** 2 + 0.5 * log(1.0 + scatter**2 * self.information)

    def second_moment(self, scatter: float) -> float:
        """Compute the mean square of δ after the run was seen."""
        return self.deviation**2 + 1.0 / (self.information + scatter**-2)


def guess_deviation(increments: Floats, response: Floats) -> float:
    """Guess δ by least squares from increments [rad] and the travel [rad] that a gain of 1 adds, both (I,).

    Of the angles that they add up to, of which a sensor's error is the least part: from increments alone a guess would
    be as far off as makes the filter take whole runs for outliers.
    """
    angle, added = np.cumsum(increments), np.cumsum(response)
    angle, added = angle - angle.mean(), added - added.mean()
    power = float(added @ added)
    return float(added @ angle) / power if power > 0.0 else 0.0


def move_to_likeliest(guess: float, white: Floats, response: Floats, scatter: float) -> RunGain:
    """Move a guess of δ to where it is most likely.

    white: residuals (I,) of increments less what the guess adds. response: whitened, of a gain of 1, shape (I,).
    """
    information, prior = float(response @ response), scatter**-2
    step = (float(response @ white) - guess * prior) / (information + prior)
    return RunGain(guess + step, information)


def make_projection(response: Floats, scatter: float) -> Floats:
    """Make p (I,) of a whitened response g (I,): w − p (p·w) is white where w has a gain of its own.

    (1 + s² g gᵀ) to the power of −1/2 is 1 − p pᵀ.
    """
    power = float(response @ response)
    if power == 0.0:
        return np.zeros_like(response)
    return np.asarray(response * sqrt((1.0 - 1.0 / sqrt(1.0 + scatter**2 * power)) / power))


def price_scatter(scatter: float) -> float:
    """Compute what a scatter of gains costs in log likelihood: the larger, the less it is that of a supply.

    Measured: 0.15 of six runs hid a friction and an asymmetry beside which they scatter by 0.016, in kv by 27 %.
    """
    return scatter / USUAL_SCATTER


def goes_smoothly(values: Floats) -> bool:
    """Decide whether values (N,) differ from one to the next by less than values in any order do, in 99 of 100 cases.

    By the ratio of mean squares of both (J. von Neumann, Ann. Math. Stat. 12(4), 1941), as normal as it is of many.
    """
    squares, count = float(np.sum((values - np.mean(values)) ** 2)), len(values)
    if squares == 0.0:
        return False
    least = 2.0 * (1.0 - ONE_IN_A_HUNDRED * sqrt((count - 2) / (count**2 - 1)))
    return float(np.sum(np.diff(values) ** 2)) / squares < least


def estimate_scatter(gains: Sequence[RunGain], scatter: float) -> float:
    """Estimate the standard deviation of the gains anew from one: a step of expectation maximisation."""
    return sqrt(float(np.mean([gain.second_moment(scatter) for gain in gains])))
