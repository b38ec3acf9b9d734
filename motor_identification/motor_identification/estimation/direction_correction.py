"""Correct the directions of a single-channel encoder, which it does not measure, by the motion that a fit has found.

The reported sign comes late, and where the bridge is slow or a load drives, it can be wrong for many edges. A fitted
model knows better wherever it is surely moving.
"""

from dataclasses import dataclass, replace
from math import sqrt

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.problem import Problem
from motor_identification.measurement.build_intervals import make_count_intervals, make_edge_intervals
from motor_identification.measurement.edges import extract_edges
from motor_identification.measurement.intervals import Intervals
from motor_identification.measurement.sampled_counts import extract_count_changes, number_runs
from motor_identification.recording import Floats, Integers, Recording
from motor_model.sample import Measurement
from motor_model.simulate import NOWHERE, roll_out

SURE_SPEED = 4.0  # times the fit's residual that the simulated speed must have for its sign to count
WORTH_ANOTHER_ROUND = 0.5  # of the residual before: where it falls below that, directions are chosen once more,
MOST_ROUNDS = 4  # so often at most


def correct_directions(estimate: Estimate) -> Estimate:
    """Choose every edge's direction by the motion of an estimate, whose θ stays as it is.

    As long as stretches are read the wrong way, the residual is theirs, and much is left open; once they are out of it,
    the rest is judged by what it really is.
    """
    rms = sqrt(estimate.cost)
    for _ in range(MOST_ROUNDS):
        estimate = estimate.on(_read_again(estimate, SURE_SPEED * rms))
        before, rms = rms, sqrt(estimate.cost)
        if not rms < WORTH_ANOTHER_ROUND * before:
            break
    return estimate


def _read_again(estimate: Estimate, surely: float) -> Problem:
    """Read the recordings with the sign of the simulated speed wherever it exceeds `surely` [rad/s]."""
    problem = estimate.problem
    vectors, starts = problem.unknowns.decode(estimate.theta[None])
    intervals = []
    for r, (recording, data) in enumerate(zip(problem.recordings, problem.intervals, strict=True)):
        reader = _READERS.get(recording.info.measurement)
        if reader is None or not recording.info.single_channel:
            intervals.append(data)
            continue
        motion = _Motion(vectors[0, r], float(starts[0, r]), problem.commands[r])
        intervals.append(reader(recording, motion, surely))
    return problem.with_intervals(tuple(intervals))


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
    edges = extract_edges(recording)
    direction = choose_directions(edges.direction, motion.speed_at(edges.time), surely)
    return make_edge_intervals(recording, replace(edges, direction=direction))


def _counts_again(recording: Recording, motion: _Motion, surely: float) -> Intervals:
    changes = extract_count_changes(recording)
    way = choose_directions(changes.way, motion.speed_at(recording.time[changes.sample]), surely)
    return make_count_intervals(recording, number_runs(changes.sample, way))


_READERS = {Measurement.EDGES: _edges_again, Measurement.COUNTS: _counts_again}


def choose_directions(reported: Integers, simulated: Floats, surely: float) -> Integers:
    """Choose directions of edges (E,): the simulated speed's sign where it exceeds `surely` [rad/s].

    Below that the reported one where both agree, else 0 for open.
    """
    sign = np.sign(simulated).astype(np.int64)
    return np.where(np.abs(simulated) > surely, sign, np.where(sign == reported, reported, 0))
