"""Find the position among two columns of which one is the other's derivative."""

from collections.abc import Sequence
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.correlation import correlate
from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError

Floats = NDArray[np.float64]

INTEGRAL = 0.9  # correlation of a position's steps with its speed, both over some rows, as one row is coarse
SAME_UNITS, BESIDE_ITS_WAY = 0.05, 0.2  # of the way: a position in degrees beside its speed in degrees a second
PARTS, FEWEST_PARTS = 40, 5  # of a log, over which they are compared


def find_position(table: Table, names: Sequence[str], time: str | None) -> str:
    """The position among two columns of which one is the other's derivative; empty where that is not so.

    Without a column of times rows are taken for regular.
    """
    steps = np.ones(len(table)) if time is None else np.diff(_read_times(table, time), append=np.nan)
    steps[~(steps >= 0.0)] = 0.0  # where time begins again
    changing = {name for name in names if np.any(table.numbers(name) != table.numbers(name)[0])}  # no drive that stays
    able = [(one, other) for one, other in permutations(names, 2) if other in changing]
    for agreement in (correlate_ways, _is_integral):  # the second where a steady motor's ways are all alike
        pairs = {pair: agreement(table, *pair, steps) for pair in able}
        best = max(pairs, key=lambda pair: pairs[pair], default=("", ""))
        if pairs.get(best, 0.0) > INTEGRAL:
            return best[0]
    return ""


def _read_times(table: Table, time: str) -> Floats:
    """A column of times, numbers or dates [s]."""
    try:
        return table.numbers(time)
    except RecordingError:
        return np.asarray(table.nanoseconds(time) * 1e-9, dtype=np.float64)


def correlate_ways(table: Table, position: str, speed: str, steps: Floats) -> float:
    """Correlation of a column's way with another's integral, over parts of the log."""
    way, integral = _ways(table, position, speed, steps)
    return correlate(way, integral) if len(way) >= FEWEST_PARTS else 0.0


def _is_integral(table: Table, position: str, speed: str, steps: Floats) -> float:
    """1 where a column's way is another's integral itself, in the same units, over all parts of the log; else 0."""
    way, integral = _ways(table, position, speed, steps)
    whole, path = float(np.sum(np.abs(integral))), float(np.sum(np.abs(way)))
    if len(way) < FEWEST_PARTS or not 0.0 < whole < np.inf or not path < np.inf:
        return 0.0
    return float(abs(path / whole - 1.0) < SAME_UNITS and np.sum(np.abs(way - integral)) < BESIDE_ITS_WAY * whole)


def _ways(table: Table, position: str, speed: str, steps: Floats) -> tuple[Floats, Floats]:
    """A column's way and another's integral over parts of the log, each of shape (P,)."""
    with np.errstate(over="ignore", invalid="ignore"):  # a column of anything
        angle, travel = table.numbers(position), np.cumsum(table.numbers(speed) * steps)
        ends = np.unique(np.linspace(0, len(angle) - 1, min(PARTS, len(angle) // 3) + 1).astype(np.int64))
        return np.diff(angle[ends]), np.diff(travel[ends])
