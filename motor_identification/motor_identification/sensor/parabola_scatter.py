"""Measure how far a motion lies beside a parabola through a few rows: what its times, or their noise, leave of it."""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.recording import Floats

WINDOW = 7  # rows that a parabola is laid through
PARABOLA = 3  # terms of one
# Steps a row, at most, at which sums of counts tell: a row's uneven length is then a small part of one. And so many
# windows at least, of which the jerkiest are left out.
SLOW, LEAST_WINDOWS, KEPT = 3.0, 20, 0.8
# Steps a row by which speeds change within a window at most: what gains or loses speed bends by more than a parabola.
# Measured: 1 to 38 steps squared of simulated counts at 100 Hz, whose motor of 20 to 100 ms is told another speed
# every 100 to 300 ms; 0.07 and less where it is even.
CALM, END = 2.0, 3  # and rows at either end of a window
# Windows, as many of either kind as may have no row in common twice, of which the calmer half tells where it leaves far
# more than counts can: those are off by half a one at most, which is 0.44. Measured: of 600 simulated logs 2 more of
# counts came to it (18 for 16), and of tachogenerators with noise of 1.5 to 7 steps two thirds instead of half.
FEW_WINDOWS, CALMER, BEYOND_COUNTS = 7, 0.5, 0.8


def measure_scatter(time: Floats, motion: Floats, terms: int = PARABOLA) -> Floats:
    """Measure what parabolas over time [s] through windows of rows leave of a motion (K,), squared; shape (K − 6,).

    terms: of the polynomial, where it is another one than a parabola.
    """
    times, values = (sliding_window_view(column, WINDOW) for column in (time, motion))
    return np.asarray(np.sum(subtract_parabolas(times, values, terms) ** 2, axis=1))


def subtract_parabolas(times: Floats, values: Floats, terms: int = PARABOLA) -> Floats:
    """Subtract from every window of values what a parabola over its times [s] takes of them; all of shape (W, 7).

    terms: as for `measure_scatter`.
    """
    span = np.ptp(times, axis=1)
    scaled = (times - times.mean(axis=1, keepdims=True)) / np.where(span > 0.0, span, 1.0)[:, None]
    basis = np.linalg.qr(scaled[:, :, None] ** np.arange(terms))[0]
    return np.asarray(values - np.einsum("wik,wjk,wj->wi", basis, basis, values))


def measure_summed(values: Floats, step: float) -> float:
    """Measure what sums of values (K,), in steps, leave of parabolas while they are even, squared and for each freedom.

    Counts that are summed up are a position to one of them: about a twelfth. Noise that is summed up walks away. 0
    where too few are even. The less of what is left at a few steps a row, and at more.
    """
    if len(values) < WINDOW:
        return 0.0
    sums = np.cumsum(values / step)
    left = measure_scatter(np.arange(len(sums), dtype=np.float64), sums) / (WINDOW - 3)
    travel = np.abs(sums[WINDOW - 1 :] - sums[: 1 - WINDOW]) / (WINDOW - 1)
    ends = sliding_window_view(values / step, WINDOW)
    calm = (np.abs(ends[:, -END:].mean(axis=1) - ends[:, :END].mean(axis=1)) <= CALM) & (left > 0.0)
    slow, fast = (np.sort(left[calm & some]) for some in (travel <= SLOW, travel > SLOW))
    if min(len(slow), len(fast)) >= LEAST_WINDOWS:
        return min(float(np.mean(some[: int(KEPT * len(some))])) for some in (slow, fast))
    if min(len(slow), len(fast)) < FEW_WINDOWS or len(slow) + len(fast) < LEAST_WINDOWS:
        return 0.0
    least = min(float(np.mean(some[: int(CALMER * len(some))])) for some in (slow, fast))
    return least if least > BEYOND_COUNTS else 0.0
