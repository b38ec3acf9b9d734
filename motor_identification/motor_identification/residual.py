"""Residuals: what a recording says about the motion, interval by interval, and how far a simulated motion is from it.

Every kind of recording becomes intervals with a measured mean speed. An edge is an exact angle at a time known to the
timer's tick, so that between two reported edges the mean speed is Δcount·(2π/N)/Δt. Comparing angle *increments* keeps
an early error from growing through the whole recording, as it does when the angle itself is compared.
"""

from dataclasses import dataclass
from math import sqrt, tau

import numpy as np

from motor_identification.edges import Edges, edges_of
from motor_identification.recording import Floats, Integers, Recording
from motor_model.compiled import compiled
from motor_model.errors import RecordingError
from motor_model.sample import Measurement

STANDSTILL_MATTERS = 0.1  # [s] without an edge before the lack of edges is evidence


@dataclass(frozen=True)
class Intervals:
    """Measured mean speeds; arrays of shape (I,), indices into `time` of shape (K,).

    `slack` [rad] is how far the motor may move without contradicting the measurement: one slot where no edge came.
    `sigma` [rad/s] is what the timer's tick, or the sampling of counts, leaves in the mean speed.
    """

    time: Floats  # [s] ascending; time[0] is the recording's start
    first: Integers
    last: Integers
    speed: Floats  # [rad/s] signed mean between time[first] and time[last]
    slack: Floats  # [rad]
    sigma: Floats  # [rad/s]
    left_out: int  # intervals that contain a reversal, or whose direction is open

    @property
    def duration(self) -> Floats:
        """[s] length of every interval, shape (I,)."""
        return np.asarray(self.time[self.last] - self.time[self.first])


def intervals_of(recording: Recording) -> Intervals:
    """What the recording says about the motion.

    Raises:
        RecordingError: there is less than three intervals of motion in it.
    """
    intervals = _READERS[recording.info.measurement](recording)
    if len(intervals.first) < 3:
        raise RecordingError(
            f"{recording.uri} shows only {len(intervals.first)} stretches of motion: record longer, or with more "
            "voltage."
        )
    return intervals


def _from_edges(recording: Recording) -> Intervals:
    edges = edges_of(recording)
    slot = tau / recording.info.edges_per_revolution
    between, left_out = _between_edges(edges, slot)
    still = _without_edges(recording, edges, slot)
    start, end, speed, slack = (np.concatenate(pair) for pair in zip(between, still, strict=True))
    # A stamp is uniform over a tick τ, the difference of two has the standard deviation τ/√6.
    sigma = np.abs(speed) * recording.info.edge_resolution / sqrt(6.0) / (end - start)
    return _indexed(start, end, speed, slack, sigma, left_out)


def _between_edges(edges: Edges, slot: float) -> tuple[tuple[Floats, Floats, Floats, Floats], int]:
    """Start, end, mean speed and slack between successive reported edges, and how many were left out."""
    start, end = edges.time[:-1], edges.time[1:]
    here, there = edges.direction[:-1], edges.direction[1:]
    travel = np.abs(np.diff(edges.count)) * slot
    good = (here == there) & (here != 0) & (end > start)
    start, end = start[good], end[good]
    speed = here[good] * travel[good] / (end - start)
    return (start, end, speed, np.zeros(len(start))), int(np.count_nonzero(~good))


def _without_edges(recording: Recording, edges: Edges, slot: float) -> tuple[Floats, Floats, Floats, Floats]:
    """The stretches before the first and after the last edge, in which the motor cannot have moved a whole slot."""
    stop = recording.time[-1]
    first = edges.time[0] if len(edges.time) else stop
    rows = [(0.0, first)] if first > STANDSTILL_MATTERS else []
    if len(edges.time) and stop - edges.time[-1] > STANDSTILL_MATTERS:
        rows.append((edges.time[-1], stop))
    start, end = np.array(rows, dtype=np.float64).reshape(-1, 2).T
    return start, end, np.zeros(len(rows)), np.full(len(rows), slot)


def _from_counts(recording: Recording) -> Intervals:
    """Counts read at the samples: each says that the angle is within one slot, at that instant."""
    slot = tau / recording.info.edges_per_revolution
    changed = np.flatnonzero(np.diff(recording.edge_count, prepend=recording.edge_count[0]) != 0)
    time = recording.time[changed]
    steps = np.diff(recording.edge_count[changed]).astype(np.float64)
    if recording.info.single_channel:
        steps *= np.sign(recording.speed[changed[1:]])
    start, end = time[:-1], time[1:]
    # The count truncates the angle by up to a slot at both ends.
    sigma = slot / sqrt(6.0) / (end - start)
    return _indexed(start, end, steps * slot / (end - start), np.zeros(len(start)), sigma, 0)


def _from_speed(recording: Recording) -> Intervals:
    """A logged speed is a mean over the source's window."""
    info = recording.info
    window = info.speed_window if info.speed_window > 0.0 else 1e-6
    middle = recording.time - info.speed_lag
    start, end = middle - 0.5 * window, middle + 0.5 * window
    inside = start >= -1e-9
    quantum = tau / info.edges_per_revolution / window if info.edges_per_revolution and info.speed_window else 0.0
    sigma = np.full(len(middle), quantum / sqrt(6.0))
    start = np.maximum(start[inside], 0.0)
    return _indexed(start, end[inside], recording.speed[inside], np.zeros(len(start)), sigma[inside], 0)


_READERS = {Measurement.EDGES: _from_edges, Measurement.COUNTS: _from_counts, Measurement.SPEED: _from_speed}


def _indexed(start: Floats, end: Floats, speed: Floats, slack: Floats, sigma: Floats, left_out: int) -> Intervals:
    """Intervals over one ascending list of times that starts with the recording."""
    time, index = np.unique(np.concatenate([[0.0], start, end]), return_inverse=True)
    first, last = index[1 : len(start) + 1], index[len(start) + 1 :]
    return Intervals(time, first.astype(np.int64), last.astype(np.int64), speed, slack, sigma, left_out)


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
