"""Find operating conditions: what the motor did in every interval, by the measurement, so that residuals can be placed.

Everything comes from what was measured (speed, edges, command) and not from the simulation under suspicion; only the
gaps of the measured angle, where no edge came, are bridged by it.
"""

from dataclasses import dataclass, fields
from math import inf

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.measurement.measured_angle import Track, make_track
from motor_identification.recording import Bools, Floats, Integers, Recording
from motor_identification.validation.held_out import HeldOut

RUNS_PER_RECORDING = 1_000_000  # more than any recording has
ACCELERATION_SPAN = 0.0125  # [s] to either side of an interval over which its acceleration is taken


@dataclass(frozen=True)
class OperatingConditions:
    """One entry for every interval that counts, all of shape (I,), in the order of `HeldOut.residuals`."""

    speed: Floats  # [rad/s] signed, measured; 0 at a standstill
    acceleration: Floats  # [rad/s²] of the measured speed's size: negative while it slows down
    since: Floats  # [s] since motion last began or turned round; 0 at a standstill, infinite where it never did
    time: Floats  # [s] within the recording, at the interval's middle
    voltage: Floats  # [V] the command that holds there
    angle: Floats  # [rad] of the encoder's shaft since the recording's start
    duration: Floats  # [s]
    recording: Integers  # number of the recording
    run: Integers  # of the angle, numbered through all recordings: between two of them it may slip
    still: Bools  # no edge came: the motor moved less than a slot


def find_conditions(held: HeldOut) -> OperatingConditions:
    """Find what the motor was doing in every interval that counts."""
    rows = zip(held.recordings, held.intervals, held.angles, strict=True)
    parts = [_of_one(number, recording, data, angle) for number, (recording, data, angle) in enumerate(rows)]
    return OperatingConditions(
        **{
            field.name: np.concatenate([getattr(part, field.name) for part in parts])[held.counted]
            for field in fields(OperatingConditions)
        }
    )


def _of_one(number: int, recording: Recording, data: Intervals, angle: Floats) -> OperatingConditions:
    start, end = data.time[data.first], data.time[data.last]
    middle = 0.5 * (start + end)
    track: Track = make_track(data, angle)
    latest = data.find_rows(recording)
    order = np.argsort(middle, kind="stable")
    since, acceleration = np.empty(len(middle)), np.empty(len(middle))
    since[order] = _since(start[order], end[order], data.speed[order], data.slack[order] > 0.0)
    acceleration[order] = _slope(middle[order], np.abs(data.speed[order]))
    return OperatingConditions(
        speed=data.speed,
        acceleration=acceleration,
        since=since,
        time=middle,
        voltage=recording.voltage[latest],
        angle=data.gear * track.at(middle),
        duration=data.duration,
        recording=np.full(len(middle), number),
        run=track.run_at(middle) + RUNS_PER_RECORDING * number,
        still=data.slack > 0.0,
    )


def _since(start: Floats, end: Floats, speed: Floats, still: Bools) -> Floats:
    """[s] from the latest end of a standstill, or turn, to the middle of every interval, in the order of time."""
    way = np.sign(speed)
    began = np.full(len(start), -inf)
    turned = ~still & (np.append(0.0, way[:-1]) * way < 0.0)
    began[turned] = 0.5 * (np.append(start[:1], end[:-1]) + start)[turned]
    began[still] = end[still]
    latest = np.maximum.accumulate(began)
    return np.where(still, 0.0, 0.5 * (start + end) - latest)


def _slope(time: Floats, value: Floats) -> Floats:
    """Slope from the first to the last of what is measured around every time: at least its two neighbours."""
    index = np.arange(len(time))
    low = np.minimum(np.searchsorted(time, time - ACCELERATION_SPAN), np.maximum(index - 1, 0))
    high = np.maximum(
        np.searchsorted(time, time + ACCELERATION_SPAN, side="right") - 1, np.minimum(index + 1, len(time) - 1)
    )
    return np.asarray((value[high] - value[low]) / np.maximum(time[high] - time[low], 1e-9))
