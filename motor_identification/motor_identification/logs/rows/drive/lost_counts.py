"""Tell of a board that lost counts: the interrupts of its encoder left it no time, and its rows came slower, too."""

import numpy as np

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.rows.drive.unpowered_start import ROWS
from motor_identification.logs.signals import Floats, Signals

WINDOWS = 20  # in which speeds and the times between rows are compared
FALLEN = 0.5  # of the largest speed, to which it fell under the same voltage
SLOWER = 3.0  # times as far apart as until that speed, rows came then


def caution_lost_counts(signals: Signals, form: CsvForm) -> list[str]:
    """Caution of counts that became fewer under the same voltage, while rows came further and further apart.

    Args:
        signals: rows (K,) of a log, in runs.
        form: how they are read.
    """
    if form.kind is Kind.SPEED:
        return []
    found = [
        _compare(
            np.asarray(signals.time[run], dtype=np.float64) * 1e-9, np.abs(signals.voltage[run]), signals.motion[run]
        )
        for run in signals.runs.values()
    ]
    slower = max(found, default=0.0)
    if not slower:
        return []
    return [
        f"Caution: {form.motion} goes on by less than half of what it did under the same voltage, and rows come "
        f"{slower:.2g} times slower by then: a board that was busy with its encoder's edges loses counts. Count them "
        "in hardware, or fewer of them a turn, or turn slower."
    ]


def _compare(time: Floats, volts: Floats, motion: Floats) -> float:
    """How many times slower rows (K,) came at times [s] once the speed had fallen at volts [V]; 0 where it did not."""
    moves = np.flatnonzero(np.diff(motion)) + 1
    changes = np.flatnonzero(np.diff(volts)) + 1
    first = max(int(moves[0]) if len(moves) else len(time), int(changes[-1]) if len(changes) else 0)
    if len(time) - first < ROWS * WINDOWS or volts[-1] == 0.0:
        return 0.0
    edges = np.searchsorted(time, np.linspace(time[first], time[-1], WINDOWS + 1))
    edges[-1] = len(time) - 1
    if np.any(np.diff(edges) < 2):
        return 0.0
    took = np.diff(time[edges])
    speed, period = np.abs(np.diff(motion[edges])) / took, took / np.diff(edges)
    top = int(np.argmax(speed))
    behind = slice(max(top + 1, 3 * WINDOWS // 4), WINDOWS)
    if behind.start == WINDOWS or np.median(speed[behind]) >= FALLEN * speed[top]:
        return 0.0
    slower = float(np.median(period[behind]) / np.median(period[: top + 1]))
    return slower if slower > SLOWER else 0.0
