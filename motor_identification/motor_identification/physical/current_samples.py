"""Hold what a recording says of the armature's current: readings, and the instants that they belong to."""

from dataclasses import dataclass

import numpy as np

from motor_identification.recording import Bools, Floats, Recording
from motor_model.errors import RecordingError

LEAST_SAMPLES = 50  # readings of a recording that are worth a fit
LEAST_LEVELS = 4  # different readings, below which a current is a column of constants
LEAST_PILE = 5  # readings at the end of a sensor's range that are more than chance,
PILED_UP = 3.0  # times as many as at the level next to it: noise alone leaves fewer at the end
UNMEASURED = (
    "{} has no measured current: record with a current sensor, name its field with --current-from, or give the "
    "armature's resistance with --resistance."
)
CONSTANT = "{}: the current never changes: the sensor is not connected, or the field is another quantity."
CLIPPED = "{}: {} of {} readings of the current were left out: they are at the end of the sensor's range."


@dataclass(frozen=True)
class CurrentSamples:
    """Readings of one recording; arrays of shape (K,)."""

    time: Floats  # [s] since the first sample
    current: Floats  # [A] at that instant, before the voltage that is latched there acts
    note: str = ""  # a sentence that a user has to read, or empty


def select_current(recording: Recording) -> CurrentSamples:
    """Select the samples of a recording that have a current within the sensor's range, but for the first.

    Raises:
        RecordingError: there is none, or one that says nothing.
    """
    known = np.isfinite(recording.current)
    known[0] = False  # the motion starts there
    if np.count_nonzero(known) < LEAST_SAMPLES:
        raise RecordingError(UNMEASURED.format(recording.uri))
    time, current = recording.time[known], recording.current[known]
    clipped = _mark_clipped(current)
    if len(np.unique(current[~clipped])) < LEAST_LEVELS or np.count_nonzero(~clipped) < LEAST_SAMPLES:
        raise RecordingError(CONSTANT.format(recording.uri))
    count = np.count_nonzero(clipped)
    note = CLIPPED.format(recording.uri, count, len(current)) if count else ""
    return CurrentSamples(time[~clipped], current[~clipped], note)


def _mark_clipped(current: Floats) -> Bools:
    """Mark readings that pile up at the largest or the smallest one."""
    marks = np.zeros(len(current), dtype=bool)
    for values in (current, -current):
        levels, counts = np.unique(values, return_counts=True)
        if len(levels) > 1 and counts[-1] >= LEAST_PILE and counts[-1] > PILED_UP * counts[-2] and levels[-1] > 0.0:
            marks |= values == levels[-1]
    return marks
