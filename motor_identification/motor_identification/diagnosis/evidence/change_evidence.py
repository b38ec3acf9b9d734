"""Judge what makes a motion late where its command has just changed: nowhere else does a lag show.

A motor that was given one step in some seconds answers it for a hundredth of the time. In all of the gap next to
nothing goes with a dead time that is seen row by row, and is likelier by e^60.
"""

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.measurement.command_swing import measure_swings
from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Bools, Recording


def explains_changes(without: Model, model: Model) -> bool:
    """Decide whether a model takes away most of a gap that stands out where the command has just changed."""
    if not without.held.has_intervals_of(model.held):
        return False
    lasts = thresholds.ANSWERING_LAGS * model.estimate.parameters.time_constant
    rows = zip(model.held.recordings, model.held.intervals, strict=True)
    near = np.concatenate([mark_answers(recording, data, lasts) for recording, data in rows])
    both = near & without.held.counted & model.held.counted
    if not both.any():
        return False
    time = np.concatenate([data.duration for data in model.held.intervals])[both]
    was, rest = (float(time @ np.concatenate(one.held.residuals_of)[both] ** 2) for one in (without, model))
    share = model.noise.share
    floors = np.concatenate([data.floor_squared(share * data.unit) for data in model.held.intervals])
    noise = float(time @ floors[both])
    stands_out = was > thresholds.SEEN_GAP**2 * noise
    return stands_out and (was - rest) / (was - noise) > thresholds.RELEVANT_SHARE_NEAR_FLOOR


def mark_answers(recording: Recording, data: Intervals, lasts: float) -> Bools:
    """Mark the intervals (I,) that begin less than `lasts` [s] after a change of the command."""
    changes = recording.time[measure_swings(recording) > 0.0]
    begin = data.time[data.first]
    latest = np.searchsorted(changes, begin, side="right") - 1
    return np.asarray((latest >= 0) & (begin - changes[np.maximum(latest, 0)] < lasts)) if len(changes) else latest >= 0
