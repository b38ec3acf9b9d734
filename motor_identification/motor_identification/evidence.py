"""Evidence: how likely held-out data are under a model whose parameters and noise were learnt on other data.

If the current model is true, the likelihood ratio of any other model on data that neither has seen exceeds e^k with a
probability of at most e^(−k), whatever the other model is (its expectation is 1; Markov's inequality. V. Vovk, R. Wang,
"E-values", Ann. Stat. 49(3), 2021). That is the stop rule of the diagnosis, and its stated rate of false alarms.

The noise is that of `noise.py`: each edge off by timer and slots (variance R), the simulated angle drifting by what the
model does not know (q a second).
"""

from dataclasses import dataclass
from math import log

import numpy as np

from motor_identification.intervals import Intervals
from motor_identification.recording import Bools, Floats
from motor_model.compiled import compiled

CLIP = 25.0  # squared standard deviations beyond which an interval says no more: an outlier must not decide
SLACK_BLUR = 0.05  # of a slot: how sharply a standing motor contradicts a simulated one that moves
SHARES = (0.0, *(0.05 * 10.0 ** (-0.25 * i) for i in range(17)))  # of a slot: irregularity
DECADES = 28  # half decades of growth


@dataclass(frozen=True)
class Noise:
    """What an encoder and an incomplete model leave."""

    share: float  # standard deviation of the flanks as a share of a slot
    growth: float  # [rad²/s] drift of the simulated angle


@compiled
def _log_likelihood(
    fresh: Bools, start: Floats, end: Floats, duration: Floats, growth: float, increments: Floats, clip: float
) -> float:
    """Of increments [rad] with variances [rad²] of the angle at both ends; without the constant of the Gaussian."""
    total, variance, carried = 0.0, 0.0, 0.0
    for k in range(len(fresh)):
        if fresh[k]:
            variance, carried = start[k], 0.0
        predicted = variance + growth * duration[k]
        spread = predicted + end[k]
        innovation = increments[k] + carried
        total -= 0.5 * (min(innovation * innovation / spread, clip) + np.log(spread))
        gain = predicted / spread
        variance = gain * end[k]
        carried = (1.0 - gain) * innovation
    return total


def log_likelihood(data: Intervals, increments: Floats, noise: Noise) -> float:
    """Of the increments [rad] (simulated minus measured) that a model leaves in one recording's intervals."""
    slot = noise.share * data.slot
    still = data.slack > 0.0
    tick = np.maximum(data.blur, 1e-4 * data.slot + 1e-12)
    variance = tick**2 + slot**2
    end = np.where(still, (SLACK_BLUR * data.slack) ** 2, variance)
    start = np.where(still, 0.0, variance)
    return float(
        _log_likelihood(data.fresh, start, end, data.duration, noise.growth, np.ascontiguousarray(increments), CLIP)
    )


def likely_noise(rows: list[tuple[Intervals, Floats]]) -> Noise:
    """The noise under which the increments [rad] of several recordings' intervals are most likely, on a grid."""
    mean = float(np.mean(np.concatenate([increments**2 / data.duration for data, increments in rows])))
    growths = [0.0, *(mean * 10.0 ** (0.5 * (2 - i)) for i in range(DECADES))]

    def likelihood(noise: Noise) -> float:
        price = log(sum(len(increments) for _, increments in rows) + 1.0) * (noise.growth > 0.0)
        return sum(log_likelihood(data, increments, noise) for data, increments in rows) - price

    shares = SHARES if rows[0][0].slot > 0.0 else (0.0,)
    best = Noise(shares[-1], 0.0)
    for _ in range(3):  # one after the other: the two hardly interact
        best = max((Noise(best.share, growth) for growth in growths), key=likelihood)
        best = max((Noise(share, best.growth) for share in shares), key=likelihood)
    finer = (Noise(best.share * 10.0 ** (0.025 * i), best.growth) for i in range(-5, 6))
    return max(finer, key=likelihood) if best.share > 0.0 else best
