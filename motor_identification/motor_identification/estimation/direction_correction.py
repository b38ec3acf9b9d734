"""Which way a single-channel motor turned, from the motion that a first fit has found: the encoder does not say.

The reported sign comes late, and where the bridge is slow or a load drives, it can be wrong for many edges. A fitted
model knows better wherever it is surely moving.
"""

from dataclasses import dataclass, replace
from math import sqrt

import numpy as np

from motor_identification.estimation.problem import Problem
from motor_identification.measurement.build_intervals import intervals_between, intervals_of_changes
from motor_identification.measurement.edges import edges_of
from motor_identification.measurement.intervals import Intervals
from motor_identification.measurement.sampled_counts import changes_of, in_runs
from motor_identification.recording import Floats, Integers, Recording
from motor_model.sample import Measurement
from motor_model.simulate import NOWHERE, roll_out

SURELY = 4.0  # times the fit's residual that the simulated speed must have for its sign to count
LESS, ROUNDS = 0.5, 4  # of the residual: where it falls below that, directions are judged once more


def redirected(problem: Problem, place: Floats) -> Problem:
    """The same problem with every edge's direction judged by the motion at a fitted place (D,).

    As long as stretches are read the wrong way, the residual is theirs, and much is left open; once they are out of it,
    the rest is judged by what it really is.
    """
    rms = sqrt(problem.cost(place))
    for _ in range(ROUNDS):
        problem = _read_again(problem, place, SURELY * rms)
        before, rms = rms, sqrt(problem.cost(place))
        if not rms < LESS * before:
            break
    return problem


def _read_again(problem: Problem, place: Floats, surely: float) -> Problem:
    """The same problem with the sign of the simulated speed wherever it exceeds `surely` [rad/s]."""
    vectors, starts = problem.unknowns.decode(place[None])
    intervals = []
    for r, (recording, data) in enumerate(zip(problem.recordings, problem.intervals, strict=True)):
        reader = _READERS.get(recording.info.measurement)
        if reader is None or not recording.info.single_channel:
            intervals.append(data)
            continue
        motion = _Motion(vectors[0, r], float(starts[0, r]), problem.commands[r])
        intervals.append(reader(recording, motion, surely))
    return problem.read_again(tuple(intervals))


@dataclass(frozen=True)
class _Motion:
    """A fitted motor under a recording's commands."""

    vector: Floats
    start: float  # [rad/s]
    command: tuple[Floats, Floats]

    def speed_at(self, time: Floats) -> Floats:
        """[rad/s] at ascending times [s]."""
        every = np.concatenate([[0.0], time])
        angle, speed = np.empty(len(every)), np.empty(len(every))
        roll_out(self.vector, self.start, *self.command, every, NOWHERE, angle, speed)
        return speed[1:]


def _edges_again(recording: Recording, motion: _Motion, surely: float) -> Intervals:
    edges = edges_of(recording)
    direction = judged(edges.direction, motion.speed_at(edges.time), surely)
    return intervals_between(recording, replace(edges, direction=direction))


def _counts_again(recording: Recording, motion: _Motion, surely: float) -> Intervals:
    changes = changes_of(recording)
    way = judged(changes.way, motion.speed_at(recording.time[changes.sample]), surely)
    return intervals_of_changes(recording, in_runs(changes.sample, way))


_READERS = {Measurement.EDGES: _edges_again, Measurement.COUNTS: _counts_again}


def judged(reported: Integers, simulated: Floats, surely: float) -> Integers:
    """Directions of edges (E,): the simulated speed's sign where it exceeds `surely` [rad/s]; below that the reported
    one where both agree, else 0 for open."""
    sign = np.sign(simulated).astype(np.int64)
    return np.where(np.abs(simulated) > surely, sign, np.where(sign == reported, reported, 0))
