"""Cut a recording into blocks of time, every n-th of which serves another purpose than the rest."""

from dataclasses import dataclass

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Bools

USUAL_BLOCK = 0.5  # [s]: most motors' time constants are shorter, so that a block shows what the motor does
BLOCK_SAMPLES = (25.0, 100.0)  # sample periods that a block has in any case: how fast a motor is sampled tells its own
LEAST_BLOCKS = 12  # of a short recording: enough for three blocks of every fourth


@dataclass(frozen=True)
class TimeBlocks:
    """The last of every so many blocks of a recording's time."""

    every: int

    def mark(self, data: Intervals, sample_period: float) -> Bools:
        """Mark the intervals that begin in these blocks, shape (I,)."""
        shortest, longest = (samples * sample_period for samples in BLOCK_SAMPLES)
        length = min(max(shortest, min(USUAL_BLOCK, longest)), data.time[-1] / LEAST_BLOCKS)
        block = (data.time[data.first] // length).astype(np.int64)
        return np.asarray(block % self.every == self.every - 1)
