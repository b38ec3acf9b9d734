"""Residuals: how far a simulated motion is from what a recording says of its intervals."""

import numpy as np

from motor_identification.intervals import Intervals
from motor_identification.recording import Floats, Integers
from motor_model.compiled import compiled


@compiled
def fill_residuals(
    angle: Floats, time: Floats, first: Integers, last: Integers, speed: Floats, slack: Floats, residual: Floats
) -> None:
    """Simulated minus measured mean speed [rad/s] of every interval, from the simulated angle [rad] at `time`."""
    for i in range(len(first)):
        duration = time[last[i]] - time[first[i]]
        travel = angle[last[i]] - angle[first[i]]
        if slack[i] > 0.0:
            excess = max(abs(travel) - slack[i], 0.0)
            residual[i] = excess / duration if travel > 0.0 else -excess / duration
        else:
            residual[i] = travel / duration - speed[i]


def residuals(intervals: Intervals, angle: Floats) -> Floats:
    """Simulated minus measured mean speed [rad/s], shape (I,), from the simulated angle [rad] at `intervals.time`."""
    residual = np.empty(len(intervals.first))
    fill_residuals(angle, intervals.time, intervals.first, intervals.last, intervals.speed, intervals.slack, residual)
    return residual
