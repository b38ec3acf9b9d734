"""Measure how a command swings: what makes a motor show more of itself than that it turns."""

from collections.abc import Sequence

import numpy as np

from motor_identification.recording import Floats, Recording
from motor_model.compiled import compiled

PLAY = 0.05  # of the largest voltage: what a measured supply, or a controller that holds a speed, moves to and fro
LEVELS = 5  # up to the largest voltage; what a controller does around a speed is within one or two of them
RESPONSE = 0.1  # of the largest voltage, between two levels that a motor answers plainly
LEAST_HALVES = 8  # of a wave, between two reversals of a sweep
SWEPT, IN_ORDER = 1.5, 0.9  # times its frequency from end to end; rank correlation of its half waves with their order
PASSED = 0.01  # of the samples, at voltages between those of a command that has one size
LEVEL_SHARE = 0.05  # of the samples, at a level where a recording stays; what it passes on the way is none


def measure_swings(recording: Recording) -> Floats:
    """Measure by how much a command swings at each sample, in units of its largest voltage, shape (K,).

    From 0 V before the first sample. What it moves to and fro within a small play is no swing: the sum over a step is
    its size, that over a sine is four times its amplitude a period.
    """
    largest = float(np.abs(recording.voltage).max())
    if largest == 0.0:
        return np.zeros(len(recording))
    followed = np.empty(len(recording))
    _follow(recording.voltage / largest, PLAY, followed)
    return np.asarray(np.abs(np.diff(followed, prepend=0.0)))


def count_levels(recordings: Sequence[Recording]) -> int:
    """Count the levels, fifths of the largest voltage, at which recordings of one motor stay; 0 V is none."""
    volts = np.concatenate([recording.voltage for recording in recordings])
    levels, counts = np.unique(np.rint(LEVELS * volts / np.abs(volts).max()), return_counts=True)
    return int(np.count_nonzero((levels != 0.0) & (counts >= LEVEL_SHARE * len(volts))))


def has_one_size(recordings: Sequence[Recording]) -> bool:
    """Decide whether commands of one motor are 0 V or of one size, whichever way, but for what they pass on the way."""
    volts = np.concatenate([np.abs(recording.voltage) for recording in recordings] or [np.zeros(0)])
    share = volts / max(float(volts.max(initial=0.0)), np.finfo(float).tiny)
    between = (share > RESPONSE) & (share < 1.0 - PLAY)
    return len(volts) > 0 and bool(np.count_nonzero(between) < PASSED * len(volts))


def count_responses(recordings: Sequence[Recording]) -> int:
    """Count the levels that recordings of one motor come to and stay at, each after another one."""
    largest = max(float(np.abs(recording.voltage).max()) for recording in recordings)
    return sum(_count_responses(recording.voltage / largest) for recording in recordings) if largest > 0.0 else 0


def _count_responses(volts: Floats) -> int:
    """Count where voltages (K,), in units of the largest, come to another level for long enough; from 0 V."""
    ends = np.flatnonzero(np.abs(np.diff(volts)) > PLAY) + 1
    count, last = 0, 0.0
    for part in np.split(volts, ends):
        level = float(np.mean(part))
        if len(part) >= LEVEL_SHARE * len(volts) and abs(level - last) >= RESPONSE:
            count, last = count + 1, level
    return count


def is_sweep(recording: Recording) -> bool:
    """Decide whether a command's frequency goes one way from beginning to end, so that it tells the time as well."""
    centred = recording.voltage - 0.5 * (recording.voltage.max() + recording.voltage.min())
    sides = np.sign(centred) * (np.abs(centred) > RESPONSE * np.abs(centred).max())
    far = np.flatnonzero(sides)
    turns = recording.time[far[1:]][np.diff(sides[far]) != 0.0]
    halves = np.diff(turns)
    if len(halves) < LEAST_HALVES:
        return False
    quarter = len(halves) // 4
    ends = np.array([np.median(halves[:quarter]), np.median(halves[-quarter:])])
    order = np.corrcoef(np.arange(len(halves)), np.argsort(np.argsort(halves, kind="stable"), kind="stable"))[0, 1]
    return bool(ends.max() > SWEPT * ends.min() and abs(order) > IN_ORDER)


@compiled
def _follow(values: Floats, play: float, followed: Floats) -> None:
    """Follow values as a part with play does: by the rest of what is beyond it, and a step by all of it."""
    last = 0.0
    for k in range(len(values)):
        if abs(values[k] - last) > play:
            last = values[k]
        followed[k] = last
