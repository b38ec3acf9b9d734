"""Whiten angle increments with a scalar Kalman filter: what the encoder leaves, as residuals of variance 1.

Two successive intervals share an edge, so that their errors are correlated: what one gains the other loses. Seen from
the angle there is no such thing. Along a run of intervals the simulated angle minus the measured one is

    e_k = b_k + n_k,   n_k ~ R_k (timer tick, irregular slots),   b_{k+1} = b_k + w_k,   w_k ~ q·Δt_k

with b the offset that a run starts with and that grows by what the model does not know (q, 0 for a perfect model). A
scalar Kalman filter over the increments d_k = e_k − e_{k−1} gives innovations ν_k with variance S_k; ν/√S is white:

    ν_k = (1 − K_{k−1}) ν_{k−1} + d_k,   S_k = P_{k−1} + q·Δt_k + R_k,   K_k = 1 − R_k/S_k,   P_k = K_k R_k

For q = 0 this is least squares on the angle with a free offset for every run, for large q on the mean speeds; the two
ways to fit an encoder are the ends of one. Being linear, the filter is applied to Jacobians as well.
"""

from dataclasses import dataclass
from math import inf

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Bools, Floats
from motor_model.compiled import compiled

STANDSTILL_BLUR = 0.05  # of a slot: how sharply a standing motor contradicts a simulated one that moves


@dataclass(frozen=True)
class AngleNoise:
    """Variances of the measured angle in increments over I intervals; arrays of shape (I,).

    `fresh` marks where a run begins: an interval that does not start where the one before it ended.
    """

    fresh: Bools
    start: Floats  # [rad²] of the angle at an interval's start, used where a run begins
    end: Floats  # [rad²] of the angle at its end
    duration: Floats  # [s]


def make_angle_noise(data: Intervals, flank_sigma: float, least_blur: float) -> AngleNoise:
    """Make the noise of one recording's angles from timer tick (or sampling) and irregular flanks.

    flank_sigma: [rad] standard deviation of the flanks. least_blur: [rad] the tick's share where the encoder claims to
    have none.
    """
    still = data.slack > 0.0
    variance = np.maximum(data.blur, least_blur) ** 2 + flank_sigma**2
    end = np.where(still, (STANDSTILL_BLUR * data.slack) ** 2, variance)
    return AngleNoise(data.fresh, np.where(still, 0.0, variance), end, data.duration)


@dataclass(frozen=True)
class Whitening:
    """The filter's gains and scales for one noise; apply it with `whiten`. Arrays of shape (I,)."""

    fresh: Bools
    gain: Floats
    scale: Floats  # [1/rad] 1/√S


@compiled
def fill_gains(
    fresh: Bools, start: Floats, end: Floats, duration: Floats, drift: float, gain: Floats, scale: Floats
) -> None:
    """Fill Kalman gains K and 1/√S of every interval; `drift` is q [rad²/s]."""
    variance = 0.0
    for k in range(len(fresh)):
        if fresh[k]:
            variance = start[k]
        predicted = variance + drift * duration[k]
        total = predicted + end[k]
        gain[k] = predicted / total
        scale[k] = 1.0 / np.sqrt(total)
        variance = gain[k] * end[k]


@compiled
def score_innovations(
    fresh: Bools, start: Floats, end: Floats, duration: Floats, drift: float, increments: Floats, most: float
) -> tuple[float, float]:
    """Sum ν²/S and ln S of increments [rad] under a drift q [rad²/s]: minus twice their logarithmic likelihood.

    No interval adds more than `most` to the first: an outlier must not decide.
    """
    squares, logarithms, product = 0.0, 0.0, 1.0
    variance, carried = 0.0, 0.0
    for k in range(len(fresh)):
        predicted = (start[k] if fresh[k] else variance) + drift * duration[k]
        total = predicted + end[k]
        innovation = increments[k] + (0.0 if fresh[k] else carried)
        squares += min(innovation * innovation / total, most)
        product *= total  # one logarithm for several intervals
        if not 1e-200 < product < 1e200:
            logarithms, product = logarithms + np.log(product), 1.0
        share = end[k] / total
        variance, carried = predicted * share, share * innovation
    return squares, logarithms + np.log(product)


@compiled
def fill_white(fresh: Bools, gain: Floats, scale: Floats, increments: Floats, white: Floats) -> None:
    """Fill whitened innovations of increments [rad]."""
    carried = 0.0
    for k in range(len(fresh)):
        innovation = increments[k] + (0.0 if fresh[k] else carried)
        white[k] = innovation * scale[k]
        carried = (1.0 - gain[k]) * innovation


@compiled
def fill_adjoint(fresh: Bools, gain: Floats, scale: Floats, white: Floats, increments: Floats) -> None:
    """Fill what the transpose of `fill_white` makes of them."""
    carried = 0.0
    for k in range(len(fresh) - 1, -1, -1):
        increments[k] = scale[k] * white[k] + carried
        carried = 0.0 if fresh[k] else (1.0 - gain[k - 1]) * increments[k]


def make_whitening(noise: AngleNoise, drift: float) -> Whitening:
    """Make the filter for a noise and a drift q [rad²/s] of what the model does not know."""
    gain, scale = np.empty(len(noise.fresh)), np.empty(len(noise.fresh))
    fill_gains(noise.fresh, noise.start, noise.end, noise.duration, drift, gain, scale)
    return Whitening(noise.fresh, gain, scale)


def whiten(whitening: Whitening, increments: Floats) -> Floats:
    """Whiten angle increments [rad] (I,): residuals of unit variance, shape (I,)."""
    white = np.empty(len(increments))
    fill_white(whitening.fresh, whitening.gain, whitening.scale, np.ascontiguousarray(increments), white)
    return white


def whiten_adjoint(whitening: Whitening, white: Floats) -> Floats:
    """Apply the transpose of `whiten`, shape (I,) → (I,)."""
    increments = np.empty(len(white))
    fill_adjoint(whitening.fresh, whitening.gain, whitening.scale, np.ascontiguousarray(white), increments)
    return increments


def log_likelihood_of(noise: AngleNoise, drift: float, increments: Floats, clip: float = inf) -> float:
    """Compute the log likelihood of increments [rad] (I,) under a drift q [rad²/s], without the Gaussian's constant.

    The likelihood of a Gaussian process from its innovations (Schweppe, IEEE Trans. Inf. Theory 11, 1965); no interval
    counts with more than `clip` squared standard deviations.
    """
    squares, logarithms = score_innovations(
        noise.fresh, noise.start, noise.end, noise.duration, drift, np.ascontiguousarray(increments), clip
    )
    return -0.5 * float(squares + logarithms)
