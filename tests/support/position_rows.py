"""Rows of a log with positions, 10 ms apart under 5 V."""

from pathlib import Path

import numpy as np

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.signals import Floats, Signals


def form(unit: str) -> CsvForm:
    return CsvForm("t", "u", "y", Kind.POSITION, unit)


def rows(motion: Floats) -> Signals:
    count = len(motion)
    unknown, time = np.full(count, np.nan), np.arange(count) * 10_000_000
    volts = np.full(count, 5.0)
    return Signals(
        Path("log.csv"), np.arange(2, count + 2), time, volts, motion, unknown, unknown, {"": slice(0, count)}
    )
