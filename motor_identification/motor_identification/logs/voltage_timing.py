"""Find whether a row's voltage held until the row, or holds from there on: no motion answers what has not come yet.

The way to a row's position is predicted from the rows before, their voltages, and its own voltage (ARX; L. Ljung,
System Identification, 1999, 4.2). A voltage that holds from the row on has no part in it, and a controller's that
answers the row's own speed has a negative one. Only a voltage that had come before has a positive part. Voltages that
never jump follow from those before, and tell nothing.
"""

from collections.abc import Iterable

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.recording import Floats

PAST = 3  # rows before, whose motions and voltages predict the next
VOLTAGES = slice(PAST, 2 * PAST)  # their columns
LEAST_ROWS = 24
MOST_ROWS = 200_000  # of a run: as much as is ever needed
JUMP = 0.05  # of the voltages' range: what comes as a surprise by as much tells of its time
TOLD_BY_JUMPS = 0.8  # of the squares of all surprises: smooth voltages leave a model's errors to decide
SIGNIFICANT = 6.0  # standard errors
SHARE = 0.2  # of the answers to the row's own and the strongest other voltage: less is less than half a row's time


def acts_before(runs: Iterable[tuple[Floats, Floats]]) -> bool:
    """Find whether voltages [V] held until their rows, from runs of voltages and speeds, arrays of shape (K,) each.

    Speeds are in any unit: of the row's instant, or means over what was just before.
    """
    rows = [row for voltage, speed in runs if (row := _make_rows(voltage[:MOST_ROWS], speed[:MOST_ROWS])) is not None]
    if not rows:
        return False
    past, own, motion = (np.concatenate(part) for part in zip(*rows, strict=True))
    scale = np.maximum(np.max(np.abs(past), axis=0), 1e-300)
    weights = np.linalg.lstsq(past / scale, np.column_stack([own, motion]), rcond=1e-9)[0]
    surprise, answer = (np.column_stack([own, motion]) - past / scale @ weights).T
    jumps = np.abs(surprise) > JUMP * np.ptp(own)
    squares = surprise**2
    if len(own) < LEAST_ROWS or not squares[jumps].sum() > TOLD_BY_JUMPS * squares.sum():
        return False
    part = float(surprise @ answer) / float(squares.sum())
    left = answer - part * surprise
    # As if all errors were alike, and as they are (White, Econometrica 48, 1980): a few jumps have errors of their own.
    alike = np.sqrt(float(np.mean(left**2)) / float(squares.sum()))
    own_errors = np.sqrt(float(squares @ left**2)) / float(squares.sum())
    others = float(np.max(np.abs(((weights[:, 1] - part * weights[:, 0]) / scale)[VOLTAGES])))
    return bool(part > max(SIGNIFICANT * max(alike, own_errors), SHARE * (part + others)))


def _make_rows(voltage: Floats, speed: Floats) -> tuple[Floats, Floats, Floats] | None:
    """What predicts each row (K − PAST, 2·PAST + 2), its own voltage and its motion; None where rows are too few."""
    if len(voltage) <= 2 * PAST:
        return None
    before, volts = (sliding_window_view(column[:-1], PAST) for column in (speed, voltage))
    constant = np.ones(len(before))
    return np.column_stack([before, volts, np.sign(speed[PAST - 1 : -1]), constant]), voltage[PAST:], speed[PAST:]
