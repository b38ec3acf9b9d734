"""Extract the edges that samples report: which edge, when, and which way the disc turned."""

from dataclasses import dataclass

import numpy as np

from motor_identification.measurement.timestamp_checks import mark_possible, mark_smooth
from motor_identification.recording import Bools, Floats, Integers, Recording
from motor_model.sample import Info

LEAST_TICKS = 20.0  # of the timer between two edges of a sample that both count: nearer is off by 2 % or more
MANY_SLOTS = 4  # slots since the voltage turned, from which on a motor that turned was slow in between
STILL_FAST = 0.5  # of the largest speed since the voltage turned: a motor that has turned was slower than this
SLOW_THEN = 0.3  # of the speed before: where it is slower afterwards, it turned there


@dataclass(frozen=True)
class Edges:
    """Reported edges in order of time; arrays of shape (E,).

    A sample reports its latest edge and, through `edge_period`, the one before it; the edges in between are only
    counted. `direction` is 0 where a single channel leaves it open.
    """

    time: Floats  # [s] since the first sample
    count: Integers  # edges passed since the first sample, always growing for a single channel
    direction: Integers  # −1, 0, +1

    def only(self, which: Integers | Bools) -> "Edges":
        """The chosen edges, in the order of `which`."""
        return Edges(self.time[which], self.count[which], self.direction[which])


def extract_edges(recording: Recording) -> Edges:
    """Extract all edges since the first sample that a recording reports, but for those whose stamps are wrong.

    A stamp is the timer's last tick before the edge, so that half a tick is added. Of two edges in a sample that are
    hardly further apart than the timer ticks, the latest one says it all. Counted two- or fourfold the period is a
    mean over a period of channel A, and tells no other edge.
    """
    info, count, stamp = recording.info, recording.edge_count, recording.edge_time
    fresh = np.flatnonzero(np.diff(count, prepend=count[0]) != 0)
    steps = np.diff(count[fresh], prepend=count[0])
    latest = (stamp[fresh] - recording.sample_time[0]) * 1e-9 + 0.5 * info.edge_resolution
    period = recording.edge_period[fresh]
    before, direction = _read_ways(info, recording.speed[fresh], steps, period)
    right = mark_possible(recording, fresh, latest)
    right[right] = mark_smooth(latest[right], _passed(count[fresh][right] - count[0]))
    second = (
        right
        & (info.quadrature <= 1)
        & (np.abs(steps) >= 2)
        & (period > LEAST_TICKS * info.edge_resolution)
        & (latest - period > 0.0)
    )
    second[second] = mark_possible(recording, fresh[second], (latest - period)[second])
    time = np.concatenate([(latest - period)[second], latest[right]])
    numbers = np.concatenate([(count[fresh] - np.sign(steps))[second], count[fresh][right]]) - count[0]
    edges = Edges(time, numbers, np.concatenate([before[second], direction[right]]))
    edges = edges.only(np.argsort(time, kind="stable"))
    edges = edges.only(mark_smooth(edges.time, _passed(edges.count)))
    return move_reversals_to_slowest(edges, recording) if info.single_channel else edges


def _read_ways(info: Info, speed: Floats, steps: Integers, period: Floats) -> tuple[Integers, Integers]:
    """Read which way the disc turned at the edge before the latest of samples (E,), and at the latest."""
    if info.single_channel:
        direction = read_directions(speed)
        return direction, direction
    counted = np.sign(np.where(speed == 0.0, steps, speed)).astype(np.int64)  # which way, where no sign is said
    direction = open_returns(counted, period, info.quadrature)
    # Counted against its latest edge's direction, two channels turned within a sample, before or after the edge before.
    return np.where(direction * steps < 0, 0, direction), direction


def _passed(count: Integers) -> Integers:
    """Edges passed either way, from counts (E,) that two channels also count down."""
    return np.asarray(np.abs(np.diff(count, prepend=0)).cumsum())


def open_returns(direction: Integers, period: Floats, quadrature: int = 1) -> Integers:
    """Leave the direction (E,) open of edges by which a second channel takes the one before back.

    There the shaft leaves a hole by the flank by which it entered it, and the next flank is half a slot away, not one.
    A board tells such edges by a period [s] of 0, whatever was counted before in the same sample and whichever way the
    motor turns next; so it does of the edge after, which is no such edge unless it turns once more. Where every flank
    of both channels counts, the next one is a slot away.
    """
    turned = np.append(False, direction[1:] * direction[:-1] < 0)[: len(direction)]
    first = np.append(False, period[:-1] > 0.0)[: len(direction)] & (quadrature <= 1)
    return np.where((turned | first) & (period == 0.0), 0, direction)


def read_directions(speed: Floats) -> Integers:
    """Read the reported signs at samples with a fresh edge; the first edge ever has none and takes the next one's."""
    sign = np.sign(speed).astype(np.int64)
    return np.where(sign == 0, np.append(sign[1:], 0), sign)


def move_reversals_to_slowest(edges: Edges, recording: Recording) -> Edges:
    """Move each change of sign back to where the motor really turned: its slowest interval.

    A single channel's reported sign changes only after the speed has visibly risen again, a few edges late. The motor
    may also have turned in the interval beside the slowest, so the direction of the two edges around it stays open.
    """
    direction = edges.direction.copy()
    changes = np.flatnonzero(direction[1:] * direction[:-1] < 0) + 1
    with np.errstate(divide="ignore"):
        speed = np.abs(np.diff(edges.count)) / np.diff(edges.time)
    opposed = _opposed_since(recording, edges.time[changes], direction[changes])
    begin = np.searchsorted(edges.time, opposed, side="left") - 1
    # The tick makes the speed between two edges within a sample uneven.
    long = np.diff(edges.time) > 0.5 * recording.info.sample_period
    for change, first, later in zip(changes, begin, _driven_until(edges, recording, changes), strict=True):
        new = direction[change]
        first = max(min(int(first), change - 1), 0)
        slowest = first + int(np.argmin(speed[first:change]))
        before, after = slice(first, change), slice(change, later)
        many = edges.count[change] - edges.count[first] >= MANY_SLOTS
        if many and _is_too_early(speed[before][long[before]], speed[after][long[after]]):
            slowest = change + int(np.argmin(speed[change:later]))
            direction[change : slowest + 1] = -new
        direction[slowest + 1 : change] = new
        direction[slowest : slowest + 2] = 0
    return Edges(edges.time, edges.count, direction)


def _is_too_early(before: Floats, after: Floats) -> bool:
    """Whether a sign changed while the disc still turned fast the old way, by mean speeds [slots/s] over samples.

    Where edges come as fast as the timer ticks, a board takes a tick for a longer period. But the disc cannot have
    turned where it was never slow, if soon after it was.
    """
    if not len(before) or not len(after):
        return False
    return bool(before.min() > STILL_FAST * before.max() and after.min() < SLOW_THEN * before.min())


def _driven_until(edges: Edges, recording: Recording, changes: Integers) -> Integers:
    """Up to which edge the voltage drives the way of each change without a break, and no other sign is reported."""
    clock = recording.time
    latest = np.searchsorted(clock, edges.time[changes], side="right") - 1
    end = np.append(changes[1:], len(edges.time) - 1)
    for way in (-1, 1):
        here = np.flatnonzero(edges.direction[changes] == way)
        otherwise = np.append(np.flatnonzero(recording.voltage * way <= 0.0), len(clock) - 1)
        stop = clock[otherwise[np.minimum(np.searchsorted(otherwise, latest[here] + 1), len(otherwise) - 1)]]
        end[here] = np.minimum(end[here], np.searchsorted(edges.time, stop))
    return np.asarray(np.maximum(end, changes))


def _opposed_since(recording: Recording, time: Floats, new_direction: Integers) -> Floats:
    """[s] when the voltage last began to drive the way the motor turned before each `time`; 0 if it never did."""
    clock = recording.time
    latest = np.searchsorted(clock, time, side="right") - 1
    opposed = np.zeros(len(time))
    for way in (-1, 1):
        here = np.flatnonzero(new_direction == way)
        against = np.where(recording.voltage * way < 0.0, np.arange(len(clock)), -1)
        last = np.maximum.accumulate(against)[latest[here]]
        opposed[here] = np.where(last >= 0, clock[np.maximum(last, 0)], 0.0)
    return opposed


def mark_one_way(edges: Edges) -> Bools:
    """Between which successive edges, shape (E − 1,), the disc is known to have turned one way."""
    here, there = edges.direction[:-1], edges.direction[1:]
    return np.asarray((here == there) & (here != 0) & (np.diff(edges.time) > 0.0))
