"""Find angles whose noise is more than a count: of a potentiometer, a resolver, positions that were computed.

A count of edges goes on or stands; only where the motor turns does it step back. An angle with noise steps forward and
back wherever the motor is slow. So does a motor that is driven to and fro within rows, and what it travels in rows that
are not even looks like noise.
"""

from dataclasses import dataclass
from math import sqrt

import numpy as np

from motor_identification.recording import Floats, Recording, once
from motor_identification.sensor.white_noise import estimate_white_noise
from motor_model.sample import Measurement

ALTERNATING = 0.05  # share of steps that go back, from which on they are noise: an encoder of 50 nm has 0.0015
LEAST_NOISE = 0.6  # counts: twice what counting makes; a shaft that trembles on an edge has less
# Times the noise of a row's travel, of what a motor travels in it: below the first, so many rows are averaged that it
# is above the second. Measured: 0.06 in rows of 22 ms of a potentiometer, of which no fit came to anything.
LEAST_TOLD, WELL_TOLD = 0.3, 1.0
MOST_ROWS = 0.01  # of a recording that are averaged
UNEVEN = 1.0  # times what uneven rows make of the travel: noise that is no more is rather that
MOST_BACK = 10.0  # times the noise that a step against both its neighbours usually is: larger ones are a wrap's


def find_angle_noise(recording: Recording) -> float:
    """Find the standard deviation [counts] of the white noise of sampled angles; 0 where they are counts of edges."""
    steps = np.diff(recording.edge_count)
    steps = steps[steps != 0]
    ways = np.sign(steps)
    if len(ways) < 2 or np.mean(ways[1:] != ways[:-1]) < ALTERNATING:
        return 0.0
    noise = estimate_white_noise(recording.edge_count.astype(np.float64), recording.voltage)
    alone = np.abs(steps[1:-1][(ways[1:-1] != ways[:-2]) & (ways[1:-1] != ways[2:])])
    wraps = len(alone) > 0 and float(np.median(alone)) > MOST_BACK * noise
    uneven = UNEVEN * _measure_uneven_travel(recording)
    return noise if noise > max(LEAST_NOISE, uneven) and not wraps else 0.0


def _measure_uneven_travel(recording: Recording) -> float:
    """Measure how much more or less [counts] is travelled in a row because rows are not even (standard deviation)."""
    rows = np.diff(recording.time)
    travel = np.diff(recording.edge_count).astype(np.float64)
    return float(np.std(rows) / np.mean(rows)) * sqrt(float(np.mean(travel**2)))


@dataclass(frozen=True)
class Angles:
    """Angles that the motion stands out of the noise of; arrays of shape (K,)."""

    time: Floats  # [s]
    angle: Floats  # [counts]
    noise: float  # [counts] standard deviation of each
    rows: int  # that each is the average of
    noise_of_row: float  # [counts]


@once
def find_noisy_angles(recording: Recording) -> Angles | None:
    """Find angles that have white noise, averaged where that hides their motion; None where they are counts of edges.

    Sampled counts of two channels may be such angles; edges, and speeds, are none.
    """
    if recording.info.measurement is not Measurement.COUNTS or recording.info.single_channel:
        return None
    noise = find_angle_noise(recording)
    return average_rows(recording, noise) if noise > 0.0 else None


def find_plain_speed(recording: Recording) -> Floats:
    """Find the speeds [rad/s] of a recording that show its motion: its own, or those between averaged angles."""
    angles = find_noisy_angles(recording)
    if angles is None or angles.rows == 1:
        return recording.speed
    return np.asarray(np.diff(angles.angle) / np.diff(angles.time) * recording.info.edge_angle)


def average_rows(recording: Recording, noise: float) -> Angles:
    """Average angles of white noise [counts] over so many rows that the motion stands out of it.

    Least squares of what is travelled from row to row see the noise of an angle twice, and the motion only where it is
    as large.
    """
    angle, rows = recording.edge_count.astype(np.float64), 1
    most = max(int(MOST_ROWS * len(angle)), 1)
    if _measure_told(angle, noise, 1) < LEAST_TOLD:
        told = (count for count in range(2, most + 1) if _measure_told(angle, noise, count) >= WELL_TOLD)
        rows = next(told, most)
    return Angles(_average(recording.time, rows), _average(angle, rows), noise / sqrt(rows), rows, noise)


def _measure_told(angle: Floats, noise: float, rows: int) -> float:
    """Measure what is travelled [counts] (K,) from average to average of so many rows, in units of its noise.

    By what is beyond the noise, as far as that is known, or by travels that have no angle in common, whose noise has
    none either: the larger of both, for a motor that swings to and fro has little in common.
    """
    travel, chance = np.diff(_average(angle, rows)), 2.0 * noise**2 / rows
    beyond = float(np.mean(travel**2)) - chance
    common = float(np.mean(travel[2:] * travel[:-2])) if len(travel) > 2 else 0.0
    return sqrt(max(beyond, common, 0.0) / chance)


def _average(values: Floats, rows: int) -> Floats:
    """Average values (K,) over so many rows each, without the rest at the end."""
    count = len(values) // rows
    return np.asarray(values[: count * rows].reshape(count, rows).mean(axis=1))
