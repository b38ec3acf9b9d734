"""Mark wrong speeds: some that stand far above, or below, those on either side, with no voltage to make them so.

Such as the counts of the time before the first row, or a pulse that the start of a motor makes on an encoder's line. A
motor follows a step of the voltage one way; there and back takes two.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.recording import Bools, Floats
from motor_identification.sensor.value_lattice import find_lattice

LONGEST = 2  # wrong speeds next to each other: more of them are a motion
FAR = 6.0  # times the change that nine of ten samples do not exceed
FAR_SHARE = 0.2  # of the speed that they do not exceed, at least: without noise the smallest change is unusual
USUAL = 0.9
BEFORE = 3  # samples before in which the voltage may have stepped once
MOST = 0.01  # share of the samples: more of them are no accident
SILENT = 3  # rows in which no pulse came, and the time between pulses is written as a speed of 0
DEEP, COUNTS = 6.0, 4.0  # usual changes, and counts, that the speeds before and after are at least
OFTEN = 0.25  # of the rows in motion that may be silent


def mark_wrong_speeds(speed: Floats, voltage: Floats) -> Bools:
    """Mark wrong speeds (K,), under the voltages [V] (K,) that held from each sample on; none where they are many."""
    wrong = np.zeros(len(speed), dtype=bool)
    if len(speed) < 2 or not np.any(speed):
        return wrong
    usual = float(np.quantile(np.abs(np.diff(speed)), USUAL))
    far = max(FAR * usual, FAR_SHARE * float(np.quantile(np.abs(speed), USUAL)))
    for length in range(1, LONGEST + 1):
        size = length + BEFORE + 1  # the samples before, the wrong ones, and the one after
        if len(speed) < size:
            break
        seen, driven = sliding_window_view(speed, size), sliding_window_view(voltage, size)
        inside, beside = seen[:, BEFORE:-1], seen[:, [BEFORE - 1, -1]]
        above = inside.min(axis=1) - beside.max(axis=1) > far
        below = beside.min(axis=1) - inside.max(axis=1) > far
        steps = np.count_nonzero(np.diff(driven[:, :-1], axis=1), axis=1)
        for k in np.flatnonzero((above | below) & (steps <= 1)):
            wrong[k + BEFORE : k + BEFORE + length] = True
    return wrong if np.count_nonzero(wrong) <= max(MOST * len(speed), 1.0) else np.zeros_like(wrong)


def mark_silent_rows(speed: Floats) -> Bools:
    """Mark zeros among speeds (K,) of a motor that runs: rows in which no pulse came; none where they are many.

    Few counts within a window are 0 now and then, and a motor that stands is 0 for longer, or between two ways.
    """
    silent = np.zeros(len(speed), dtype=bool)
    moving = np.flatnonzero(speed)
    beside = np.diff(moving) == 1
    if np.count_nonzero(beside) < BEFORE:
        return silent
    usual = float(np.median(np.abs(np.diff(speed[moving])[beside])))
    levels = np.unique(np.abs(speed[moving]))
    finest = float(np.min(np.diff(levels))) if len(levels) > 1 else float(levels[0])
    least = max(DEEP * usual, COUNTS * find_lattice(speed), COUNTS * finest)
    before, after = moving[:-1], moving[1:]
    alike = np.minimum(speed[before] * np.sign(speed[after]), np.abs(speed[after])) >= least  # above 0, or they differ
    for k in np.flatnonzero((after - before > 1) & (after - before <= SILENT + 1) & alike):
        silent[before[k] + 1 : after[k]] = True
    return silent if np.count_nonzero(silent) <= OFTEN * len(moving) else np.zeros_like(silent)
