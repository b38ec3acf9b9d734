"""A fitting problem: recordings and a set of unknowns, as a cost for a swarm and residuals for least squares."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from motor_identification.intervals import Intervals, intervals_of, joined, without
from motor_identification.recording import Bools, Floats, Integers, Recording
from motor_identification.residual import fill_residuals
from motor_identification.unknowns import Unknowns, unknowns_of
from motor_model.compiled import compiled
from motor_model.encoder import show
from motor_model.errors import ModelError, RecordingError
from motor_model.simulate import roll_out


@compiled
def fill_swarm(
    vectors: Floats,
    starts: Floats,
    command_time: Floats,
    command: Floats,
    time: Floats,
    first: Integers,
    last: Integers,
    speed: Floats,
    slack: Floats,
    residuals: Floats,
) -> None:
    """Residuals (S, I) of a swarm of motors over one recording; see `Intervals` for the data."""
    angle, shaft = np.empty(len(time)), np.empty(len(time))
    for s in range(len(vectors)):
        roll_out(vectors[s], starts[s], command_time, command, time, angle, shaft)
        show(vectors[s], angle)
        fill_residuals(angle, time, first, last, speed, slack, residuals[s])


@dataclass(frozen=True)
class Problem:
    """What is minimised: the time-weighted mean square of (simulated − measured) mean speed over all intervals.

    Several recordings of one motor share its parameters; each has an initial speed of its own. Arrays over I intervals
    have the recordings one after the other.
    """

    recordings: tuple[Recording, ...]
    intervals: tuple[Intervals, ...]
    unknowns: Unknowns
    workers: int = 1

    @cached_property
    def commands(self) -> tuple[tuple[Floats, Floats], ...]:
        """Times [s] and voltages [V] at which each recording's command changes: a held one needs no step."""
        changes = []
        for recording in self.recordings:
            kept = np.diff(recording.voltage, prepend=np.nan) != 0.0
            changes.append((recording.time[kept], recording.voltage[kept]))
        return tuple(changes)

    def coarse(self, duration: float) -> "Problem":
        """The same problem with intervals joined to this length [s] where they follow each other: quicker to search."""
        return replace(self, intervals=tuple(joined(data, duration) for data in self.intervals))

    def without(self, bad: tuple[Bools, ...]) -> "Problem":
        """The same problem without the marked intervals of every recording."""
        kept = tuple(without(data, marks) for data, marks in zip(self.intervals, bad, strict=True))
        return replace(self, intervals=kept)

    def increments(self, place: Floats) -> tuple[Floats, ...]:
        """Simulated minus measured travel [rad] in the intervals of every recording, at one place (D,)."""
        residuals = self.residuals(place)
        ends = np.cumsum([len(data.first) for data in self.intervals])
        parts = np.split(residuals, ends[:-1])
        return tuple(part * data.duration for part, data in zip(parts, self.intervals, strict=True))

    @cached_property
    def weight(self) -> Floats:
        """Share of the observed time, shape (I,), sum 1."""
        duration = np.concatenate([data.duration for data in self.intervals])
        return np.asarray(duration / duration.sum())

    @cached_property
    def speed(self) -> Floats:
        """[rad/s] measured mean speeds, shape (I,)."""
        return np.concatenate([data.speed for data in self.intervals])

    def evaluate(self, places: Floats) -> Floats:
        """Residuals (S, I) [rad/s] at places (S, D)."""
        return self.evaluate_vectors(*self.unknowns.decode(places))

    def evaluate_vectors(self, vectors: Floats, starts: Floats) -> Floats:
        """The same for parameter vectors (S, P) and initial speeds (S, R) [rad/s] in R recordings."""
        residuals = np.empty((len(vectors), len(self.weight)))
        share = -(-len(vectors) // max(self.workers, 1))
        parts = [slice(i, i + share) for i in range(0, len(vectors), share)]

        def work(part: slice) -> None:
            column = 0
            for r, ((time, voltage), data) in enumerate(zip(self.commands, self.intervals, strict=True)):
                out = np.empty((len(vectors[part]), len(data.first)))
                fill_swarm(
                    vectors[part], np.ascontiguousarray(starts[part, r]), time, voltage,
                    data.time, data.first, data.last, data.speed, data.slack, out,
                )  # fmt: skip
                residuals[part, column : column + len(data.first)] = out
                column += len(data.first)

        if len(parts) == 1:
            work(parts[0])
        else:
            with ThreadPoolExecutor(len(parts)) as pool:
                list(pool.map(work, parts))
        return residuals

    def costs(self, places: Floats) -> Floats:
        """The swarm's cost: places (S, D) → time-weighted mean squares (S,) [rad²/s²]."""
        return np.asarray(self.evaluate(places) ** 2 @ self.weight)

    def residuals(self, place: Floats) -> Floats:
        """[rad/s] of one place (D,), shape (I,)."""
        return np.asarray(self.evaluate(place[None])[0])

    def angles(self, place: Floats) -> tuple[Floats, ...]:
        """[rad] what the disc shows at the times of every recording's intervals, simulated at one place (D,)."""
        vectors, starts = self.unknowns.decode(place[None])
        angles = []
        for r, ((time, voltage), data) in enumerate(zip(self.commands, self.intervals, strict=True)):
            angle, speed = np.empty(len(data.time)), np.empty(len(data.time))
            roll_out(vectors[0], float(starts[0, r]), time, voltage, data.time, angle, speed)
            show(vectors[0], angle)
            angles.append(angle)
        return tuple(angles)

    def jacobian(self, place: Floats) -> Floats:
        """Derivative of the residuals over the unknowns, central differences, shape (I, D)."""
        steps = 1e-5 * (self.unknowns.high - self.unknowns.low)
        shifted = np.concatenate([place + np.diag(steps), place - np.diag(steps)])
        residuals = self.evaluate(shifted)
        return np.asarray(((residuals[: len(place)] - residuals[len(place) :]) / (2.0 * steps)[:, None]).T)


def make_problem(recordings: Sequence[Recording], effects: tuple[str, ...], workers: int = 1) -> Problem:
    """The problem of fitting kv, ka and these effects to recordings of one motor.

    Raises:
        ModelError: an effect is not in the table, or is none that can be fitted.
        RecordingError: a recording has no usable motion, or the motor moves without any voltage.
    """
    if "missed_edges" in effects:
        raise ModelError("missed_edges is recognised in every fit and left out, not fitted: drop it from the effects.")
    for recording in recordings:
        if not np.any(recording.voltage):
            raise RecordingError(f"{recording.uri} has no voltage other than 0 in it: record with the motor driven.")
    intervals = tuple(intervals_of(recording) for recording in recordings)
    return Problem(tuple(recordings), intervals, unknowns_of(recordings, effects), workers)
