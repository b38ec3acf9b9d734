"""Compute speed residuals: simulated minus measured mean speed of every interval, for a swarm of motors."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from motor_identification.measurement.intervals import Intervals
from motor_identification.recording import Floats, Integers
from motor_model.compiled import compiled
from motor_model.sensing.encoder import show
from motor_model.simulate import roll_out

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
    commands: Sequence[tuple[Floats, Floats]],
    anchors: Sequence[Floats],
    intervals: Sequence[Intervals],
    workers: int,
) -> Floats:
    """Simulate a swarm: residuals (S, I) [rad/s], the intervals of R recordings one after the other.

    vectors: parameters, shape (S, R, P). starts: [rad/s] initial speeds, shape (S, R). commands, anchors, intervals: of
    every recording, see `Problem`.
    """
    counts = [len(data.first) for data in intervals]
    residuals = np.empty((len(vectors), sum(counts)))
    steps = sum(len(data.time) + len(time) for data, (time, _) in zip(intervals, commands, strict=True))
    threads = max(workers, 1) if len(vectors) * steps > LEAST_THREADED_STEPS else 1
    share = -(-len(vectors) // threads)
    parts = [slice(i, i + share) for i in range(0, len(vectors), share)]

    def work(part: slice) -> None:
        column = 0
        for r, ((time, voltage), data) in enumerate(zip(commands, intervals, strict=True)):
            alone = len(intervals) == 1  # an hour's residuals are not there twice
            out = residuals[part] if alone else np.empty((len(vectors[part]), counts[r]))
            fill_swarm(
                np.ascontiguousarray(vectors[part, r]), np.ascontiguousarray(starts[part, r]), time, voltage,
                data.time, anchors[r], data.first, data.last, data.speed, data.slack, out,
            )  # fmt: skip
            if not alone:
                residuals[part, column : column + counts[r]] = out
            column += counts[r]

    if len(parts) == 1:
        work(parts[0])
    else:
        with ThreadPoolExecutor(len(parts)) as pool:
            list(pool.map(work, parts))
    return residuals
