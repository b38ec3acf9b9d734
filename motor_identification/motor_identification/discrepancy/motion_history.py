"""Describe the measured motion of a recording in short segments: what a load could depend on.

Everything is told from the measurement (speed, edges, command) and not from the simulation under suspicion; only the
gaps of the measured angle, where no edge came, are bridged by it.
"""

from dataclasses import dataclass

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.measurement.measured_angle import make_track
from motor_identification.recording import Bools, Floats, Integers, Recording

LAGS = 12  # samples of the command's past
SWING = 0.05  # of the largest voltage: a command that changes by more is followed sample by sample


@dataclass(frozen=True)
class MotionHistory:
    """The measured motion of one recording in S short segments; arrays of shape (S,)."""

    time: Floats  # [s] middle of each
    duration: Floats  # [s]
    still: Bools
    speed: Floats  # [rad/s] signed
    voltage: Floats  # [V] the command that acts, a known delay later
    drive: Floats  # [V] voltage − kv·speed
    angle: Floats  # [rad] of the encoder's shaft
    since: Floats  # [s] since the motion began or turned round
    travel: Floats  # [rad] since then
    past: Floats  # (S, LAGS) [V] how the command has changed at each of the samples before the latest
    at_start: Integers  # (I,) segment that begins where each interval does
    at_end: Integers  # (I,) segment that begins where each interval ends


def make_history(
    recording: Recording, data: Intervals, angle: Floats, kv: float, delay: float, speeds: Floats | None = None
) -> MotionHistory:
    """Cut a recording into segments between samples and ends of intervals; of thinned rows, between these ends.

    There, too, between samples where the command swings; elsewhere a segment has the mean of its samples' commands.

    angle: [rad] simulated at `data.time`. kv [V·s/rad] and delay [s]: of the fitted motor. speeds: [rad/s] of the
    intervals (I,), where not the measured ones.
    """
    speeds = data.speed if speeds is None else speeds
    sampled = recording.time + delay
    cuts = sampled if data.rows == 1 else sampled[_find_telling(recording, sampled, data)]
    edges = np.unique(np.concatenate([data.time, cuts[cuts < data.time[-1]]]))
    middle, duration = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)
    start, end = data.time[data.first], data.time[data.last]
    moving = data.slack == 0.0
    order = np.flatnonzero(moving)[np.argsort(start[moving], kind="stable")]
    centre = 0.5 * (start[order] + end[order])
    inside = np.maximum(np.searchsorted(start[order], middle, side="right") - 1, 0)
    speed = np.where(middle < end[order][inside], speeds[order][inside], np.interp(middle, centre, speeds[order]))
    still = _covered(middle, start[~moving], end[~moving])
    speed = np.where(still, 0.0, speed)
    sample = np.maximum(np.searchsorted(sampled, middle, side="right") - 1, 0)
    voltage = np.where(middle >= sampled[0], recording.voltage[sample], 0.0)
    changes = np.diff(recording.voltage, prepend=0.0)
    # Not at the latest: a loop answers the noise of the speed in its own row, and would predict it.
    lags = range(1, LAGS + 1)
    if data.rows == 1:
        past = np.stack([np.where(sample >= lag, changes[np.maximum(sample - lag, 0)], 0.0) for lag in lags], axis=1)
    else:
        voltage = _average(recording.voltage, sampled, edges)
        earlier = [np.concatenate([np.zeros(lag), changes[:-lag]]) for lag in lags]
        past = np.stack([_average(one, sampled, edges) for one in earlier], axis=1)
    began = np.flatnonzero(still[:-1] & ~still[1:] | (speed[:-1] * speed[1:] < 0.0)) + 1
    latest = np.searchsorted(began, np.arange(len(middle)), side="right") - 1
    begin = np.where(latest >= 0, edges[began[np.maximum(latest, 0)]] if len(began) else 0.0, -np.inf)
    track = make_track(data, angle)
    where = track.at(middle)
    at_begin = track.at(np.maximum(begin, 0.0))
    return MotionHistory(
        time=middle, duration=duration, still=still, speed=speed, voltage=voltage, drive=voltage - kv * speed,
        angle=data.gear * where, since=middle - begin, travel=np.abs(where - at_begin), past=past,
        at_start=np.searchsorted(edges, start), at_end=np.searchsorted(edges, end),
    )  # fmt: skip


def _find_telling(recording: Recording, sampled: Floats, data: Intervals) -> Bools:
    """Find the samples (K,), acting at times [s], that means over thinned rows do not stand for.

    Those within the command's past after it swings, and those where no row is.
    """
    swings = np.flatnonzero(np.abs(np.diff(recording.voltage)) > SWING * np.abs(recording.voltage).max()) + 1
    rows = np.arange(len(sampled))
    since = rows - np.append(-LAGS - 1, swings)[np.searchsorted(swings, rows, side="right")]
    step = 2.0 * data.rows * recording.sample_period
    gap = np.diff(data.time, prepend=-np.inf, append=np.inf)[np.searchsorted(data.time, sampled, side="right")]
    return np.asarray((since <= LAGS) | (gap > step))


def _average(values: Floats, sampled: Floats, edges: Floats) -> Floats:
    """Average what holds from each of some times [s] on, 0 before, over segments between edges [s], shape (S,)."""
    times = np.append(sampled, max(sampled[-1], edges[-1]) + 1.0)
    summed = np.concatenate([[0.0], np.cumsum(values * np.diff(times))])
    return np.asarray(np.diff(np.interp(edges, times, summed)) / np.diff(edges))


def _covered(time: Floats, start: Floats, end: Floats) -> Bools:
    """Whether each time lies within one of some stretches."""
    if not len(start):
        return np.zeros(len(time), dtype=bool)
    order = np.argsort(start, kind="stable")
    last = np.searchsorted(start[order], time, side="right") - 1
    return np.asarray((last >= 0) & (time < np.maximum.accumulate(end[order])[np.maximum(last, 0)]))
