"""Both lines of an encoder as events for the emulated chip: exact flanks of any duty cycle and phase."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from motor_board.emulation.edges import Line

FREQUENCY = 16e6
LEVELS = np.array([[True, False], [True, True], [False, True], [False, False]])  # of A and B after each flank, forward


def line_events(
    periods: NDArray[np.float64], rate: NDArray[np.float64], flanks: Sequence[float]
) -> tuple[NDArray[np.uint64], NDArray[np.uint8], NDArray[np.int64]]:
    """Forward through whole periods of A, each at its own rate [1/s]: cycles, lines and directions of the edges."""
    begin = np.concatenate([[0.0], np.cumsum(1.0 / rate)])[:-1]
    times = (begin[:, None] + np.asarray(flanks) / rate[:, None]).ravel() * FREQUENCY
    return times.astype(np.uint64), np.tile(_what(), len(periods)), np.ones(4 * len(periods), dtype=np.int64)


def dither_events(
    turning: NDArray[np.int64], gap: float, start: int = 0
) -> tuple[NDArray[np.uint64], NDArray[np.uint8]]:
    """One quarter after the other in these directions (±1), `gap` [s] apart, from quarter `start` on."""
    quarter = start + np.concatenate([[0], np.cumsum(turning)])
    after = np.where(turning > 0, quarter[:-1], quarter[1:] - 1) % 4  # backward, the levels before that flank
    flank = np.where(turning > 0, quarter[:-1], quarter[1:]) % 4
    levels = LEVELS[after]
    what = np.where(levels[:, 1], Line.B_HIGH, 0)
    a = np.where(levels[:, 0], Line.A_STAYS, Line.A_FALLS)
    what = what | np.where(flank % 2 == 0, a, Line.B_ALONE)
    cycles = (np.arange(1, len(turning) + 1) * gap * FREQUENCY).astype(np.uint64)
    return cycles, what.astype(np.uint8)


def counts_of(what: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Which of the events are flanks of A."""
    return np.asarray((what & Line.B_ALONE) == 0)


def _what() -> NDArray[np.uint8]:
    return np.array(
        [Line.A_STAYS, Line.B_ALONE | Line.B_HIGH, Line.A_FALLS | Line.B_HIGH, Line.B_ALONE], dtype=np.uint8
    )
