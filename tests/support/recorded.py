"""The plant's stamped recordings as lesser boards would have made them."""

from dataclasses import replace
from math import tau

import numpy as np

from motor_identification.recording import Recording
from motor_model.sample import Measurement


def as_counts(recording: Recording) -> Recording:
    """Only the count is read at each sample; no edge has a stamp. The recording should be one of two channels."""
    info = replace(recording.info, measurement=Measurement.COUNTS, edge_resolution=0.0)
    return replace(recording, info=info)


def as_speed(recording: Recording, window: int = 1, lag: float | None = None) -> Recording:
    """Only the mean speed over the `window` samples before each is logged; `lag` [s] is what the log says of that."""
    seconds = window * recording.info.sample_period
    count = np.concatenate([np.full(window, recording.edge_count[0]), recording.edge_count])
    speed = (count[window:] - count[:-window]) * (tau / recording.info.edges_per_revolution / seconds)
    info = replace(
        recording.info,
        measurement=Measurement.SPEED,
        speed_window=seconds,
        speed_lag=0.5 * seconds if lag is None else lag,
        edge_resolution=0.0,
    )
    return replace(recording, info=info, speed=speed)


def without_count(recording: Recording) -> Recording:
    """The log does not say which encoder it was."""
    return replace(recording, info=replace(recording.info, edges_per_revolution=0))


def as_period_speed(recording: Recording, falls: bool = False) -> Recording:
    """Only a slot over the time between the latest two edges is logged, with the sign of the way.

    falls: over the time since the latest edge, where that is longer.
    """
    slot = recording.info.edge_angle
    way = np.sign(recording.speed)
    since = (recording.sample_time - recording.edge_time) * 1e-9
    period = np.maximum(recording.edge_period, since) if falls else recording.edge_period
    known = recording.edge_period > 0.0
    speed = np.divide(way * slot, period, out=np.zeros(len(way)), where=known)
    logged = without_count(as_speed(recording))
    return replace(logged, speed=speed, edge_period=np.zeros(len(speed)))
