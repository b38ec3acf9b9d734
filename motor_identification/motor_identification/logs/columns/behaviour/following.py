"""Tell whether one column moves as another one drives it."""

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.motion.movement import guess_kind
from motor_identification.logs.correlation import correlate
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import Kind

Floats = NDArray[np.float64]

ANSWERS, UNANSWERED = 0.6, 0.2  # share of what moves that a drive explains, and of a drive that what moves does
FEWEST_STEPS = 50  # of two columns that tell it
WITH_DRIVE = 0.8  # correlation of a motor's speed, or of its way, with what drives it and others


def follows(table: Table, motion: str, drive: str) -> bool:
    """Whether one column moves as another drives it, by a first-order motor, and not the other way round."""
    moves, drives_it = table.numbers(motion), table.numbers(drive)
    if len(moves) < FEWEST_STEPS:
        return False
    return _explained(moves, drives_it) > ANSWERS and _explained(drives_it, moves) < UNANSWERED


def is_speed_by_drive(values: Floats, drive: Floats) -> bool:
    """Whether a motion goes with its drive and forgets what was, as no angle does. Both of shape (K,)."""
    return guess_kind(values, drive) is Kind.SPEED and correlate(values, drive) > WITH_DRIVE


def _explained(values: Floats, by: Floats) -> float:
    """The share of a column's steps that its values and another one's before and after each of them explain."""
    with np.errstate(over="ignore", invalid="ignore"):  # a column of anything
        steps = np.diff(values)
    size = float(np.max(np.abs(steps), initial=0.0))
    if not 0.0 < size < np.inf:
        return 0.0
    scaled = [column / max(float(np.max(np.abs(column))), 1e-300) for column in (values[:-1], by[:-1], by[1:])]
    known = np.column_stack([*scaled, np.ones(len(steps))])
    rest = steps / size - known @ np.linalg.lstsq(known, steps / size, rcond=None)[0]
    variance = float(np.var(steps / size))
    return 1.0 - float(np.var(rest)) / variance if variance > 0.0 else 0.0
