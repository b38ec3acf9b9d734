"""A fitting problem: one recording and a set of unknowns, as a cost for a swarm and residuals for least squares."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from motor_identification.recording import Floats, Recording
from motor_identification.residual import Intervals, fill_residuals, intervals_of
from motor_identification.unknowns import Unknowns, unknowns_of
from motor_model.compiled import compiled
from motor_model.errors import RecordingError
from motor_model.simulate import roll_out


@compiled
def fill_costs(vectors, starts, command_time, command, time, first, last, speed, slack, weight, residuals, costs):
    """Residuals (S, I) and time-weighted mean squares (S,) of a swarm of motors; see `Intervals` for the data."""
    angle, shaft = np.empty(len(time)), np.empty(len(time))
    for s in range(len(vectors)):
        roll_out(vectors[s], starts[s], command_time, command, time, angle, shaft)
        fill_residuals(angle, time, first, last, speed, slack, residuals[s])
        total = 0.0
        for i in range(len(weight)):
            total += weight[i] * residuals[s, i] * residuals[s, i]
        costs[s] = total


@dataclass(frozen=True)
class Problem:
    """What is minimised: the time-weighted mean square of (simulated − measured) mean speed over all intervals."""

    recording: Recording
    intervals: Intervals
    unknowns: Unknowns
    workers: int = 1

    def evaluate(self, places: Floats) -> tuple[Floats, Floats]:
        """Residuals (S, I) [rad/s] and costs (S,) [rad²/s²] at places (S, D)."""
        return self.evaluate_vectors(*self.unknowns.decode(places))

    def evaluate_vectors(self, vectors: Floats, starts: Floats) -> tuple[Floats, Floats]:
        """The same for parameter vectors (S, P) and initial speeds (S,) [rad/s]."""
        data = self.intervals
        residuals, costs = np.empty((len(vectors), len(data.first))), np.empty(len(vectors))
        time, command, weight = self.recording.time, self.recording.voltage, data.weight

        def work(part: slice) -> None:
            fill_costs(
                vectors[part], starts[part], time, command, data.time, data.first, data.last, data.speed, data.slack,
                weight, residuals[part], costs[part],
            )  # fmt: skip

        share = -(-len(vectors) // self.workers)
        parts = [slice(i, i + share) for i in range(0, len(vectors), share)]
        if len(parts) == 1:
            work(parts[0])
        else:
            with ThreadPoolExecutor(len(parts)) as pool:
                list(pool.map(work, parts))
        return residuals, costs

    def costs(self, places: Floats) -> Floats:
        """The swarm's cost: places (S, D) → (S,)."""
        return self.evaluate(places)[1]

    def residuals(self, place: Floats) -> Floats:
        """[rad/s] of one place (D,), shape (I,)."""
        return self.evaluate(place[None])[0][0]

    def weighted_residuals(self, place: Floats) -> Floats:
        """Least squares' residuals: their sum of squares is the cost. Shape (I,)."""
        return np.asarray(np.sqrt(self.intervals.weight) * self.residuals(place))

    def jacobian(self, place: Floats) -> Floats:
        """Derivative of the unweighted residuals over the unknowns, central differences, shape (I, D)."""
        steps = 1e-5 * (self.unknowns.high - self.unknowns.low)
        shifted = np.concatenate([place + np.diag(steps), place - np.diag(steps)])
        residuals = self.evaluate(shifted)[0]
        return np.asarray(((residuals[: len(place)] - residuals[len(place) :]) / (2.0 * steps)[:, None]).T)


def make_problem(recording: Recording, effects: tuple[str, ...], workers: int = 1) -> Problem:
    """The problem of fitting kv, ka and these effects to a recording.

    Raises:
        ModelError: an effect is not in the table.
        RecordingError: the recording has no usable motion, or the motor moves without any voltage.
    """
    if not np.any(recording.voltage):
        raise RecordingError(f"{recording.uri} has no voltage other than 0 in it: record with the motor driven.")
    intervals = intervals_of(recording)
    return Problem(recording, intervals, unknowns_of(recording, effects), workers)
