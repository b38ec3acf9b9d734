"""Compute speed residuals: simulated minus measured mean speed of every interval, for a swarm of motors."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Generic, TypeVar

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Floats, Integers
from motor_model.compiled import compiled
from motor_model.sensing.encoder import show
from motor_model.simulate import roll_out

T = TypeVar("T")

LEAST_THREADED_STEPS = 50_000  # steps of motion (some 3 ms) for which it pays to start threads


@compiled
def fill_residuals(
    angle: Floats, time: Floats, first: Integers, last: Integers, speed: Floats, slack: Floats, residual: Floats
) -> None:
    """Fill simulated minus measured mean speed [rad/s] of every interval, from the simulated angle [rad] at `time`."""
    for i in range(len(first)):
        duration = time[last[i]] - time[first[i]]
        travel = angle[last[i]] - angle[first[i]]
        if slack[i] > 0.0:
            excess = max(abs(travel) - slack[i], 0.0)
            residual[i] = excess / duration if travel > 0.0 else -excess / duration
        else:
            residual[i] = travel / duration - speed[i]


def compute_residuals(intervals: Intervals, angle: Floats) -> Floats:
    """Compute simulated minus measured mean speed [rad/s] (I,) from the simulated angle [rad] at `intervals.time`."""
    residual = np.empty(len(intervals.first))
    fill_residuals(angle, intervals.time, intervals.first, intervals.last, intervals.speed, intervals.slack, residual)
    return residual


@compiled
def fill_swarm(
    vectors: Floats,
    starts: Floats,
    command_time: Floats,
    command: Floats,
    time: Floats,
    anchor: Floats,
    first: Integers,
    last: Integers,
    speed: Floats,
    slack: Floats,
    residuals: Floats,
) -> None:
    """Fill the residuals (S, I) of a swarm of motors over one recording; see `Intervals` for the data."""
    angle, shaft = np.empty(len(time)), np.empty(len(time))
    for s in range(len(vectors)):
        roll_out(vectors[s], starts[s], command_time, command, time, anchor, angle, shaft)
        show(vectors[s], angle, anchor)
        fill_residuals(angle, time, first, last, speed, slack, residuals[s])


def simulate_residuals(
    vectors: Floats,
    starts: Floats,
    command: tuple[Floats, Floats],
    anchor: Floats,
    intervals: Intervals,
    workers: int,
) -> Floats:
    """Simulate a swarm over one recording: residuals (S, I) [rad/s].

    vectors: parameters, shape (S, P). starts: [rad/s] initial speeds, shape (S,). command, anchor: of the
    recording, see `Problem`.
    """
    residuals = np.empty((len(vectors), len(intervals.first)))
    steps = len(intervals.time) + len(command[0])
    threads = max(workers, 1) if len(vectors) * steps > LEAST_THREADED_STEPS else 1
    share = -(-len(vectors) // threads)
    parts = [slice(i, i + share) for i in range(0, len(vectors), share)]

    def work(part: slice) -> None:
        fill_swarm(
            np.ascontiguousarray(vectors[part]), np.ascontiguousarray(starts[part]), *command, intervals.time, anchor,
            intervals.first, intervals.last, intervals.speed, intervals.slack, residuals[part],
        )  # fmt: skip

    if len(parts) == 1:
        work(parts[0])
    else:
        with ThreadPoolExecutor(len(parts)) as pool:
            list(pool.map(work, parts))
    return residuals


class Latest(Generic[T]):
    """Keep what was computed at the latest few θ: a fit, its start and its end ask again. Threads may share it."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._entries: tuple[tuple[bytes, T], ...] = ()  # newest first; replaced as a whole

    def find(self, theta: Floats, compute: Callable[[], T]) -> T:
        """Find the value at θ (D,), or compute it."""
        key = theta.tobytes()
        for known, value in self._entries:
            if known == key:
                return value
        value = compute()
        self._entries = ((key, value), *self._entries)[: self._most]
        return value
