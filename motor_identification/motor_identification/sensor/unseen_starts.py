"""Mark the zeros before a start that the speeds after it say the motor had begun to move in.

A speed that is made from the times between edges is 0 until two of them have come: where that takes 6 ms, it is as if
something had held the motor for so long. What it gains from row to row after that tells when it began; where a sensor
sees it at once, that is no more than a row before its first speed.
"""

import numpy as np

from motor_identification.recording import Bools, Floats
from motor_identification.sensor.value_lattice import find_lattice

GROWING = 25  # rows after the first speed, at most, in which it doubles: what takes longer is a speed of its own
# Rows before its first speed in which a motor begins that is seen at once: one, and half a row as it bends (0.6 where
# its time constant is two rows).
OWN_ROW = 1.7
COUNTS = 4.0  # of a lattice of counts that the first speed is: few of them are 0 now and then
LEAST_ZEROS = 3  # rows before a start: it stood


def mark_unseen_starts(speed: Floats) -> Bools:
    """Mark the zeros among speeds (K,) in which a motor moved already that starts after them."""
    unseen = np.zeros(len(speed), dtype=bool)
    starts = np.flatnonzero((speed[:-1] == 0.0) & (speed[1:] != 0.0)) + 1
    moving = np.flatnonzero(speed)
    least = COUNTS * find_lattice(speed) if len(starts) else 0.0
    for start in starts:
        before = moving[np.searchsorted(moving, start) - 1] if moving[0] < start else -1
        zeros = int(start - 1 - before)
        if zeros >= LEAST_ZEROS and abs(speed[start]) >= least:
            rows = _find_rows_since_begin(np.sign(speed[start]) * speed[start : start + GROWING + 1])
            unseen[start - min(max(int(rows + 1.0 - OWN_ROW), 0), zeros) : start] = True
    return unseen


def _find_rows_since_begin(speed: Floats) -> float:
    """Find how many rows before the first of some speeds (N,) those began that grow evenly; 0 where they do not."""
    doubled = np.flatnonzero(speed >= 2.0 * speed[0])
    if len(doubled) == 0 or np.any(speed[: doubled[0]] <= 0.0):
        return 0.0
    rows = np.arange(1, doubled[0] + 1)
    return float(speed[0] / np.max((speed[rows] - speed[0]) / rows))
