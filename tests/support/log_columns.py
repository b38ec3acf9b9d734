"""Tables of columns by kind, for tests of which column is which."""

from pathlib import Path

import numpy as np

from motor_identification.logs.csv.table import Table

TIME = np.arange(200) * 0.01
DRIVE = np.repeat([3.0, -2.0, 5.0, 1.0], 50)
MOVED = np.cumsum(DRIVE) * 0.1 + np.sin(TIME * 9.0)
KINDS = {
    "n": np.sin(TIME * 31.0),
    "t": TIME,
    "u": DRIVE,
    "y": MOVED,
    "b": 12.0 - 0.01 * np.abs(DRIVE),
    "r": 2.0 * DRIVE,
    "0": np.zeros(200),
}


def table(**columns: str) -> Table:
    """Columns by name, each with the numbers of a kind."""
    return Table(Path("log.csv"), np.arange(2, 202), {name: KINDS[kind] for name, kind in columns.items()})


def columns(**numbers: np.ndarray) -> Table:  # type: ignore[type-arg]
    return Table(Path("log.csv"), np.arange(2, 202), numbers)


def answer(drive: np.ndarray) -> np.ndarray:
    moved = np.zeros(len(drive))
    for k in range(len(drive) - 1):
        moved[k + 1] = moved[k] + (drive[k] - moved[k]) * 0.3
    return moved + np.random.default_rng(0).normal(0.0, 0.002, len(drive))


FOLLOWS = np.convolve(DRIVE, np.exp(-np.arange(60) / 8.0) / 8.0)[:200]
