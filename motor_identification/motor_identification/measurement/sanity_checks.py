"""Refuse counts and speeds that no motor makes: counters that wrap or are reset, speeds in another unit.

And find a motor that runs on at 0 V: what was logged as its voltage is something else.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.measurement.timestamp_checks import mark_possible
from motor_identification.recording import Floats, Integers, Recording
from motor_model.errors import RecordingError
from motor_model.sample import Measurement

JUMP_RATE = 2.0  # times the rate around it by which a count's rate must not differ from that
JUMP_COUNTS = 10.0  # counts by which it may differ besides
JUMP_STEPS = 2.5  # times nearly the largest step: a sensor in beat with its log shows none and two in turn
STEADY_VOLTAGE = 0.2  # of the largest voltage: where it changes by more, even one sample's motion can be real
CHUNK_SAMPLES = 20  # samples over which speed and count are compared
CHUNK_COUNTS = 5  # counts in a chunk from which on it tells the unit
IMPOSSIBLE_STAMPS = 0.6  # share of stamps that cannot be right, from which on all of them are those of another clock
BACKWARDS = -0.5  # of the motion, weighted by voltage: braking and coasting leave more than half, swapped wires -0.9
FEWEST_ROWS = 50  # before any drive, in which a motor that was just switched off would become slower
GOES_ON = 0.9  # of its speed in the first half of those rows, that a motor which is driven has in the second
FAST = 0.25  # of its largest speed, which noise of a motor that stands does not reach
LONG_BEFORE = 0.1  # of a recording: its motor's time at 0 V, before any voltage, in which what coasts becomes slower
SPEED_FACTOR = 3.0  # factor between speed and count beyond which they do not mean the same; 2π, 9.5 and 57.3 are beyond


@dataclass(frozen=True)
class Undriven:
    """A motor that ran on at 0 V, before any voltage: what was logged does not drive it."""

    uri: str
    speed: float  # [rad/s] mean
    duration: float  # [s]


def find_count_jump(time: Floats, count: Integers, voltage: Floats) -> int | None:
    """Find the first sample whose count has jumped while the voltage did not; None without one. Arrays of shape (K,).

    A wrap, a reset or a misread count is off for one sample, or for a sample and back. A motor that starts or turns
    moves on afterwards, so that it is like two of the four samples around.
    """
    if len(count) < 6:
        return None
    step = np.diff(time)
    rate = np.diff(count) / step
    around = sliding_window_view(np.pad(rate, 2, mode="edge"), 5)
    usual = np.median(around[:, (0, 1, 3, 4)], axis=1)
    off = np.abs(rate - usual) * step > JUMP_RATE * np.abs(usual) * step + JUMP_COUNTS
    volts = sliding_window_view(np.pad(voltage, 3, mode="edge"), 7)
    steady = np.ptp(volts, axis=1)[1:] <= STEADY_VOLTAGE * np.abs(voltage).max()
    far = np.abs(np.diff(count)) > JUMP_STEPS * np.quantile(np.abs(np.diff(count)), 0.9)
    jumps = np.flatnonzero(off & steady & far)
    return int(jumps[0]) + 1 if len(jumps) else None


def compare_speed_with_count(recording: Recording) -> float | None:
    """Compare speed with count: how many times it is what the count says, in moving parts; None if unknown.

    Both are without sign, so that a single channel's doubt about it does not matter.
    """
    steps = _passed_counts(recording)
    travel = np.abs(recording.speed[1:]) * np.diff(recording.time)
    whole = len(steps) // CHUNK_SAMPLES * CHUNK_SAMPLES
    counted = steps[:whole].reshape(-1, CHUNK_SAMPLES).sum(axis=1)
    travelled = travel[:whole].reshape(-1, CHUNK_SAMPLES).sum(axis=1)
    telling = counted >= CHUNK_COUNTS
    if np.count_nonzero(telling) < 3:
        return None
    slot = recording.info.edge_angle
    return float(np.median(travelled[telling] / counted[telling])) / slot


def _passed_counts(recording: Recording) -> Integers:
    """Count what is passed from sample to sample, shape (K − 1,); of two channels without a flank crossed again.

    A shaft that stands on a flank crosses it many times, which the reported speed takes for standing.
    """
    steps = np.diff(recording.edge_count)
    if not recording.info.single_channel:
        changed = np.flatnonzero(steps)
        again = (np.abs(steps[changed[1:]]) == 1) & (np.sign(steps[changed[1:]]) == -np.sign(steps[changed[:-1]]))
        steps[changed[1:][again]] = 0
    return np.asarray(np.abs(steps))


def check_counts(recording: Recording) -> Recording:
    """Return a recording with an encoder if its counts and speeds can be those of one motor.

    Raises:
        RecordingError: the count jumps, edges are stamped by another clock than samples, or speed and count disagree
            by more than any error of measurement.
    """
    time, sampled = recording.time, recording.info.measurement is Measurement.COUNTS
    jump = find_count_jump(time, recording.edge_count, recording.voltage) if sampled else None
    if jump is not None:
        before, here = (int(recording.edge_count[k]) for k in (jump - 1, jump))
        raise RecordingError(
            f"{recording.uri}: edge_count jumps from {before} to {here} at {time[jump]:.3f} s: the counter "
            "wrapped or was reset. Unwrap it before it is recorded, or use a part without the jump (--start, --stop)."
        )
    if not sampled:
        _check_stamps(recording)
    ratio = compare_speed_with_count(recording)
    if ratio is not None and not 1.0 / SPEED_FACTOR < ratio < SPEED_FACTOR:
        said = f"{ratio:.3g} ×" if ratio > 1.0 else f"1/{1.0 / max(ratio, 1e-9):.3g} of"
        raise RecordingError(
            f"{recording.uri}: the reported speed is {said} the speed from edge_count. Report speed in rad/s, "
            "and set edges_per_revolution to the counts per revolution."
        )
    agreement = compare_motion_with_voltage(recording)
    if not recording.info.single_channel and agreement is not None and agreement < BACKWARDS:
        raise RecordingError(
            f"{recording.uri}: the motor counts down while its voltage is positive, and up while it is negative: swap "
            "the two channels of the encoder, or the motor's leads, and record again."
        )
    return recording


def count_undriven_rows(voltage: Floats, speed: Floats) -> int:
    """Count the first rows, at 0 V, in which a motor keeps its speed; 0 where it stands, or becomes slower.

    Arrays of shape (K,), of any unit.
    """
    rows = int(np.argmax(voltage != 0.0)) if np.any(voltage) else 0
    if rows < FEWEST_ROWS:
        return 0
    first, second = (abs(float(np.mean(half))) for half in np.array_split(speed[:rows], 2))
    return rows if second > max(GOES_ON * first, FAST * float(np.max(np.abs(speed)))) else 0


def find_undriven(recordings: Sequence[Recording]) -> Undriven | None:
    """Find a recording that begins with a motor that keeps its speed at 0 V, for long.

    One that was switched off just before coasts, and may take as long to become slower as a recording is that hardly
    has any of that.
    """
    for recording in recordings:
        rows = count_undriven_rows(recording.voltage, recording.speed)
        if rows and recording.time[rows] > LONG_BEFORE * recording.duration:
            return Undriven(recording.uri, float(np.mean(recording.speed[:rows])), float(recording.time[rows]))
    return None


def compare_motion_with_voltage(recording: Recording) -> float | None:
    """Compare signs of counts and voltage: 1 where they always agree, -1 where they never do; None without motion."""
    steps = np.diff(recording.edge_count) * recording.voltage[:-1]
    total = float(np.sum(np.abs(steps)))
    return float(np.sum(steps)) / total if total > 0.0 else None


def _check_stamps(recording: Recording) -> None:
    fresh = np.flatnonzero(np.diff(recording.edge_count)) + 1
    strange = ~mark_possible(recording, fresh, (recording.edge_time[fresh] - recording.sample_time[0]) * 1e-9)
    if np.count_nonzero(strange) > IMPOSSIBLE_STAMPS * len(fresh):
        raise RecordingError(
            f"{recording.uri}: {np.count_nonzero(strange)} of {len(fresh)} edge_time values lie outside the sample "
            "that counted the edge. Stamp edges with the clock of sample_time, or set measurement to counts."
        )
