"""Tell a drive that was sampled while it went to and fro from one that was set for steady states."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

MOST_SWEEPS = 4  # of a steady curve, from one end to the other
MOST_BY_HAND = 200  # steady states that somebody takes in any order
SMOOTH = 0.1  # of all the way, the mean step of what was sampled while it went
_END = 0.25  # of all the way, from its middle: an end is beyond


def goes_to_and_fro(values: Floats) -> bool:
    """Whether a drive, shape (K,), goes to and fro as in time, and is no curve that was measured step by step.

    Whoever waits for steady states goes up, down and maybe round once more, or takes a few in any order.
    """
    way = float(np.ptp(values))
    if not 0.0 < way < np.inf:
        return False
    off = (values - np.min(values)) / way - 0.5
    sweeps = np.count_nonzero(np.diff(np.sign(off[np.abs(off) > _END])))
    smooth = float(np.mean(np.abs(np.diff(off)))) < SMOOTH
    return bool(sweeps > MOST_SWEEPS and (smooth or len(values) > MOST_BY_HAND))
