"""Cut a recording into blocks of time, every n-th of which serves another purpose than the rest."""

from dataclasses import dataclass

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Bools

LONGEST_BLOCK = 100.0  # sample periods: more than most time constants, so that a block shows what the motor does
LEAST_BLOCKS = 12  # of a short recording: enough for three blocks of every fourth


@dataclass(frozen=True)
class TimeBlocks:
    """The last of every so many blocks of a recording's time."""

    every: int

    def mark(self, data: Intervals, sample_period: float) -> Bools:
        """Mark the intervals that begin in these blocks, shape (I,)."""
        length = min(LONGEST_BLOCK * sample_period, data.time[-1] / LEAST_BLOCKS)
        block = (data.time[data.first] // length).astype(np.int64)
        return np.asarray(block % self.every == self.every - 1)
