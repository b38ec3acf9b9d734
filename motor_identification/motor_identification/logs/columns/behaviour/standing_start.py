"""Tell whether runs of one voltage each begin with a motor that stands."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.clock import row_period

Floats = NDArray[np.float64]

FIRST_ROWS = 6.0  # sample periods after 0, within which a run's clock began with its voltage
FIRST_VALUES = 3  # of a run, that tell whether the motor turned already
AGAINST = 0.25  # of a run's largest speed, which noise may seem to turn against the voltage
ARRIVED, ON_ITS_WAY = 0.9, 0.5  # of its final speed: runs that did not both begin with a motor that stood


def begins_at_rest(stamps: Floats, volts: Floats, values: Floats, is_speed: bool) -> bool:
    """Whether each of several runs has one voltage, its clock begins just before its first row, and it may have stood.

    Args:
        stamps: times of the rows [s], shape (K,); they go back where a run begins.
        volts: in any unit, shape (K,).
        values: speeds or positions, in any unit, shape (K,).
        is_speed: which of both they are.
    """
    begins = np.concatenate(([0], np.flatnonzero(np.diff(stamps) < 0.0) + 1, [len(stamps)]))
    if len(begins) < 3:
        return False
    period = row_period(stamps)
    runs = [slice(start, stop) for start, stop in zip(begins[:-1], begins[1:], strict=True) if stop - start > 1]
    even = all(np.all(volts[run] == volts[run.start]) for run in runs)
    if not even or not all(0.0 < stamps[run.start] < FIRST_ROWS * period for run in runs):
        return False
    speeds = [values[run] if is_speed else np.diff(values[run]) for run in runs]
    if not all(can_have_stood(speed, float(volts[run.start])) for speed, run in zip(speeds, runs, strict=True)):
        return False
    return rise_alike([float(stamps[run.start]) for run in runs], speeds)


def rise_alike(begins: Sequence[float], speeds: Sequence[Floats]) -> bool:
    """Whether runs of one motor begin alike: none is at its final speed as early as another is on its way.

    Args:
        begins: of every run, the time of its first row after its clock began, in any unit.
        speeds: of every run, in any unit, shape (K,).
    """
    few = 2 * FIRST_VALUES
    ends = [abs(float(np.mean(speed[-len(speed) // 4 :]))) if len(speed) > 2 * few else 0.0 for speed in speeds]
    fast = [k for k, end in enumerate(ends) if end > AGAINST * max(ends)]
    shares = {k: abs(float(np.mean(speeds[k][:few]))) / ends[k] for k in fast}
    arrived = [begins[k] for k in fast if shares[k] > ARRIVED]
    return not any(shares[k] < ON_ITS_WAY and begins[k] >= min(arrived, default=np.inf) for k in fast)


def can_have_stood(speed: Floats, voltage: float) -> bool:
    """Whether a run's speeds, shape (K,), in any unit, can be those of a motor that stood when its voltage came.

    One that still turns against its voltage, or faster than it will in the end, did not.
    """
    if len(speed) < 2 * FIRST_VALUES:
        return True
    top, end = float(np.max(np.abs(speed))), float(np.mean(speed[-len(speed) // 4 :]))
    begin = float(np.median(speed[:FIRST_VALUES]))
    way = np.sign(voltage)
    return bool(begin * way >= -AGAINST * top and abs(begin) <= abs(end) + AGAINST * top)
