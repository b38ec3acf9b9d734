"""Which way a single-channel motor turned, from the motion that a first fit has found: the encoder does not say.

The reported sign comes late, and where the bridge is slow or a load drives, it can be wrong for many edges. A fitted
model knows better wherever it is surely moving.
"""

from dataclasses import replace

import numpy as np

from motor_identification.edges import edges_of
from motor_identification.intervals import Intervals, intervals_between
from motor_identification.problem import Problem
from motor_identification.recording import Floats, Integers, Recording
from motor_model.sample import Measurement
from motor_model.simulate import roll_out

SURELY = 4.0  # times the fit's residual that the simulated speed must have for its sign to count


def redirected(problem: Problem, place: Floats) -> Problem:
    """The same problem with every edge's direction judged by the motion at a fitted place (D,)."""
    rms = float(np.sqrt(problem.costs(place[None])[0]))
    vectors, starts = problem.unknowns.decode(place[None])
    intervals = []
    for r, (recording, data) in enumerate(zip(problem.recordings, problem.intervals, strict=True)):
        info = recording.info
        if info.measurement is not Measurement.EDGES or not info.single_channel:
            intervals.append(data)
            continue
        intervals.append(_again(recording, problem.commands[r], vectors[0], float(starts[0, r]), SURELY * rms))
    return replace(problem, intervals=tuple(intervals))


def _again(
    recording: Recording, command: tuple[Floats, Floats], vector: Floats, start: float, surely: float
) -> Intervals:
    edges = edges_of(recording)
    time = np.concatenate([[0.0], edges.time])
    angle, speed = np.empty(len(time)), np.empty(len(time))
    roll_out(vector, start, *command, time, angle, speed)
    return intervals_between(recording, replace(edges, direction=judged(edges.direction, speed[1:], surely)))


def judged(reported: Integers, simulated: Floats, surely: float) -> Integers:
    """Directions of edges (E,): the simulated speed's sign where it exceeds `surely` [rad/s]; below that the reported
    one where both agree, else 0 for open."""
    sign = np.sign(simulated).astype(np.int64)
    return np.where(np.abs(simulated) > surely, sign, np.where(sign == reported, reported, 0))
