"""Hold intervals: what a recording says of the motion, as mean speeds between instants of known angle.

Comparing angle *increments* keeps an early error from growing through the whole recording, as it does when the angle
itself is compared. `build_intervals.py` makes them of every kind of recording.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import sqrt

import numpy as np

from motor_identification.recording import Bools, Floats, Integers
from motor_model.compiled import compiled

UNEVEN_ROWS = 0.05  # of a row: what most of them, all but a fifth, differ by where their lengths are by chance


@dataclass(frozen=True)
class Intervals:
    """Measured mean speeds; arrays of shape (I,), indices into `time` of shape (K,).

    `slack` [rad] is how far the motor may move without contradicting the measurement: one slot where no edge came.
    `blur` [rad] is how well the angle is known at both ends, given perfect slots: the tick of the timer that stamps
    edges, or the sampling of counts. Intervals that follow each other share the error of their common end, unless they
    are `independent`: speeds with white noise. `edge` numbers the edges at both ends, where the ends are edges; `place`
    [rad] is the angle that was counted there since the recording's start, where a sensor counts both ways. How much
    worse than that a sensor may be is a share of `unit`: of the angle at either end, or of each logged speed.
    """

    time: Floats  # [s] ascending; time[0] is the recording's start
    first: Integers
    last: Integers
    speed: Floats  # [rad/s] signed mean between time[first] and time[last]
    slack: Floats  # [rad]
    blur: Floats  # [rad] standard deviation of the angle at either end
    edge: Integers  # (I, 2) numbers of the first and the last edge; −1 where there is none
    place: Floats  # (I, 2) [rad] within a slot; NaN where nothing counts it
    slot: float  # [rad] 0 where nothing is known of the slots
    left_out: int  # intervals that contain a reversal, or whose direction is open
    independent: bool = False  # whether each interval has an error of its own at either end
    gear: float = 1.0  # turns of the encoder's shaft, with which slots and ripples repeat, per turn of the output
    unevenness: float = 1.0  # times as irregular as the flanks of one channel its slots may be
    window: float = 0.0  # [s] that each logged speed is a mean over; 0 between measured angles
    noise: float = 0.0  # [rad] what is known of a logged speed's noise, at either end of its window

    @property
    def unit(self) -> float:
        """[rad] what a sensor's unknown errors are a share of: a slot, or a logged speed's noise; 0 where neither."""
        return self.noise if self.window > 0.0 else self.slot

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
        if self.window > 0.0:  # joined speeds have an error each, not one at either end
            flanks = flanks * (self.duration / self.window)
        return np.asarray(self.sigma**2 + flanks)

    @property
    def counts_both_ways(self) -> bool:
        """Whether the angle is known from any interval to any other."""
        return bool(np.isfinite(self.place).any())

    @property
    def tells_of_disc(self) -> bool:
        """Whether what is on the encoder's disc would show.

        Not where every value has a white noise, of what may count nothing; nor in speeds of rows whose lengths, or the
        stamps that tell them, are by chance: that scatters as they do, by a share of the speed.
        """
        if self.independent or self.window == 0.0 or len(self.last) < 2:
            return not self.independent
        low, middle, high = np.quantile(np.diff(self.time[self.last]), (0.1, 0.5, 0.9))
        return bool(high - low < UNEVEN_ROWS * middle)

    @property
    def fresh(self) -> Bools:
        """Which intervals begin with an error of their own, shape (I,): not with that of the one before."""
        return np.ones(len(self.first), dtype=bool) if self.independent else self.apart

    @property
    def apart(self) -> Bools:
        """Which intervals do not begin where the one before ended, shape (I,)."""
        follows = np.zeros(len(self.first), dtype=bool)
        follows[1:] = (self.first[1:] == self.last[:-1]) & (self.slack[1:] == 0.0) & (self.slack[:-1] == 0.0)
        return np.asarray(~follows)


def index_intervals(
    start: Floats,
    end: Floats,
    speed: Floats,
    blur: Floats,
    slack: Floats | None = None,
    edge: Integers | None = None,
    place: Floats | None = None,
    slot: float = 0.0,
    left_out: int = 0,
    independent: bool = False,
    gear: float = 1.0,
    unevenness: float = 1.0,
    window: float = 0.0,
    noise: float = 0.0,
) -> Intervals:
    """Index intervals over one ascending list of times that starts with the recording."""
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
        place=np.full((count, 2), np.nan) if place is None else place,
        slot=slot,
        left_out=left_out,
        independent=independent,
        gear=gear,
        unevenness=unevenness,
        window=window,
        noise=noise,
    )


def append_standstills(moving: Intervals, still: tuple[Floats, Floats], slack: float) -> Intervals:
    """Append times [s] in which the motor moved less than `slack` [rad], at the end of the list."""
    start, end = still
    blank = np.zeros(len(start))
    return index_intervals(
        np.concatenate([moving.time[moving.first], start]),
        np.concatenate([moving.time[moving.last], end]),
        speed=np.concatenate([moving.speed, blank]),
        slack=np.concatenate([moving.slack, blank + slack]),
        blur=np.concatenate([moving.blur, blank]),
        edge=np.concatenate([moving.edge, np.full((len(blank), 2), -1)]),
        place=np.concatenate([moving.place, np.full((len(blank), 2), np.nan)]),
        slot=moving.slot,
        left_out=moving.left_out,
        gear=moving.gear,
        unevenness=moving.unevenness,
    )


def exclude_intervals(intervals: Intervals, bad: Bools) -> Intervals:
    """Exclude marked intervals; shape of `bad`: (I,)."""
    good = ~bad
    return replace(
        intervals,
        first=intervals.first[good],
        last=intervals.last[good],
        speed=intervals.speed[good],
        slack=intervals.slack[good],
        blur=intervals.blur[good],
        edge=intervals.edge[good],
        place=intervals.place[good],
        left_out=intervals.left_out + int(bad.sum()),
    )


def share_noise(intervals: Sequence[Intervals]) -> tuple[Intervals, ...]:
    """Give all recordings of logged speeds one sensor's noise: what is unknown of it is a share of the same unit.

    An angle's where speeds were counted, a speed's where their noise is white, whatever the window.
    """
    counts = [data.noise for data in intervals if data.window > 0.0 and not data.independent]
    speeds = [data.noise / data.window for data in intervals if data.window > 0.0 and data.independent]

    def common(data: Intervals) -> float:
        return float(np.median(speeds)) * data.window if data.independent else float(np.median(counts))

    return tuple(replace(data, noise=common(data)) if data.window > 0.0 else data for data in intervals)


def join_intervals(intervals: Intervals, duration: float) -> Intervals:
    """Join intervals that follow each other until each is at least `duration` [s] long.

    A mean speed over many slots says as much about the motor as those over its parts, but for what happens within it.
    """
    if len(intervals.first) == 0:
        return intervals
    group = np.empty(len(intervals.first), dtype=np.int64)
    _group(intervals.apart, intervals.duration, duration, group)
    begin = np.flatnonzero(np.diff(group, prepend=-1))
    end = np.append(begin[1:], len(group)) - 1
    travel = np.add.reduceat(intervals.speed * intervals.duration, begin)
    start_time, end_time = intervals.time[intervals.first[begin]], intervals.time[intervals.last[end]]
    blur = np.maximum.reduceat(intervals.blur, begin)
    if intervals.independent:  # their errors add up, and do not go from one to the next
        blur = np.sqrt(np.add.reduceat(intervals.blur**2, begin))
    return index_intervals(
        start_time,
        end_time,
        speed=travel / (end_time - start_time),
        blur=blur,
        slack=intervals.slack[begin],
        edge=np.column_stack([intervals.edge[begin, 0], intervals.edge[end, 1]]),
        place=np.column_stack([intervals.place[begin, 0], intervals.place[end, 1]]),
        slot=intervals.slot,
        left_out=intervals.left_out,
        independent=intervals.independent,
        gear=intervals.gear,
        unevenness=intervals.unevenness,
        window=intervals.window,
        noise=intervals.noise,
    )


@compiled
def _group(apart: Bools, duration: Floats, least: float, group: Integers) -> None:
    """Number the intervals by the longer ones they are joined to."""
    number, length = -1, 0.0
    for k in range(len(apart)):
        if apart[k] or length >= least:
            number, length = number + 1, 0.0
        group[k] = number
        length += duration[k]
