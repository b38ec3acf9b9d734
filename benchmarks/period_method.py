"""Compute speeds as boards with an interrupt do: one slot over the time between the latest two edges."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def compute_period_speeds(
    time: Floats, angle: Floats, rows: Floats, slot: float, disc: Floats, falls: bool, silence: float
) -> Floats:
    """Compute the speeds [rad/s] that rows show of a motion, shape (R,).

    Args:
        time: [s] of the motion, shape (K,).
        angle: [rad] of the same shape.
        rows: [s] when they are written, shape (R,).
        slot: [rad] that the program takes every slot for.
        disc: of a slot, how far every flank of one turn is off.
        falls: whether the value falls as a slot over the time since the latest edge, where that is longer.
        silence: [s] without an edge after which it is 0, as it is after a turn until there are two edges of one way.
    """
    place = angle / slot
    flank = np.floor(place).astype(np.int64)
    passed = np.diff(flank)
    node = np.repeat(np.arange(len(passed)), np.abs(passed))
    way = np.sign(passed)[node]
    first = np.cumsum(np.abs(passed)) - np.abs(passed)
    number = flank[node] + way * (np.arange(len(node)) - first[node]) + (way > 0)
    share = (number + disc[np.mod(number, len(disc))] - place[node]) / (place[node + 1] - place[node])
    edge = time[node] + np.clip(share, 0.0, 1.0) * (time[node + 1] - time[node])
    edge = np.maximum.accumulate(edge)
    period = np.diff(edge, prepend=-np.inf)
    along = np.append(False, way[1:] == way[:-1])
    latest = np.searchsorted(edge, rows, side="right") - 1
    known = latest >= 0
    at = np.maximum(latest, 0)
    since = rows - edge[at]
    shown = np.maximum(period[at], since) if falls else period[at]
    good = known & along[at] & (since < silence) & (shown > 0.0)
    return np.divide(way[at] * slot, shown, out=np.zeros(len(rows)), where=good)
