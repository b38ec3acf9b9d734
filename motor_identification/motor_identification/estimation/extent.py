"""Measure how far recordings of one motor reach: what the box of a fit is scaled by."""

from collections.abc import Sequence
from math import inf, pi

import numpy as np

from motor_identification.recording import Floats, Recording, have_steady_states, once
from motor_identification.sensor.noisy_angle import find_plain_speed
from motor_model.effect import Extent
from motor_model.sample import Measurement

FEW_COUNTS = 4.0  # a mean speed over so many is wrong by a quarter at most; boxes allow four times as much
BURSTS, FAR_BEYOND = 0.03, 3.0  # share of speeds that may be false for many rows, and how far beyond all others
LEAST_REACH = 0.125  # of the largest speed: the box begins at a tenth of kv = voltage / speed
TURNING_SPEED = 0.1  # of the largest speed: as slow as a motor turns for long enough to show a ripple


def measure_extent(recordings: Sequence[Recording]) -> Extent:
    """Measure how far recordings of one motor reach."""
    speed = max(map(_reach_of, recordings))
    return Extent(
        max(float(np.abs(recording.voltage).max()) for recording in recordings),
        speed,
        max(recording.duration for recording in recordings),
        min(map(_find_quickest, recordings)),
        max(_finest_cycles(recording, speed) for recording in recordings),
        have_steady_states(recordings),
    )


def _find_quickest(recording: Recording) -> float:
    """[s] the time in which a recording shows a motion: a sample, or of steady states what each is the mean over."""
    return recording.info.speed_window if recording.has_steady_states else recording.sample_period


@once
def _reach_of(recording: Recording) -> float:
    return _reach(find_plain_speed(recording))


def _reach(speed: Floats) -> float:
    """[rad/s] largest speed that two samples in a row report, so that one false edge does not move the search box.

    Where a sample is hardly longer than a count, its speed is none or several times too high (one count of 96 in a
    millisecond is 65 rad/s): then it is the largest mean over so many samples that a few counts are in it.
    """
    size = np.abs(speed)
    in_a_row = _without_bursts(np.minimum(size[1:], size[:-1]))
    count = float(size[size > 0.0].min(initial=inf))  # the smallest speed, which is a count a sample where they are so
    if in_a_row >= 2.0 * count or count == inf:
        return in_a_row
    travel, rows = np.concatenate(([0.0], np.cumsum(speed))), 4
    while rows < len(travel):
        most = float(np.abs(travel[rows:] - travel[:-rows]).max())
        if most >= FEW_COUNTS * count:
            return most / rows
        rows *= 2
    return in_a_row or float(size.max())


def _without_bursts(size: Floats) -> float:
    """[rad/s] largest of speeds' sizes (K,); where a few are far beyond all others, what the others reach.

    They may be what a filter makes of a jump, at a potentiometer's gap or a lost line, for many rows: no motor. If they
    are motion after all, the box still holds it: no less than LEAST_REACH of them is returned.
    """
    largest, moving = float(size.max()), size[size > 0.0]
    usual = float(np.quantile(moving, 1.0 - BURSTS)) if len(moving) else 0.0
    return max(usual, LEAST_REACH * largest) if largest > FAR_BEYOND * usual else largest


def _finest_cycles(recording: Recording, speed: float) -> float:
    """[1/rev of the encoder's shaft] of the finest ripple: two slots a cycle, two stamps at a slow but sure speed."""
    edges = recording.info.edges_per_revolution
    stamps = 2.0 if recording.info.measurement is Measurement.EDGES else 1.0  # a sample has at most
    turning = TURNING_SPEED * speed * float(recording.info.gear)
    seen = stamps * pi / (turning * recording.sample_period) if speed > 0.0 else inf
    return min(0.5 * edges, seen) if edges else seen
