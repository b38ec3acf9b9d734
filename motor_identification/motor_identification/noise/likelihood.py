"""Compute the likelihood of increments under a model whose parameters and noise were learnt on other data.

If the current model is true, the likelihood ratio of any other model on data that neither has seen exceeds e^k with a
probability of at most e^(−k), whatever the other model is (its expectation is 1; Markov's inequality. V. Vovk, R. Wang,
"E-values", Ann. Stat. 49(3), 2021). That is the stop rule of the diagnosis, and its stated rate of false alarms.

The noise is that of `angle_noise.py`: each edge off by timer and slots (variance R), the simulated angle drifting by
what the model does not know (q a second).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.noise.angle_noise import AngleNoise, log_likelihood_of, make_angle_noise
from motor_identification.noise.noise_grid import NoiseGrid, estimate_drift
from motor_identification.recording import Floats

OUTLIER_CLIP = 25.0  # squared standard deviations beyond which an interval says no more
LEAST_BLUR = 1e-4  # of a slot: no tick is finer than this matters
IRREGULARITIES = (0.0, *(0.05 * 10.0 ** (-0.25 * i) for i in range(17)))  # of a slot
FINE_STEPS = tuple(10.0 ** (0.025 * i) for i in range(-5, 6))  # around the best of those
DRIFTS = tuple(10.0 ** (0.5 * (2 - i)) for i in range(28))  # of the mean square increment per second
ROUNDS = 3  # of drift and irregularity in turns: the two hardly interact


@dataclass(frozen=True)
class Noise:
    """What an encoder and an incomplete model leave."""

    share: float  # standard deviation of the flanks as a share of a slot
    drift: float  # [rad²/s] drift of the simulated angle


def make_noise(data: Intervals, share: float) -> AngleNoise:
    """Make the noise of one recording with a disc that is irregular by a share of a slot."""
    return make_angle_noise(data, share * data.slot, LEAST_BLUR * data.slot + 1e-12)


def log_likelihood(data: Intervals, increments: Floats, noise: Noise) -> float:
    """Compute the log likelihood of the increments [rad] (simulated minus measured) in one recording's intervals.

    Without the constant of the Gaussian.
    """
    return log_likelihood_of(make_noise(data, noise.share), noise.drift, increments, OUTLIER_CLIP)


def estimate_noise(rows: Sequence[tuple[Intervals, Floats]]) -> Noise:
    """Estimate irregularity and drift from several recordings' increments [rad] by maximum likelihood, on a grid."""
    increments = [part for _, part in rows]
    mean = float(np.mean(np.concatenate([part**2 / data.duration for data, part in rows])))
    drifts = [mean * share for share in DRIFTS]

    def noises(share: float) -> list[AngleNoise]:
        return [make_noise(data, share) for data, _ in rows]

    perfect = noises(0.0)
    slots = [np.where(data.slack > 0.0, 0.0, data.slot**2) for data, _ in rows]

    def likeliest(shares: Sequence[float], drift: float) -> float:
        grid = NoiseGrid(np.square(shares), np.full(len(shares), drift))
        return shares[int(np.argmax(grid.score(perfect, slots, increments, OUTLIER_CLIP)))]

    shares = tuple(rows[0][0].unevenness * share for share in IRREGULARITIES) if rows[0][0].slot > 0.0 else (0.0,)
    share, drift = shares[-1], 0.0
    for _ in range(ROUNDS):
        before = share
        drift = estimate_drift(noises(share), increments, drifts, OUTLIER_CLIP)
        share = likeliest(shares, drift)
        if share == before:  # another round would find the same
            break
    if share > 0.0:
        share = likeliest([share * step for step in FINE_STEPS], drift)
    return Noise(share, drift)
