"""Held-out data: a fitted motor on motion that no fit has seen, its gap, and how likely that motion is.

What belongs to a recording (initial speed, phases, the time of a load step) is estimated there, on blocks of it that
the gap then leaves out; the motor itself is not touched.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.optimize import least_squares

from motor_identification import periodic
from motor_identification.direction import redirected
from motor_identification.evidence import Noise, log_likelihood
from motor_identification.intervals import Intervals, without
from motor_identification.missed import miscounted
from motor_identification.problem import Problem, make_problem
from motor_identification.recording import Bools, Floats, Recording
from motor_identification.track import Track
from motor_identification.unknowns import Unknowns, carried
from motor_model.effects import EFFECT_BY_NAME

LEAST = 12  # blocks of a short recording
BLOCK = 0.5  # [s] of what is for a recording's own unknowns, and of what is scored, in turns
SHARE = 4  # of the blocks of one recording, one is held out where there is no other recording
TIMES = 24  # at which a load step is tried


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

    def log_likelihood(self, noise: Noise) -> float:
        """Of the held-out motion."""
        rows = zip(self.problem.intervals, self.problem.increments(self.place), self.scored, strict=True)
        return sum(
            log_likelihood(without(data, ~scored), increments[scored], noise) for data, increments, scored in rows
        )


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
            here, there = _transferred(self.problem, fitted.unknowns, place, self.own_blocks)
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
    return np.asarray(block % SHARE != SHARE - 1 if same else block % 2 == 1)


@dataclass(frozen=True)
class _Own:
    """Residuals as a function of what belongs to the recordings alone, on the blocks that are for that."""

    problem: Problem
    place: Floats
    free: Bools
    used: Bools

    def whole(self, part: Floats) -> Floats:
        place = self.place.copy()
        place[self.free] = part
        return place

    def residuals(self, part: Floats) -> Floats:
        weighted = np.sqrt(self.problem.weight) * self.problem.residuals(self.whole(part))
        return np.asarray(weighted[self.used])

    def cost(self, place: Floats) -> float:
        return float(np.sum(self.residuals(place[self.free]) ** 2))


def _transferred(
    problem: Problem, fitted: Unknowns, place: Floats, own_blocks: tuple[Bools, ...]
) -> tuple[Problem, Floats]:
    """A motor fitted elsewhere on the recordings of a problem without effects."""
    here = problem.with_effects(periodic.without_periodic(fitted.effects))
    there = _fitted(here, _moved(fitted, place, here.unknowns), own_blocks)
    for effect in fitted.effects:
        if EFFECT_BY_NAME[effect].periodic:
            here, there = _with_phases(here, there, effect, fitted, place, own_blocks)
    return here, there


def _moved(old: Unknowns, place: Floats, new: Unknowns) -> Floats:
    """The motor's own parameters among the unknowns of other recordings; the rest in the middle of its box."""
    moved = 0.5 * (new.low + new.high)
    for i, name in enumerate(new.names):
        if not new.specs[i].of_recording:
            moved[i] = place[old.names.index(name)]
    return moved


def _fitted(problem: Problem, place: Floats, own_blocks: tuple[Bools, ...]) -> Floats:
    """The place with what belongs to the recordings fitted on their own blocks."""
    unknowns = problem.unknowns
    free = np.ones(len(unknowns.low), dtype=bool)
    free[[i for i, spec in enumerate(unknowns.specs) if not spec.of_recording]] = False
    own = _Own(problem, place, free, np.concatenate(own_blocks))
    if not free.any():
        return place
    if "step_time" in unknowns.names:
        own = replace(own, place=_with_step_times(own))
    low, high = unknowns.low[free], unknowns.high[free]
    margin = 1e-9 * (high - low)
    start = np.clip(own.place[free], low + margin, high - margin)
    solution = least_squares(own.residuals, start, bounds=(low, high), x_scale=high - low, max_nfev=30, diff_step=1e-5)
    return own.whole(solution.x)


def _with_step_times(own: _Own) -> Floats:
    """Each recording's load step at the best of many times."""
    place, unknowns = own.place, own.problem.unknowns
    for recording, column in zip(
        own.problem.recordings, unknowns.columns[:, unknowns.names.index("step_time")], strict=True
    ):
        trials = np.tile(place, (TIMES, 1))
        trials[:, column] = np.linspace(0.0, recording.duration, TIMES)
        place = min(trials, key=own.cost)
    return place


def _with_phases(
    bare: Problem, there: Floats, effect: str, fitted: Unknowns, place: Floats, own_blocks: tuple[Bools, ...]
) -> tuple[Problem, Floats]:
    """A periodic effect joins, with the phases that fit best on measured angles, or, if that is better, on its own."""
    names = [spec.name for spec in EFFECT_BY_NAME[effect].parameters if not spec.of_recording]
    values = {name: np.array(float(place[fitted.names.index(name)])) for name in names}
    larger, used = bare.with_effects((*bare.unknowns.effects, effect)), np.concatenate(own_blocks)
    choices: list[tuple[float, Problem, Floats]] = []
    tracks: tuple[Track, ...] = ()
    for _ in range(periodic.ROUNDS):
        cycles = float(values.get("ripple_cycles", np.array(1.0)))
        tracks, found = periodic.phases(bare, there, effect, cycles, tracks)
        start = carried(bare.unknowns, there, larger.unknowns, {**values, **found})
        for trial in (replace(larger, tracks=tracks), replace(larger, tracks=())):
            end = _fitted(trial, start, own_blocks)
            weighted = np.sqrt(trial.weight) * trial.residuals(end)
            choices.append((float(np.sum(weighted[used] ** 2)), trial, end))
        _cost, best, end = min(choices, key=lambda row: row[0])
        tracks = best.anchored(end, best.unknowns.effects).tracks  # this motor bridges the gaps better
    return best, end
