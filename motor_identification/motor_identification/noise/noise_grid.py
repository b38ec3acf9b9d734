"""Score increments under many noises at once: each step of `angle_noise.py`'s filter is one for all of them.

A grid of noises is searched for every model. One noise after the other, each step waits for the one before it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, log

import numpy as np

from motor_identification.noise.angle_noise import AngleNoise
from motor_identification.recording import Bools, Floats
from motor_model.compiled import compiled

FOLD, LEAST, MOST = 8, 1e-100, 1e100  # intervals after which a product of variances is looked at, and may be taken


@dataclass(frozen=True)
class NoiseGrid:
    """C noises: a variance more [rad²] of the angle at the ends of intervals, and a drift [rad²/s]; shape (C,) each."""

    variance: Floats
    drift: Floats

    def score(
        self, noises: Sequence[AngleNoise], moving: Sequence[Floats], increments: Sequence[Floats], clip: float
    ) -> Floats:
        """Compute the log likelihoods (C,) of several recordings' increments [rad] (I,); see `log_likelihood_of`.

        moving: 1.0 at the intervals whose ends have the variance more, else 0.0, shape (I,) each.
        """
        scores = np.zeros(len(self.drift))
        for noise, marks, part in zip(noises, moving, increments, strict=True):
            add_scores(
                noise.fresh, noise.start, noise.end, noise.duration, marks, self.variance, self.drift,
                np.ascontiguousarray(part), clip, scores,
            )  # fmt: skip
        return scores


def estimate_drift(
    noises: Sequence[AngleNoise], increments: Sequence[Floats], grid: Sequence[float], clip: float = inf
) -> float:
    """Estimate the drift q [rad²/s] of the simulated angle by maximum likelihood on a grid; 0 where none is needed.

    A drift has to be worth its price, the logarithm of the number of intervals (as in the Bayesian information
    criterion). Noises and increments [rad] are of every recording.
    """
    drifts = np.array([0.0, *grid])
    nothing = [np.zeros(len(part)) for part in increments]
    scores = NoiseGrid(np.zeros(len(drifts)), drifts).score(noises, nothing, increments, clip)
    price = log(sum(map(len, increments)) + 1.0)
    return float(drifts[np.argmax(scores - price * (drifts > 0.0))])


@compiled
def add_scores(
    fresh: Bools,
    start: Floats,
    end: Floats,
    duration: Floats,
    moving: Floats,
    more: Floats,
    drift: Floats,
    increments: Floats,
    most: float,
    scores: Floats,
) -> None:
    """Add the log likelihoods (C,) of one recording's increments [rad] (I,) to scores; see `score_innovations`."""
    count = len(drift)
    variance, carried, squares = np.zeros(count), np.zeros(count), np.zeros(count)
    logarithms, product = np.zeros(count), np.ones(count)
    for k in range(len(fresh)):
        h, step, own, share = duration[k], increments[k], end[k], moving[k]
        if fresh[k]:
            for c in range(count):
                variance[c], carried[c] = start[k] + more[c] * share, 0.0
        for c in range(count):
            last = own + more[c] * share
            predicted = variance[c] + drift[c] * h
            total = predicted + last
            innovation = step + carried[c]
            kept = last / total
            squares[c] += min(innovation * innovation / total, most)
            product[c] *= total
            variance[c] = predicted * kept
            carried[c] = kept * innovation
        if k % FOLD == 0:
            for c in range(count):
                if not LEAST < product[c] < MOST:
                    logarithms[c] += np.log(product[c])
                    product[c] = 1.0
    for c in range(count):
        scores[c] -= 0.5 * (squares[c] + (logarithms[c] + np.log(product[c])))
