"""Mark wrong time stamps: edges reported at a time at which they cannot have been.

Two rules, one exact and one of smoothness. An edge that is new in a sample came after the sample before and not after
the sample itself. And a single stamp that is off makes one interval too short and the next too long by as much, while
both together are as long as their neighbours: that is told from a missed edge, which leaves them too long, and from a
motor that gains speed, which changes all of them.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.recording import Bools, Floats, Integers, Recording

STAMP_MARGIN = 0.05  # of the sample period: how far beside it a board may stamp
STAMP_ERROR = 0.5  # slots that a stamp must be off: more than a missed edge beside it makes of a right one
USUAL_ERRORS = 6.0  # times what stamps around it are off
EDGES_AROUND = 5  # edges on either side that say what is usual
MOST_UNEVENNESS = 0.5  # of what a stamp is off: how unevenly the neighbours may turn beside


def mark_possible(recording: Recording, sample: Integers, time: Floats) -> Bools:
    """Mark edges, new in `sample` (E,), that can have come at `time` (E,) [s] since the first sample."""
    margin = STAMP_MARGIN * recording.info.sample_period + recording.info.edge_resolution
    before = recording.time[np.maximum(sample - 1, 0)]
    return np.asarray((time > before - margin) & (time <= recording.time[sample] + margin))


def mark_smooth(time: Floats, count: Integers) -> Bools:
    """Mark edges (E,), in order of their counts, that are stamped when a disc that turns evenly would show them."""
    size = len(time)
    if size < 2 * EDGES_AROUND + 1:
        return np.ones(size, dtype=bool)
    off, uneven = np.zeros(size), np.full(size, np.inf)
    gap, length = np.diff(count).astype(np.float64), np.diff(time)
    with np.errstate(divide="ignore", invalid="ignore"):
        outer = (gap[:-1] + gap[1:]) / (length[:-1] + length[1:])  # [slots/s] from the edge before to the one after
        off[1:-1] = np.abs(length[:-1] * outer - gap[:-1])  # [slots]
        rate = gap / length
        beside = 0.5 * (rate[:-3] + rate[3:])  # of the intervals before and after those two
        uneven[2:-2] = np.abs(outer[1:-1] / beside - 1.0) * (gap[1:-2] + gap[2:-1])
    off[np.isnan(off)], uneven[np.isnan(uneven)] = np.inf, np.inf
    padded = np.pad(off, EDGES_AROUND, mode="edge")
    usual = np.median(sliding_window_view(padded, 2 * EDGES_AROUND + 1), axis=1)
    return np.asarray(~((off > STAMP_ERROR + USUAL_ERRORS * usual) & (uneven < MOST_UNEVENNESS * off)))
