"""Intervals: what a recording says about the motion, as mean speeds between instants at which the angle is known.

Every kind of recording becomes intervals with a measured mean speed. An edge is an exact angle at a time known to the
timer's tick, so that between two reported edges the mean speed is Δcount·(2π/N)/Δt. Comparing angle *increments* keeps
an early error from growing through the whole recording, as it does when the angle itself is compared.
"""

from dataclasses import dataclass, replace
from math import sqrt, tau

import numpy as np

from motor_identification.counts import Changes, changes_of, fixes_of
from motor_identification.edges import Edges, edges_of, turned_one_way
from motor_identification.plausible import check_counts
from motor_identification.recording import Bools, Floats, Integers, Recording
from motor_identification.standing import standing_at_edges, standing_at_turns
from motor_model.compiled import compiled
from motor_model.errors import RecordingError
from motor_model.sample import Measurement


@dataclass(frozen=True)
class Intervals:
    """Measured mean speeds; arrays of shape (I,), indices into `time` of shape (K,).

    `slack` [rad] is how far the motor may move without contradicting the measurement: one slot where no edge came.
    `blur` [rad] is how well the angle is known at both ends, given perfect slots: the tick of the timer that stamps
    edges, or the sampling of counts. `edge` numbers the edges at both ends, where the ends are edges.
    """

    time: Floats  # [s] ascending; time[0] is the recording's start
    first: Integers
    last: Integers
    speed: Floats  # [rad/s] signed mean between time[first] and time[last]
    slack: Floats  # [rad]
    blur: Floats  # [rad] standard deviation of the angle at either end
    edge: Integers  # (I, 2) numbers of the first and the last edge; −1 where there is none
    slot: float  # [rad] 0 where nothing is known of the slots
    left_out: int  # intervals that contain a reversal, or whose direction is open

    @property
    def duration(self) -> Floats:
        """[s] length of every interval, shape (I,)."""
        return np.asarray(self.time[self.last] - self.time[self.first])

    @property
    def sigma(self) -> Floats:
        """[rad/s] what the blur of both ends leaves in the mean speed, shape (I,)."""
        return np.asarray(sqrt(2.0) * self.blur / self.duration)

    def floor_squared(self, slot_sigma: float) -> Floats:
        """[rad²/s²] what the blur and flanks off by `slot_sigma` [rad] leave in the mean speed, shape (I,)."""
        flanks = np.where(self.slack > 0.0, 0.0, 2.0 * (slot_sigma / self.duration) ** 2)
        return np.asarray(self.sigma**2 + flanks)

    @property
    def fresh(self) -> Bools:
        """Which intervals do not begin where the one before ended, shape (I,)."""
        follows = np.zeros(len(self.first), dtype=bool)
        follows[1:] = (self.first[1:] == self.last[:-1]) & (self.slack[1:] == 0.0) & (self.slack[:-1] == 0.0)
        return np.asarray(~follows)


def intervals_of(recording: Recording) -> Intervals:
    """What the recording says about the motion.

    Raises:
        RecordingError: there is less than three intervals of motion in it, or its numbers are those of no motor.
    """
    if recording.info.measurement is not Measurement.SPEED:
        check_counts(recording)
    intervals = _READERS[recording.info.measurement](recording)
    if len(intervals.first) < 3:
        raise RecordingError(
            f"{recording.uri} shows only {len(intervals.first)} stretches of motion: record longer, or with more "
            "voltage."
        )
    return intervals


def _from_edges(recording: Recording) -> Intervals:
    return intervals_between(recording, edges_of(recording))


def intervals_between(recording: Recording, edges: Edges) -> Intervals:
    """What stamped edges with known directions say about the motion."""
    slot = tau / recording.info.edges_per_revolution
    good = turned_one_way(edges)
    first, last = edges.only(np.flatnonzero(good)), edges.only(np.flatnonzero(good) + 1)
    speed = last.direction * np.abs(last.count - first.count) * slot / (last.time - first.time)
    # A stamp is uniform over a tick τ: its standard deviation is τ/√12, and that of the angle ω times as much.
    blur = np.abs(speed) * recording.info.edge_resolution / sqrt(12.0)
    moving = _indexed(
        first.time,
        last.time,
        speed,
        blur,
        edge=np.column_stack([first.count, last.count]),
        slot=slot,
        left_out=int(np.count_nonzero(~good)),
    )
    return _with_still(moving, standing_at_edges(recording, edges, ~good), slot)


def _from_counts(recording: Recording) -> Intervals:
    return intervals_of_changes(recording, changes_of(recording))


def intervals_of_changes(recording: Recording, changes: Changes) -> Intervals:
    """What counts read at the samples say, as mean speeds between the instants at which they fix the angle."""
    slot = tau / recording.info.edges_per_revolution
    fixes = fixes_of(recording, changes)
    good = (np.diff(fixes.run) == 0) & (fixes.way[1:] != 0) & (np.diff(fixes.time) > 0.0)
    begin, end = np.flatnonzero(good), np.flatnonzero(good) + 1
    start, stop = fixes.time[begin], fixes.time[end]
    speed = fixes.way[end] * (fixes.place[end] - fixes.place[begin]) * slot / (stop - start)
    # An interval's end is the next one's start; where a run begins, both ends have the larger blur.
    fresh = np.diff(begin, prepend=-2) != 1
    blur = slot * np.where(fresh, np.maximum(fixes.blur[begin], fixes.blur[end]), fixes.blur[end])
    moving = _indexed(start, stop, speed, blur, left_out=int(np.count_nonzero(~good)))
    return _with_still(moving, standing_at_turns(recording, changes), slot)


def _from_speed(recording: Recording) -> Intervals:
    """A logged speed is a mean over the source's window."""
    info = recording.info
    window = info.speed_window if info.speed_window > 0.0 else 1e-6
    middle = recording.time - info.speed_lag
    start, end = middle - 0.5 * window, middle + 0.5 * window
    inside = start >= -1e-9
    # Where it is a mean of counts, the angle at either end of the window is truncated to one.
    count = tau / info.edges_per_revolution if info.edges_per_revolution and info.speed_window else 0.0
    start, end = np.round(np.maximum(start[inside], 0.0), 9), np.round(end[inside], 9)
    return _indexed(start, end, speed=recording.speed[inside], blur=np.full(len(start), count / sqrt(12.0)))


_READERS = {Measurement.EDGES: _from_edges, Measurement.COUNTS: _from_counts, Measurement.SPEED: _from_speed}


def _indexed(
    start: Floats,
    end: Floats,
    speed: Floats,
    blur: Floats,
    slack: Floats | None = None,
    edge: Integers | None = None,
    slot: float = 0.0,
    left_out: int = 0,
) -> Intervals:
    """Intervals over one ascending list of times that starts with the recording."""
    count = len(start)
    time, index = np.unique(np.concatenate([[0.0], start, end]), return_inverse=True)
    return Intervals(
        time=time,
        first=index[1 : count + 1].astype(np.int64),
        last=index[count + 1 :].astype(np.int64),
        speed=speed,
        slack=np.zeros(count) if slack is None else slack,
        blur=blur,
        edge=np.full((count, 2), -1) if edge is None else edge,
        slot=slot,
        left_out=left_out,
    )


def _with_still(moving: Intervals, still: tuple[Floats, Floats], slack: float) -> Intervals:
    """Together with times [s] in which the motor moved less than `slack` [rad], at the end of the list."""
    start, end = still
    blank = np.zeros(len(start))
    return _indexed(
        np.concatenate([moving.time[moving.first], start]),
        np.concatenate([moving.time[moving.last], end]),
        speed=np.concatenate([moving.speed, blank]),
        slack=np.concatenate([moving.slack, blank + slack]),
        blur=np.concatenate([moving.blur, blank]),
        edge=np.concatenate([moving.edge, np.full((len(blank), 2), -1)]),
        slot=moving.slot,
        left_out=moving.left_out,
    )


def without(intervals: Intervals, bad: Bools) -> Intervals:
    """The intervals that are not marked; shape of `bad`: (I,)."""
    good = ~bad
    return replace(
        intervals,
        first=intervals.first[good],
        last=intervals.last[good],
        speed=intervals.speed[good],
        slack=intervals.slack[good],
        blur=intervals.blur[good],
        edge=intervals.edge[good],
        left_out=intervals.left_out + int(bad.sum()),
    )


def joined(intervals: Intervals, duration: float) -> Intervals:
    """The intervals with those that follow each other joined until each is at least `duration` [s] long.

    A mean speed over many slots says as much about the motor as those over its parts, but for what happens within it.
    """
    if len(intervals.first) == 0:
        return intervals
    group = np.empty(len(intervals.first), dtype=np.int64)
    _group(intervals.fresh, intervals.duration, duration, group)
    begin = np.flatnonzero(np.diff(group, prepend=-1))
    end = np.append(begin[1:], len(group)) - 1
    travel = np.add.reduceat(intervals.speed * intervals.duration, begin)
    start_time, end_time = intervals.time[intervals.first[begin]], intervals.time[intervals.last[end]]
    return _indexed(
        start_time,
        end_time,
        speed=travel / (end_time - start_time),
        blur=np.maximum.reduceat(intervals.blur, begin),
        slack=intervals.slack[begin],
        edge=np.column_stack([intervals.edge[begin, 0], intervals.edge[end, 1]]),
        slot=intervals.slot,
        left_out=intervals.left_out,
    )


@compiled
def _group(fresh: Bools, duration: Floats, least: float, group: Integers) -> None:
    """Number the intervals by the longer ones they are joined to."""
    number, length = -1, 0.0
    for k in range(len(fresh)):
        if fresh[k] or length >= least:
            number, length = number + 1, 0.0
        group[k] = number
        length += duration[k]
