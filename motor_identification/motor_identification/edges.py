"""The edges that samples report: which edge, when, and which way the disc turned."""

from dataclasses import dataclass

import numpy as np

from motor_identification.recording import Floats, Integers, Recording


@dataclass(frozen=True)
class Edges:
    """Reported edges in order of time; arrays of shape (E,).

    A sample reports its latest edge and, through `edge_period`, the one before it; the edges in between are only
    counted. `direction` is 0 where a single channel leaves it open.
    """

    time: Floats  # [s] since the first sample
    count: Integers  # edges passed since the first sample, always growing for a single channel
    direction: Integers  # −1, 0, +1


def edges_of(recording: Recording) -> Edges:
    """All edges since the first sample that a recording reports.

    A stamp is the timer's last tick before the edge, so that half a tick is added.
    """
    info, count, stamp = recording.info, recording.edge_count, recording.edge_time
    fresh = np.flatnonzero(np.diff(count, prepend=count[0]) != 0)
    steps = np.diff(count[fresh], prepend=count[0])
    latest = (stamp[fresh] - recording.sample_time[0]) * 1e-9 + 0.5 * info.edge_resolution
    period = recording.edge_period[fresh]
    direction = _directions(recording.speed[fresh])
    second = (np.abs(steps) >= 2) & (period > 0.0) & (latest - period > 0.0)
    time = np.concatenate([(latest - period)[second], latest])
    numbers = np.concatenate([(count[fresh] - np.sign(steps))[second], count[fresh]])
    order = np.argsort(time, kind="stable")
    edges = Edges(time[order], (numbers - count[0])[order], np.concatenate([direction[second], direction])[order])
    return _turned_at_the_slowest(edges, recording) if info.single_channel else edges


def _directions(speed: Floats) -> Integers:
    """The reported signs at samples with a fresh edge; the first edge ever has none and takes the next one's."""
    sign = np.sign(speed).astype(np.int64)
    return np.where(sign == 0, np.append(sign[1:], 0), sign)


def _turned_at_the_slowest(edges: Edges, recording: Recording) -> Edges:
    """Move each change of sign back to where the motor really turned: its slowest interval.

    A single channel's reported sign changes only after the speed has visibly risen again, a few edges late. The motor
    may also have turned in the interval beside the slowest, so the direction of the two edges around it stays open.
    """
    direction = edges.direction.copy()
    changes = np.flatnonzero(direction[1:] * direction[:-1] < 0) + 1
    with np.errstate(divide="ignore"):
        speed = np.abs(np.diff(edges.count)) / np.diff(edges.time)
    for change in changes:
        new = direction[change]
        opposed = _opposed_since(recording, edges.time[change], new)
        first = int(np.searchsorted(edges.time, opposed, side="left")) - 1
        first = max(min(first, change - 1), 0)
        slowest = first + int(np.argmin(speed[first:change]))
        direction[slowest + 1 : change] = new
        direction[slowest : slowest + 2] = 0
    return Edges(edges.time, edges.count, direction)


def _opposed_since(recording: Recording, time: float, new_direction: int) -> float:
    """[s] when the voltage last began to drive the way the motor turned before `time`."""
    k = int(np.searchsorted(recording.time, time, side="right")) - 1
    against = recording.voltage[: k + 1] * new_direction < 0.0
    last = np.flatnonzero(against)
    return float(recording.time[last[-1]]) if len(last) else 0.0
