"""Measure how far a motion lies beside a parabola through a few rows: what its times, or their noise, leave of it."""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.recording import Floats

WINDOW = 7  # rows that a parabola is laid through


def measure_scatter(time: Floats, motion: Floats) -> Floats:
    """Measure what parabolas over time [s] through windows of rows leave of a motion (K,), squared; shape (K − 6,)."""
    times, values = (sliding_window_view(column, WINDOW) for column in (time, motion))
    return np.asarray(np.sum(subtract_parabolas(times, values) ** 2, axis=1))


def subtract_parabolas(times: Floats, values: Floats) -> Floats:
    """Subtract from every window of values what a parabola over its times [s] takes of them; all of shape (W, 7)."""
    span = np.ptp(times, axis=1)
    scaled = (times - times.mean(axis=1, keepdims=True)) / np.where(span > 0.0, span, 1.0)[:, None]
    basis = np.linalg.qr(scaled[:, :, None] ** np.arange(3))[0]
    return np.asarray(values - np.einsum("wik,wjk,wj->wi", basis, basis, values))
