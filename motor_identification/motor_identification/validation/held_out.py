"""Score held-out motion: a fitted motor beside recordings that no fit has seen, its gap, and how likely that is."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import log, sqrt

import numpy as np

from motor_identification.estimation.residual import compute_residuals
from motor_identification.measurement.edit_intervals import exclude_intervals, join_intervals
from motor_identification.measurement.intervals import Intervals
from motor_identification.noise.error_data import ErrorData, make_error_data, measure_response
from motor_identification.noise.likelihood import Noise, log_likelihood
from motor_identification.recording import Bools, Floats, Integers, Recording
from motor_model.parameters import Parameters

# Of a slot squared (or of one that would blur angles as much), a second: drifts of the simulated angle that held-out
# motion may have beyond the training data's. From one that is hardly seen within a second to one that loses a third of
# a slot in it.
UNFORESEEN_DRIFTS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)


@dataclass(frozen=True)
class HeldOut:
    """A motor's simulated motion beside the measured one; `scored` marks the intervals of every recording that count.

    Only data: no problem, no solver. Entries of tuples are of every recording.
    """

    recordings: tuple[Recording, ...]
    intervals: tuple[Intervals, ...]
    angles: tuple[Floats, ...]  # [rad] simulated, at the times of `intervals`
    parameters: Parameters  # as the first recording has them
    scored: tuple[Bools, ...]
    miscounted: int  # intervals left out because edges were missed or counted twice
    instants: tuple[Bools, ...] = ()  # left out of the gap: an instant is in these blocks, which nobody could foresee
    seen: bool = False  # the fit has seen what counts
    confirms: bool = True  # there is more than a step, by which a finding can be confirmed
    responses: tuple[Floats, ...] = ()  # [rad] of these angles to the supply's size, where there are several recordings

    @cached_property
    def residuals_of(self) -> tuple[Floats, ...]:
        """[rad/s] simulated minus measured mean speed in every interval, counted or not, of every recording."""
        return tuple(compute_residuals(data, angle) for data, angle in zip(self.intervals, self.angles, strict=True))

    @property
    def supply_speeds(self) -> tuple[Floats, ...]:
        """[rad/s] what the supply's size adds to the mean speed in every interval; 0 where nothing is known of it."""
        if not self.responses:
            return tuple(np.zeros(len(data.first)) for data in self.intervals)
        rows = zip(self.intervals, self.responses, strict=True)
        return tuple(measure_response(data, response) / data.duration for data, response in rows)

    @property
    def increments(self) -> tuple[Floats, ...]:
        """[rad] simulated minus measured travel in every interval, counted or not, of every recording."""
        rows = zip(self.residuals_of, self.intervals, strict=True)
        return tuple(residuals * data.duration for residuals, data in rows)

    @cached_property
    def counted(self) -> Bools:
        """`scored` of all recordings, one after the other, shape (I,)."""
        return np.concatenate(self.scored)

    @cached_property
    def residuals(self) -> Floats:
        """[rad/s] simulated minus measured mean speed of what counts."""
        return np.asarray(np.concatenate(self.residuals_of)[self.counted])

    @cached_property
    def weight(self) -> Floats:
        """Share of the time of what counts; sum 1."""
        duration = np.concatenate([data.duration for data in self.intervals])[self.counted]
        return np.asarray(duration / duration.sum())

    @property
    def gap(self) -> float:
        """[rad/s] the validation RMS error: time-weighted, of simulated minus measured mean speed."""
        return float(np.sqrt(self.weight @ self.residuals**2))

    def list_calm(self, wild: float) -> Integers:
        """List the intervals outside of the share of the time in which most is left, whatever that is."""
        worst = np.argsort(-(self.residuals**2))
        return np.asarray(worst[np.cumsum(self.weight[worst]) > wild])

    def find_calm_gap(self, wild: float) -> float:
        """Find the gap [rad/s] outside of the share of the time in which most is left."""
        calm = self.list_calm(wild)
        left = float(self.weight[calm].sum())
        return sqrt(float(self.weight[calm] @ self.residuals[calm] ** 2) / left) if left > 0.0 else self.gap

    def floors(self, share: float) -> Floats:
        """[rad/s] what timer and sensor (a share of its unit) alone leave in each interval that counts."""
        squares = [data.floor_squared(share * data.unit) for data in self.intervals]
        return np.asarray(np.sqrt(np.concatenate(squares)[self.counted]))

    def floor(self, share: float) -> float:
        """[rad/s] the gap that a perfect model would leave."""
        return float(np.sqrt(self.weight @ self.floors(share) ** 2))

    def joined(self, duration: float) -> "HeldOut":
        """Join what counts to intervals of at least this length [s], where they follow each other: what lasts stands
        out there from the encoder's noise."""
        rows = zip(self.intervals, self.scored, strict=True)
        longer = tuple(join_intervals(exclude_intervals(data, ~scored), duration) for data, scored in rows)
        old = zip(self.intervals, longer, self.angles, strict=True)
        angles = tuple(angle[np.searchsorted(data.time, after.time)] for data, after, angle in old)
        everything = tuple(np.ones(len(data.first), dtype=bool) for data in longer)
        return replace(self, intervals=longer, angles=angles, scored=everything, instants=(), responses=())

    def with_noise(self, share: float) -> "HeldOut":
        """The same motion, its speeds with a share of the white noise that was assumed of them."""
        return replace(self, intervals=tuple(data.with_noise(share) for data in self.intervals))

    def measure_noise(self) -> float:
        """Measure what is left of speeds that count, as a share of the white noise assumed of them; 1 at most."""
        rows = zip(self.intervals, self.increments, self.scored, strict=True)
        squares, counts = zip(*(data.sum_noise(part, marks) for data, part, marks in rows), strict=True)
        return min(sqrt(sum(squares) / sum(counts)), 1.0) if sum(counts) else 1.0

    def has_intervals_of(self, other: "HeldOut") -> bool:
        """Whether another model is judged by the same intervals; not where directions of some were read anew."""
        return [len(part) for part in self.scored] == [len(part) for part in other.scored]

    def leave_out(self, instants: Sequence[Bools]) -> "HeldOut":
        """Leave out of the gap what another model of the same motion does because of its instants."""
        if not any(marks.any() for marks in instants):
            return self
        return replace(self, scored=tuple(part & ~marks for part, marks in zip(self.scored, instants, strict=True)))

    def log_likelihood(self, noise: Noise) -> float:
        """Compute the log likelihood of what counts, under the training data's drift or one of a few larger ones.

        A complete model drifts nowhere there; one restart that nobody could predict must not refute it.
        """
        every = [scored | instant for scored, instant in zip(self.scored, self.instants or self.scored, strict=True)]
        rows = zip(self.intervals, self.increments, every, strict=True)
        parts = [(exclude_intervals(data, ~scored), increments[scored]) for data, increments, scored in rows]

        def under(drift: float) -> float:
            return sum(log_likelihood(data, part, replace(noise, drift=drift)) for data, part in parts)

        own, slot = under(noise.drift), max(_find_slot(data) for data, _part in parts)
        larger = [under(share * slot**2) for share in UNFORESEEN_DRIFTS if share * slot**2 > noise.drift]
        return mix_likelihoods(own, larger)


def list_held_errors(held: HeldOut, counted: Sequence[Bools] | None = None) -> list[ErrorData]:
    """List what a motor leaves in each held-out recording, for the error filter; `counted`: what is to be scored."""
    nothing = (None,) * len(held.intervals)
    rows = zip(held.intervals, held.increments, counted or nothing, held.responses or nothing, strict=True)
    return [make_error_data(*row) for row in rows]


def _find_slot(data: Intervals) -> float:
    """[rad] of the encoder, or one that would blur angles as much as they are."""
    return data.slot if data.slot > 0.0 else sqrt(12.0) * float(np.median(data.blur)) if len(data.blur) else 0.0


def mix_likelihoods(own: float, others: Sequence[float]) -> float:
    """Mix logarithmic likelihoods: half the chances for one's own, the other half shared by the others."""
    if not others:
        return own
    return float(np.logaddexp(own, np.logaddexp.reduce(others) - log(len(others))) - log(2.0))
