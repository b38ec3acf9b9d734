"""Define the fitting problem: recordings and unknowns θ, with the output error as a cost and as residuals."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from motor_identification.estimation.joined_commands import join_commands
from motor_identification.estimation.open_play import OPEN, choose_open_play, mark_loose
from motor_identification.estimation.parameter_space import Unknowns, make_unknowns
from motor_identification.estimation.residual import Latest, simulate_residuals
from motor_identification.measurement.build_intervals import make_intervals
from motor_identification.measurement.edit_intervals import exclude_intervals, join_intervals, share_noise
from motor_identification.measurement.intervals import Intervals
from motor_identification.measurement.measured_angle import Track, make_track
from motor_identification.measurement.request_checks import check_effects
from motor_identification.measurement.time_blocks import TimeBlocks
from motor_identification.progress import Stopped
from motor_identification.recording import Bools, Floats, Recording
from motor_model.effects import INDEX, normalised
from motor_model.errors import RecordingError
from motor_model.sensing.encoder import show
from motor_model.simulate import NOWHERE, roll_out

SEARCH_COARSENESS = 4.0  # of the motion while a swarm searches
AT_ONCE = 200_000  # residuals that are simulated in one call
MOST_KEPT = 50_000  # intervals up to which the latest simulations are kept: models of an hour would fill the memory
DERIVATIVE_STEP = 1e-7  # of the box, for derivatives: 1e-5 of it turns a ripple's phase by 0.3 rad within half a minute


@dataclass(frozen=True)
class Problem:
    """The output error to minimise: the time-weighted mean square of (simulated − measured) mean speed, all intervals.

    Several recordings of one motor share its parameters; each has an initial speed of its own. Arrays over I intervals
    have the recordings one after the other.
    """

    recordings: tuple[Recording, ...]
    intervals: tuple[Intervals, ...]
    unknowns: Unknowns
    workers: int = 1
    coarseness: float = 1.0  # of the simulation, see `motor_model/dynamics/motor.py`
    tracks: tuple[Track, ...] = ()  # the measured angle of every recording, for what is periodic in it
    kept_out: TimeBlocks | None = None  # blocks of every recording that no fit may see
    stopped: Callable[[], bool] | None = None  # asked before every simulation

    @cached_property
    def commands(self) -> tuple[tuple[Floats, Floats], ...]:
        """Times [s] and voltages [V] at which each recording's command changes: a held one needs no step.

        Where rows are joined, so are their commands.
        """
        changes = []
        for recording, data in zip(self.recordings, self.intervals, strict=True):
            if data.rows > 1:
                changes.append(join_commands(recording, data.rows))
                continue
            kept = np.diff(recording.voltage, prepend=np.nan) != 0.0
            changes.append((recording.time[kept], recording.voltage[kept]))
        return tuple(changes)

    @cached_property
    def anchors(self) -> tuple[Floats, ...]:
        """[rad] the measured angle at the times of every recording's intervals; empty where it is not needed."""
        if not self.tracks:
            return (NOWHERE,) * len(self.recordings)
        return tuple(track.at(data.time) for track, data in zip(self.tracks, self.intervals, strict=True))

    def with_effects(self, effects: tuple[str, ...], split: bool | None = None) -> "Problem":
        """The problem with other unknowns; kv split (see `make_unknowns`) as told, or as it is now."""
        split = self.unknowns.splits_kv if split is None else split
        return replace(self, unknowns=make_unknowns(self.recordings, effects, split))

    def adding(self, *effects: str) -> "Problem":
        """The problem with more effects, in the table's order."""
        return self.with_effects(normalised((*self.unknowns.effects, *effects)))

    def on_measured_angle(self, theta: Floats, effects: tuple[str, ...]) -> "Problem":
        """The problem with other effects, on the measured angle; a fitted θ (D,) bridges its gaps."""
        rows = zip(self.intervals, self.angles(theta), strict=True)
        tracks = tuple(make_track(data, angle) for data, angle in rows)
        return replace(self.with_effects(effects), tracks=tracks)

    @property
    def sample_period(self) -> float:
        """[s] the shortest of all recordings; of nothing but steady states, the time that each is the mean over."""
        return self.unknowns.extent.sample

    def coarsen(self, samples: float) -> "Problem":
        """The same problem with intervals joined to so many sample periods, or thinned rows: quicker to search."""
        duration = samples * self.sample_period
        return replace(
            self,
            intervals=tuple(join_intervals(data, data.rows * duration) for data in self.intervals),
            coarseness=SEARCH_COARSENESS,
        )

    def without(self, bad: tuple[Bools, ...]) -> "Problem":
        """The same problem without the marked intervals of every recording."""
        kept = tuple(exclude_intervals(data, marks) for data, marks in zip(self.intervals, bad, strict=True))
        return replace(self, intervals=kept)

    def keeping_out(self, blocks: TimeBlocks) -> "Problem":
        """The same problem without these blocks of its recordings, now and whenever its intervals are read again."""
        return replace(self.without(blocks.mark_each(self.intervals, self.sample_period)), kept_out=blocks)

    def with_intervals(self, intervals: tuple[Intervals, ...]) -> "Problem":
        """The same problem with its recordings' intervals read in another way."""
        again = replace(self, intervals=intervals)
        return again if self.kept_out is None else again.keeping_out(self.kept_out)

    def split(self, rows: Floats) -> list[Floats]:
        """What is for all intervals, shape (I, …), recording by recording."""
        return [rows[part] for part in self._parts]

    @cached_property
    def _parts(self) -> tuple[slice, ...]:
        """Where each recording's intervals are among all."""
        ends = np.cumsum([0, *(len(data.first) for data in self.intervals)]).tolist()
        return tuple(slice(*both) for both in pairwise(ends))

    def to_travel(self, speeds: Floats) -> tuple[Floats, ...]:
        """[rad] of every recording, from mean speeds [rad/s] in all intervals, shape (I,)."""
        return tuple(part * data.duration for part, data in zip(self.split(speeds), self.intervals, strict=True))

    def increments(self, theta: Floats) -> tuple[Floats, ...]:
        """Simulated minus measured travel [rad] in the intervals of every recording, at one θ (D,)."""
        return self.to_travel(self.residuals(theta))

    @cached_property
    def weight(self) -> Floats:
        """Share of the observed time, shape (I,), sum 1."""
        duration = np.concatenate([data.duration for data in self.intervals])
        return np.asarray(duration / duration.sum())

    @cached_property
    def speed(self) -> Floats:
        """[rad/s] measured mean speeds, shape (I,)."""
        return np.concatenate([data.speed for data in self.intervals])

    def evaluate(self, thetas: Floats) -> Floats:
        """Residuals (S, I) [rad/s] at θ (S, D)."""
        return self.evaluate_vectors(*self.unknowns.decode(thetas))

    def evaluate_vectors(self, vectors: Floats, starts: Floats) -> Floats:
        """The same for parameter vectors (S, R, P) and initial speeds (S, R) [rad/s] in R recordings."""
        if len(self.intervals) == 1:  # an hour's residuals are not there twice
            return self._simulate(0, vectors[:, 0], starts[:, 0])
        every = range(len(self.intervals))
        return np.concatenate([self._simulate(r, vectors[:, r], starts[:, r]) for r in every], axis=1)

    def _simulate(self, r: int, vectors: Floats, starts: Floats, open_play: float | None = None) -> Floats:
        """Residuals (S, I) [rad/s] of one recording; open_play: the share of a play, None for what leaves least."""
        if open_play is None:
            return self._choose_open_play(r, vectors, starts)[0]
        vectors[:, OPEN] = open_play
        return self._simulate_swarm(r, vectors, starts)

    def _simulate_swarm(self, r: int, vectors: Floats, starts: Floats) -> Floats:
        self.raise_if_stopped()
        vectors[:, INDEX["coarseness"]] = self.coarseness
        data, anchor = self.intervals[r], self.anchors[r]
        return simulate_residuals(vectors, starts, self.commands[r], anchor, data, self.workers)

    def _choose_open_play(self, r: int, vectors: Floats, starts: Floats) -> tuple[Floats, Floats]:
        """Residuals (S, I) [rad/s] of one recording, and the shares (S,) of a play that is open as it begins."""
        weight = self.intervals[r].duration
        return choose_open_play(lambda some, speeds: self._simulate_swarm(r, some, speeds), vectors, starts, weight)

    def _find_open_play(self, theta: Floats) -> Floats:
        """Share of a play that is open as each recording begins, at one θ (D,), shape (R,)."""
        vectors, starts = self.unknowns.decode(theta[None])
        opened = np.zeros(len(self.intervals))
        for r in np.flatnonzero(mark_loose(vectors[0], starts[0])):
            opened[r] = self._choose_open_play(r, vectors[:, r], starts[:, r])[1][0]
        return opened

    def raise_if_stopped(self) -> None:
        """Do nothing, unless the computation was told to stop.

        Raises:
            Stopped: so it was.
        """
        if self.stopped is not None and self.stopped():
            raise Stopped("the diagnosis was stopped.")

    def costs(self, thetas: Floats) -> Floats:
        """The swarm's cost: θ (S, D) → time-weighted mean squares (S,) [rad²/s²]."""
        return np.asarray(self.evaluate(thetas) ** 2 @ self.weight)

    def cost(self, theta: Floats) -> float:
        """[rad²/s²] of one θ (D,)."""
        return float(self.residuals(theta) ** 2 @ self.weight)

    @cached_property
    def _latest(self) -> tuple[Latest[Floats], Latest[tuple[Floats, ...]], Latest[Floats]]:
        """Residuals, angles and derivatives at the latest θ."""
        kept = sum(len(data.first) for data in self.intervals) <= MOST_KEPT
        return Latest(3 * kept), Latest(2 * kept), Latest(kept)

    def residuals(self, theta: Floats) -> Floats:
        """[rad/s] of one θ (D,), shape (I,); not to be written to."""
        self.raise_if_stopped()
        return self._latest[0].find(theta, lambda: np.asarray(self.evaluate(theta[None])[0]))

    def angles(self, theta: Floats) -> tuple[Floats, ...]:
        """[rad] what the disc shows at the times of every recording's intervals, simulated at one θ (D,)."""
        self.raise_if_stopped()
        return self._latest[1].find(theta, lambda: self._simulate_angles(theta))

    def _simulate_angles(self, theta: Floats) -> tuple[Floats, ...]:
        vectors, starts = self.unknowns.decode(theta[None])
        vectors[0, :, OPEN] = self._find_open_play(theta)
        angles = []
        for r, ((time, voltage), data) in enumerate(zip(self.commands, self.intervals, strict=True)):
            angle, speed = np.empty(len(data.time)), np.empty(len(data.time))
            roll_out(vectors[0, r], float(starts[0, r]), time, voltage, data.time, self.anchors[r], angle, speed)
            show(vectors[0, r], angle, self.anchors[r])
            angles.append(angle)
        return tuple(angles)

    def jacobian(self, theta: Floats) -> Floats:
        """Derivative of the residuals over the unknowns, forward differences, shape (I, D); not to be written to."""
        self.raise_if_stopped()
        return self._latest[2].find(theta, lambda: self._differentiate(theta)).T

    def _differentiate(self, theta: Floats) -> Floats:
        """Shape (D, I); a recording is simulated for what concerns it only, such as its own initial speed."""
        steps = DERIVATIVE_STEP * (self.unknowns.high - self.unknowns.low)
        here, opened = self.residuals(theta), self._find_open_play(theta)
        vectors, starts = self.unknowns.decode(np.concatenate([theta[None], theta + np.diag(steps)]))
        columns = np.zeros((len(theta), len(here)))
        end = 0
        for r, data in enumerate(self.intervals):
            begin, end = end, end + len(data.first)
            moved = np.any(vectors[1:, r] != vectors[0, r], axis=1) | (starts[1:, r] != starts[0, r])
            concerned = np.flatnonzero(moved)
            # A few unknowns at a time keep all cores busy and an hour's residuals in memory.
            share = max(self.workers, AT_ONCE // len(data.first), 1)
            for some in (concerned[i : i + share] for i in range(0, len(concerned), share)):
                aside = self._simulate(r, vectors[some + 1, r], starts[some + 1, r], float(opened[r]))
                columns[some, begin:end] = (aside - here[begin:end]) / steps[some, None]
        columns[~np.isfinite(columns)] = 0.0  # a motor a step aside that is no motor says nothing
        return columns


def make_problem(
    recordings: Sequence[Recording],
    effects: tuple[str, ...],
    workers: int = 1,
    stopped: Callable[[], bool] | None = None,
) -> Problem:
    """Make the problem of fitting kv, ka and these effects to recordings of one motor.

    Raises:
        ModelError: an effect is not in the table, or is none that can be fitted.
        RecordingError: a recording has no usable motion, or the motor moves without any voltage.
    """
    check_effects(effects)
    driven = any(np.any(recording.voltage) for recording in recordings)
    if not driven:  # one that coasts tells of friction beside others
        raise RecordingError(f"{recordings[0].uri}: the voltage is always 0; record with the motor driven.")
    intervals = share_noise([make_intervals(recording) for recording in recordings])
    unknowns = make_unknowns(recordings, effects)
    count = sum(len(data.first) for data in intervals)
    if count <= len(unknowns.low):
        raise RecordingError(
            f"{len(unknowns.low)} unknowns cannot be fitted to {count} intervals of motion: record longer, or fit "
            "fewer effects."
        )
    return Problem(tuple(recordings), intervals, unknowns, workers, stopped=stopped)
