"""Estimate the white noise of samples: what neighbours do not share, and what neither they nor the voltage predict.

The m-th differences of white noise of variance σ² have the variance (2m over m)·σ²; smooth motion has hardly any, less
with every order, until random motion begins to count. Where the voltage jumps motion is not smooth: a linear prediction
from the samples and voltages before (ARX; L. Ljung, System Identification, 1999, 4.2) is off by the innovation, which
is at least the noise. The least of all of them is nearest to it.
"""

from math import comb, sqrt

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.recording import Bools, Floats

ORDERS = (2, 3, 4)
PAST = 6  # samples and voltages before that predict the next one
KEPT = 0.6  # of the differences, the smallest: reversals, starts and wrong samples are among the rest
KEPT_SHARE = 0.2146  # of a normal distribution's variance, within its KEPT quantile (±0.842 σ)
LEAST_SAMPLES = 24
LEAST_SHARE = 0.05  # of the RMS of values, of what noise is told as a share
LEAST_PREDICTED = 100  # samples from which on a prediction with 2·PAST + 2 numbers is learned


def estimate_white_noise(values: Floats, voltage: Floats, tells: Bools | None = None) -> float:
    """Estimate the standard deviation of white noise in evenly spaced values (K,); 0 where there are too few.

    voltage: [V] that held from each sample until the next, shape (K,). A torque that jumps from sample to sample counts
    as noise. tells: the values whose noise it is, shape (K,); all, without.
    """
    marks = np.ones(len(values), dtype=bool) if tells is None else tells
    found = []
    for order in ORDERS if np.count_nonzero(marks) >= LEAST_SAMPLES else ():
        told = np.all(sliding_window_view(marks, order + 1), axis=1)
        if np.count_nonzero(told) >= LEAST_SAMPLES - order:
            found.append(_trimmed_rms(np.diff(values, n=order)[told]) / sqrt(comb(2 * order, order)))
    if found and len(values) >= LEAST_PREDICTED:
        found.append(_predict(values, voltage, marks))
    return min(found, default=0.0)


def estimate_relative_noise(values: Floats) -> float:
    """Estimate the standard deviation of white noise in evenly spaced values (K,) as a share of each value.

    0 where too few follow each other that are of one sign and more than next to nothing. Of a motor that answers jumps
    of its voltage within a few values, its motion counts as noise, as far as most of them show it.
    """
    found, least = [], LEAST_SHARE * sqrt(float(np.mean(values**2))) if len(values) else 0.0
    for order in ORDERS:
        if len(values) <= order:
            return 0.0
        parts = sliding_window_view(values, order + 1)
        size: Floats = np.abs(np.mean(parts, axis=1))
        tells = (np.all(parts > 0.0, axis=1) | np.all(parts < 0.0, axis=1)) & (size > least)
        differences = np.diff(values, n=order)[tells] / size[tells]
        if len(differences) < LEAST_SAMPLES:
            return 0.0
        found.append(_trimmed_rms(differences) / sqrt(comb(2 * order, order)))
    return min(found)


def _trimmed_rms(values: Floats) -> float:
    """Standard deviation of normal values, without the largest."""
    kept = np.sort(np.abs(values))[: int(KEPT * len(values))]
    return sqrt(float(np.mean(kept**2)) / KEPT_SHARE)


def _predict(values: Floats, voltage: Floats, marks: Bools) -> float:
    """Standard deviation of what a linear prediction from the past leaves of the marked values.

    The voltage in a sample's own row predicts it in logs whose rows hold the voltage until then. Where it is lower the
    higher the sample, it is a controller's answer to that sample, noise and all, and predicts nothing.
    """
    past = sliding_window_view(values[:-1], PAST)
    driven = sliding_window_view(voltage, PAST + 1)[: len(past)]
    columns, target = np.column_stack([np.ones(len(past)), past, driven]), values[PAST:]
    weights = np.linalg.lstsq(columns, target, rcond=1e-10)[0]
    if weights[-1] < 0.0:
        columns = columns[:, :-1]
        weights = np.linalg.lstsq(columns, target, rcond=1e-10)[0]
    return _trimmed_rms((target - columns @ weights)[marks[PAST:]]) * sqrt(
        len(target) / (len(target) - columns.shape[1])
    )
