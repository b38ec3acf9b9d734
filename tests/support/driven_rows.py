"""Rows of a driven motor as an import reads them, one each 10 ms, and a drive that changes every ten of them."""

from pathlib import Path

import numpy as np

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.signals import Floats, Signals

LEVELS = np.tile([2.0, 5.0, 1.0, 4.0], 30)  # V, for ten rows each
SPEED = CsvForm("t", "u", "y", Kind.SPEED, "rad/s")


def logged(volts: Floats, motion: Floats) -> Signals:
    """One run of so many rows."""
    count = len(volts)
    unknown, time = np.full(count, np.nan), np.arange(count) * 10_000_000
    return Signals(Path("log.csv"), np.arange(count), time, volts, motion, unknown, unknown, {"": slice(0, count)})
