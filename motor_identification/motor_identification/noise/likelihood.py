"""Evidence: how likely held-out data are under a model whose parameters and noise were learnt on other data.

If the current model is true, the likelihood ratio of any other model on data that neither has seen exceeds e^k with a
probability of at most e^(−k), whatever the other model is (its expectation is 1; Markov's inequality. V. Vovk, R. Wang,
"E-values", Ann. Stat. 49(3), 2021). That is the stop rule of the diagnosis, and its stated rate of false alarms.

The noise is that of `noise.py`: each edge off by timer and slots (variance R), the simulated angle drifting by what the
model does not know (q a second).
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from math import log

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.noise.angle_noise import AngleNoise, surprise
from motor_identification.recording import Floats

CLIP = 25.0  # squared standard deviations beyond which an interval says no more
SLACK_BLUR = 0.05  # of a slot: how sharply a standing motor contradicts a simulated one that moves
SHARES = (0.0, *(0.05 * 10.0 ** (-0.25 * i) for i in range(17)))  # of a slot: irregularity
DECADES = 28  # half decades of growth


@dataclass(frozen=True)
class Noise:
    """What an encoder and an incomplete model leave."""

    share: float  # standard deviation of the flanks as a share of a slot
    growth: float  # [rad²/s] drift of the simulated angle


def angle_noise(data: Intervals, share: float) -> AngleNoise:
    """What timer and irregular slots (a share of a slot) leave at both ends of one recording's intervals."""
    still = data.slack > 0.0
    tick = np.maximum(data.blur, 1e-4 * data.slot + 1e-12)
    variance = tick**2 + (share * data.slot) ** 2
    end = np.where(still, (SLACK_BLUR * data.slack) ** 2, variance)
    return AngleNoise(data.fresh, np.where(still, 0.0, variance), end, data.duration)


def log_likelihood(data: Intervals, increments: Floats, noise: Noise) -> float:
    """Of the increments [rad] (simulated minus measured) that a model leaves in one recording's intervals.

    Without the constant of the Gaussian.
    """
    return _of_increments(angle_noise(data, noise.share), noise.growth, np.ascontiguousarray(increments))


def _of_increments(noise: AngleNoise, growth: float, increments: Floats) -> float:
    squares, logarithms = surprise(noise.fresh, noise.start, noise.end, noise.duration, growth, increments, CLIP)
    return -0.5 * float(squares + logarithms)


def likely_noise(rows: list[tuple[Intervals, Floats]]) -> Noise:
    """The noise under which the increments [rad] of several recordings' intervals are most likely, on a grid."""
    mean = float(np.mean(np.concatenate([increments**2 / data.duration for data, increments in rows])))
    growths = [0.0, *(mean * 10.0 ** (0.5 * (2 - i)) for i in range(DECADES))]

    def ends(share: float) -> list[AngleNoise]:
        return [angle_noise(data, share) for data, _ in rows]

    def likelihood(noises: list[AngleNoise], growth: float) -> float:
        price = log(sum(len(increments) for _, increments in rows) + 1.0) * (growth > 0.0)
        pairs = zip(noises, rows, strict=True)
        return sum(_of_increments(noise, growth, increments) for noise, (_, increments) in pairs) - price

    def likely_share(shares: Iterable[float], growth: float) -> float:
        return max(shares, key=lambda share: likelihood(ends(share), growth))

    shares = SHARES if rows[0][0].slot > 0.0 else (0.0,)
    share, growth = shares[-1], 0.0
    for _ in range(3):  # one after the other: the two hardly interact
        growth = max(growths, key=partial(likelihood, ends(share)))
        share = likely_share(shares, growth)
    if share > 0.0:
        share = likely_share([share * 10.0 ** (0.025 * i) for i in range(-5, 6)], growth)
    return Noise(share, growth)
