"""Cut a recording into blocks of time, every n-th of which serves another purpose than the rest."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Bools, Floats, Integers

BLOCK = 100.0  # sample periods: how fast a motor is sampled tells how fast it is, and a block shows what it does
NEAR_A_BLOCK = 0.1  # of a block: what begins so near to its end may as well have begun in the next
LEAST_BLOCKS = 12  # of a short recording: enough for three blocks of every fourth


def compute_block_length(data: Intervals, sample_period: float, stretch: float = 1.0) -> float:
    """Compute how long [s] the blocks of a recording are, sampled with this period [s]; stretch: of the usual ones."""
    return float(min(stretch * BLOCK * sample_period, data.time[-1] / LEAST_BLOCKS))


def number_blocks(times: Floats, length: float) -> Integers:
    """Number the blocks of a length [s] that times [s] are in."""
    return np.asarray((times // length).astype(np.int64))


@dataclass(frozen=True)
class TimeBlocks:
    """One of every so many blocks of a recording's time: the last, in the next recording the one before, and so on.

    What happens once, at the beginning of every recording, is in the blocks of some and not of others.
    """

    every: int
    stretch: float = 1.0  # of the usual length

    def mark_each(self, intervals: Sequence[Intervals], sample_period: float) -> tuple[Bools, ...]:
        """Mark the intervals of every recording that begin in these blocks."""
        return tuple(self.mark(data, sample_period, number) for number, data in enumerate(intervals))

    def mark(self, data: Intervals, sample_period: float, number: int = 0) -> Bools:
        """Mark the intervals that begin in these blocks, shape (I,); number: of the recording among all.

        None where they would be all: nothing of a recording that is within one block serves another purpose.
        """
        marks = self.find_times(data.time[data.first], data, sample_period, number)
        return marks & (not marks.all() or self.every == 1)

    def find_times(self, times: Floats, data: Intervals, sample_period: float, number: int = 0) -> Bools:
        """Find which times [s] of a recording are in these blocks."""
        block = number_blocks(times, compute_block_length(data, sample_period, self.stretch))
        return np.asarray((block + number) % self.every == self.every - 1)

    def measure_blindness(self, time: float, data: Intervals, sample_period: float, number: int = 0) -> float:
        """Measure for how long [s] nothing tells when something happened near a time [s], without these blocks."""
        length = compute_block_length(data, sample_period, self.stretch)
        around = np.array([time - NEAR_A_BLOCK * length, time, time + NEAR_A_BLOCK * length])
        return length if self.find_times(around, data, sample_period, number).any() else 0.0

    def mark_near(self, times: Sequence[float], data: Intervals, sample_period: float) -> Bools:
        """Mark the intervals that begin in a block, of whatever purpose, with one of some times [s], shape (I,).

        Those of the block before or after it, too, where that is near.
        """
        length = compute_block_length(data, sample_period, self.stretch)
        near = [int(time / length + share) for time in times for share in (-NEAR_A_BLOCK, NEAR_A_BLOCK)]
        return np.asarray(np.isin(number_blocks(data.time[data.first], length), near))
