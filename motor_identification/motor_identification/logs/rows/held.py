"""Rows that show a new value: a slow sensor in a fast log repeats each of its values."""

import numpy as np

from motor_identification.logs.signals import Floats, Integers
from motor_identification.sensor.held_samples import find_frames


def find_fresh_rows(time: Integers, values: Floats) -> tuple[Integers, float]:
    """Rows (F,) of a run that are the first of a value's, and the sensor's period [s]; all rows and 0 if none is held.

    Args:
        time: [ns] of the rows, shape (K,).
        values: of the same shape.
    """
    frames = find_frames(np.asarray((time - time[0]) * 1e-9, dtype=np.float64), np.asarray(values, dtype=np.float64))
    if frames is None:
        return np.arange(len(time)), 0.0
    return np.unique(np.concatenate(([0], frames.row))), frames.period
