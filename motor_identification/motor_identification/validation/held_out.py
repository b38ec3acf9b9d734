"""Held-out data: a fitted motor on motion that no fit has seen, its gap, and how likely that motion is.

What belongs to a recording (initial speed, phases, the time of a load step) is estimated there, on blocks of it that
the gap then leaves out; the motor itself is not touched.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import log

import numpy as np

from motor_identification.estimation.direction_correction import redirected
from motor_identification.estimation.miscounts import miscounted
from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.measurement.intervals import Intervals, joined, without
from motor_identification.noise.likelihood import Noise, log_likelihood
from motor_identification.recording import Bools, Floats, Recording
from motor_identification.validation.nuisance_fit import transferred

LEAST = 12  # blocks of a short recording
BLOCK = 0.5  # [s] of what is for a recording's own unknowns, and of what is scored, in turns
UNFORESEEN = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)  # of a slot squared, a second: drift of the simulated angle
SHARE = 4  # of the blocks of one recording, one is held out where there is no other recording


@dataclass(frozen=True)
class HeldOut:
    """A motor on held-out data; `scored` marks the intervals of every recording that count."""

    problem: Problem
    place: Floats
    scored: tuple[Bools, ...]
    miscounted: int

    @cached_property
    def counted(self) -> Bools:
        """`scored` of all recordings, one after the other, shape (I,)."""
        return np.concatenate(self.scored)

    @cached_property
    def residuals(self) -> Floats:
        """[rad/s] simulated minus measured mean speed of what counts."""
        return np.asarray(self.problem.residuals(self.place)[self.counted])

    @cached_property
    def weight(self) -> Floats:
        """Share of the time of what counts; sum 1."""
        weight = self.problem.weight[self.counted]
        return np.asarray(weight / weight.sum())

    @property
    def gap(self) -> float:
        """[rad/s] time-weighted RMS of simulated minus measured mean speed."""
        return float(np.sqrt(self.weight @ self.residuals**2))

    def floors(self, share: float) -> Floats:
        """[rad/s] what timer and irregular slots (a share of a slot) alone leave in each interval that counts."""
        squares = [data.floor_squared(share * data.slot) for data in self.problem.intervals]
        return np.asarray(np.sqrt(np.concatenate(squares)[self.counted]))

    def floor(self, share: float) -> float:
        """[rad/s] the gap that a perfect model would leave."""
        return float(np.sqrt(self.weight @ self.floors(share) ** 2))

    def joined(self, duration: float) -> "HeldOut":
        """The same in intervals of at least this length [s], where they follow each other: what lasts stands out there
        from the encoder's noise."""
        rows = zip(self.problem.intervals, self.scored, strict=True)
        longer = tuple(joined(without(data, ~scored), duration) for data, scored in rows)
        everything = tuple(np.ones(len(data.first), dtype=bool) for data in longer)
        return replace(self, problem=replace(self.problem, intervals=longer), scored=everything)

    def log_likelihood(self, noise: Noise) -> float:
        """Of the held-out motion, whose drift may be that of the training data or, as likely, one of a few larger ones.

        A complete model drifts nowhere there; one restart that nobody could predict must not refute it.
        """
        rows = zip(self.problem.intervals, self.problem.increments(self.place), self.scored, strict=True)
        parts = [(without(data, ~scored), increments[scored]) for data, increments, scored in rows]

        def under(growth: float) -> float:
            return sum(log_likelihood(data, part, replace(noise, growth=growth)) for data, part in parts)

        own, slot = under(noise.growth), max(data.slot for data, _part in parts)
        larger = [under(share * slot**2) for share in UNFORESEEN if share * slot**2 > noise.growth]
        if not larger:
            return own
        return float(np.logaddexp(own, np.logaddexp.reduce(larger) - log(len(larger))) - log(2.0))


@dataclass(frozen=True)
class Kept:
    """What a diagnosis keeps out of its fits: other recordings, or a part of the same."""

    problem: Problem  # of the recordings to judge by, without effects
    own_blocks: tuple[Bools, ...]  # intervals that a recording's own unknowns may be fitted on
    same: bool  # whether these are the recordings of the fit

    def judged(self, fitted: Problem, place: Floats) -> HeldOut:
        """A motor on it, fitted (D,) elsewhere."""
        if self.same:
            here = replace(self.problem, unknowns=fitted.unknowns, tracks=fitted.tracks)
            there = place
        else:
            here, there = transferred(self.problem, fitted.unknowns, place, self.own_blocks)
        increments = here.increments(there)
        bad = tuple(miscounted(data, part) for data, part in zip(here.intervals, increments, strict=True))
        scored = tuple(~own & ~marks for own, marks in zip(self.own_blocks, bad, strict=True))
        return HeldOut(here, there, scored, int(sum(marks.sum() for marks in bad)))

    def redirected(self, fitted: Problem, place: Floats) -> "Kept":
        """The same with directions judged by a fitted motor."""
        held = self.judged(fitted, place)
        intervals = redirected(held.problem, held.place).intervals
        return replace(
            self,
            problem=replace(self.problem, intervals=intervals),
            own_blocks=tuple(_own_blocks(data, self.same) for data in intervals),
        )


def keep_out(recordings: Sequence[Recording], validation: Sequence[Recording]) -> Kept:
    """What to judge by: `validation`, or every fourth block of the recordings themselves.

    Raises:
        RecordingError: a recording has no usable motion.
    """
    problem = make_problem(validation or recordings, ())
    return Kept(problem, tuple(_own_blocks(data, not validation) for data in problem.intervals), not validation)


def spared(data: Intervals) -> Bools:
    """Which intervals of a recording no fit may see, where a part of it is held out, shape (I,)."""
    return ~_own_blocks(data, True)


def _own_blocks(data: Intervals, same: bool) -> Bools:
    block = (data.time[data.first] // min(BLOCK, data.time[-1] / LEAST)).astype(np.int64)
    return np.asarray(block % SHARE != SHARE - 1 if same else block % 2 == 0)
