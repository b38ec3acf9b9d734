"""Hold intervals: what a recording says of the motion, as mean speeds between instants of known angle.

Comparing angle *increments* keeps an early error from growing through the whole recording, as it does when the angle
itself is compared. `build_intervals.py` makes them of every kind of recording, and `edit_intervals.py` others of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import sqrt, tau

import numpy as np

from motor_identification.recording import Bools, Floats, Integers, Recording
from motor_identification.sensor.pulses.missed_edges import MissedShare

UNEVEN_ROWS = 0.05  # of a row: what most of them, all but a fifth, differ by where their lengths are by chance
TURNS_FOLLOWED = 0.1  # of the values that move: so many are less than a turn apart, of a log that follows the turns


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
    missed: MissedShare | None = None  # of all edges, where so many are that those in between do not count
    rows: int = 1  # of the recording that were joined to one: of a long log, far quicker ones than the motion
    learned: float = 1.0  # of a logged speed's assumed noise, what a fit has shown it to be at most: `blur` is that

    @property
    def unit(self) -> float:
        """[rad] what a sensor's unknown errors are a share of: a slot, or a logged speed's noise; 0 where neither."""
        return self.noise if self.window > 0.0 else self.slot

    @property
    def has_assumed_noise(self) -> bool:
        """Whether these are logged speeds with white noise, as their values seemed to have: an upper bound."""
        return self.independent and self.window > 0.0 and self.noise > 0.0

    @property
    def assumed_blur(self) -> Floats:
        """[rad] `blur` before anything was learned of it, shape (I,)."""
        return np.asarray(self.blur / self.learned)

    @property
    def tells_noise(self) -> Bools:
        """Whether what is left of an interval tells of that noise, shape (I,): no standstill, nor what is known."""
        return np.asarray((self.slack == 0.0) & (self.blur > 0.0))

    def sum_noise(self, increments: Floats, marks: Bools | None = None) -> tuple[float, int]:
        """Sum the squares of increments (I,) [rad] of an angle in units of the noise assumed of each, and count them.

        Two instants make an increment. marks: the intervals that count, shape (I,); all, without.
        """
        if not self.has_assumed_noise:
            return 0.0, 0
        told = self.tells_noise if marks is None else self.tells_noise & marks
        return float(np.sum((increments[told] / self.assumed_blur[told]) ** 2)) / 2.0, int(np.count_nonzero(told))

    def with_noise(self, share: float) -> "Intervals":
        """The same speeds, if noise was assumed of them with a share of that; standstills are as sharp as they were."""
        if not self.has_assumed_noise or share == self.learned:
            return self
        blur = np.where(self.slack > 0.0, self.blur, self.assumed_blur * share)
        return replace(self, blur=blur, learned=share)

    def find_rows(self, recording: Recording) -> Integers:
        """Find the rows of their recording that hold in the middle of every interval, shape (I,)."""
        middle = 0.5 * (self.time[self.first] + self.time[self.last])
        return np.maximum(np.searchsorted(recording.time, middle, side="right") - 1, 0)

    @cached_property
    def duration(self) -> Floats:
        """[s] length of every interval, shape (I,)."""
        return np.asarray(self.time[self.last] - self.time[self.first])

    @cached_property
    def order(self) -> Integers:
        """Which interval begins first, which next, and so on, shape (I,)."""
        return np.argsort(self.time[self.first], kind="stable")

    @property
    def travel(self) -> Floats:
        """[rad] the motor went in every interval, whichever way, shape (I,)."""
        return np.asarray(np.abs(self.speed) * self.duration)

    @cached_property
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
        stamps that tell them, are by chance: that scatters as they do, by a share of the speed. Unless speeds are known
        to be counts by their own row's length.
        """
        if self.independent or self.window == 0.0 or len(self.last) < 2:
            return not self.independent
        rows = np.diff(self.time[self.last])
        low, middle, high = np.quantile(rows, (0.1, 0.5, 0.9))
        own = np.quantile(np.abs(self.duration[1:] - rows), 0.8) < UNEVEN_ROWS * middle
        return bool(own or high - low < UNEVEN_ROWS * middle)

    @property
    def follows_turns(self) -> bool:
        """Whether what repeats with the angle would show: of the values that move, some are less than a turn apart."""
        gone = np.abs(self.speed[1:]) * np.diff(self.time[self.first]) * self.gear
        return bool(np.any(gone > 0.0) and np.quantile(gone[gone > 0.0], TURNS_FOLLOWED) < tau)

    @cached_property
    def fresh(self) -> Bools:
        """Which intervals begin with an error of their own, shape (I,): not with that of the one before."""
        return np.ones(len(self.first), dtype=bool) if self.independent else self.apart

    @cached_property
    def apart(self) -> Bools:
        """Which intervals do not begin where the one before ended, shape (I,)."""
        follows = np.zeros(len(self.first), dtype=bool)
        follows[1:] = (self.first[1:] == self.last[:-1]) & (self.slack[1:] == 0.0) & (self.slack[:-1] == 0.0)
        return np.asarray(~follows)


def count_turns(intervals: Sequence[Intervals], angles: Sequence[Floats]) -> float:
    """Count the turns of the encoder's shaft between the ends of its motion, in the recording that has most of them.

    angles: [rad] of the output, at the times of each recording's intervals.
    """
    rows = zip(intervals, angles, strict=True)
    return max(data.gear * float(np.ptp(angle)) for data, angle in rows) / tau


def index_times(start: Floats, end: Floats) -> tuple[Floats, Integers, Integers]:
    """Index times [s] over one ascending list of them that starts with the recording: that list, starts, ends."""
    count = len(start)
    time, index = np.unique(np.concatenate([[0.0], start, end]), return_inverse=True)
    return time, index[1 : count + 1].astype(np.int64), index[count + 1 :].astype(np.int64)


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
    """Make intervals from `start` to `end` [s], both of shape (I,), with what is known of them."""
    count = len(start)
    time, first, last = index_times(start, end)
    return Intervals(
        time=time,
        first=first,
        last=last,
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
