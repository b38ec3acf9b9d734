"""Hold data out of the fits to validate them on: other recordings, or blocks of the same ones.

Where the command hardly swings in any blocks, as in a recording of a single step, they would show a motor that turns,
and nothing of its response: then nothing is held out, and every unknown has its price instead.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, TypeVar

import numpy as np

from motor_identification.estimation.direction_correction import correct_directions
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.miscounts import mark_miscounts
from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.estimation.thinning import thin_problem
from motor_identification.measurement.command_swing import count_levels, count_responses, measure_swings
from motor_identification.measurement.time_blocks import TimeBlocks
from motor_identification.noise.run_gain import FEWEST_RUNS
from motor_identification.recording import Bools, Floats, Recording
from motor_identification.validation.held_out import HeldOut
from motor_identification.validation.instants import list_instants
from motor_identification.validation.nuisance_fit import fit_nuisance_parameters

# Of what counts in a recording: more is not left out, however unforeseen. One block of three would be a third of it.
MOST_LEFT_OUT = 0.25

# How much a command swings where a motor can be judged by its responses: a step up, down and up again.
LEAST_SWING = 3.0
# Levels of the command, or as much swing, from which on a recording is more than a step.
LEAST_LEVELS = 4
# The same of steps from level to level, however near these are. Measured: a load step by 83 in seven steps one way
# between half and all of the voltage, which swing by 2.3.
LEAST_RESPONSES = 5
# Of how much the command would swing in held-out blocks by chance, at least. Measured: of up to 9 times its largest
# voltage, real logs of one to twenty steps have 0 to 0.4 in every fourth of the usual blocks, those of a random or a
# controlled voltage 20 % and more.
LEAST_SWING_SHARE = 0.5
# Of the travel that held-out blocks would have by chance, at least, where other blocks have it. Measured: 0.2 and 0.5
# of trains of pulses with a period of four blocks: the same ten rows of every pulse were held out, and no stop.
LEAST_TRAVEL_SHARE = 0.7
# The same of the travel one way, of what a tenth of the travel or more goes: what differs from way to way has to be
# seen on both. Less is a sensor's noise, or the swing at the end of a stop. Measured: 0.04 of a real servo's steps to
# and fro, in blocks that had 1.5 of the other way; 0.44 and more of random voltages.
LEAST_WAY, LEAST_WAY_SHARE = 0.1, 0.3
# Of the usual length, of blocks that are tried: no period of a command divides them all.
STRETCHES = (1.0, 1.37, 1.9, 2.6, 3.6, 5.0)

Self = TypeVar("Self", bound="HoldOut")


@dataclass(frozen=True)
class HoldOut(ABC):
    """Recordings to validate a fitted motor on, and the blocks of them that count in the gap."""

    problem: Problem  # of these recordings, without effects
    scored_blocks: TimeBlocks  # which count in the gap
    confirms: bool = True  # there is more than a step
    seen: ClassVar[bool] = False  # whether the fit has seen what counts

    @abstractmethod
    def apply(self, fitted: Estimate) -> Estimate:
        """Apply a fitted motor to these recordings."""

    @abstractmethod
    def restrict(self, training: Problem) -> Problem:
        """Take what counts in the gap out of a training problem."""

    def validate(self, fitted: Estimate) -> HeldOut:
        """Validate a fitted motor: simulate held-out motion, and mark what counts in the gap."""
        here = self.apply(fitted)
        intervals, increments = here.problem.intervals, here.increments
        bad = tuple(mark_miscounts(data, part) for data, part in zip(intervals, increments, strict=True))
        blocks = self.scored_blocks.mark_each(intervals, here.problem.sample_period)
        counted = tuple(block & ~marks for block, marks in zip(blocks, bad, strict=True))
        instants = tuple(
            _leave_out_few(block, self.scored_blocks.mark_near(times, data, here.problem.sample_period))
            for block, data, times in zip(counted, intervals, list_instants(here), strict=True)
        )
        scored = tuple(block & ~instant for block, instant in zip(counted, instants, strict=True))
        miscounted = int(sum(marks.sum() for marks in bad))
        motion = here.problem.recordings, intervals, here.angles
        several = max(len(intervals), len(fitted.problem.recordings)) >= FEWEST_RUNS
        responses = here.supply_responses if several else ()
        return HeldOut(*motion, here.parameters, scored, miscounted, instants, self.seen, self.confirms, responses)

    def correct_directions(self: Self, fitted: Estimate) -> Self:
        """Read the held-out recordings again, with directions by the motion of a fitted motor."""
        intervals = correct_directions(self.apply(fitted)).problem.intervals
        return replace(self, problem=replace(self.problem, intervals=intervals))


def _leave_out_few(counted: Bools, instants: Bools) -> Bools:
    """Mark what counts in the blocks of instants (I,): nothing where that is much of it, which no gap would be of."""
    marks = np.asarray(counted & instants)
    return marks & (np.count_nonzero(marks) <= MOST_LEFT_OUT * np.count_nonzero(counted))


@dataclass(frozen=True)
class OtherRecordings(HoldOut):
    """Other recordings of the motor: every other block is for their nuisance parameters, the rest counts."""

    def apply(self, fitted: Estimate) -> Estimate:
        """Fit what belongs to these recordings on the blocks that do not count; the motor stays as it is."""
        blocks = self.scored_blocks.mark_each(self.problem.intervals, self.problem.sample_period)
        return fit_nuisance_parameters(self.problem, fitted, tuple(~block for block in blocks))

    def restrict(self, training: Problem) -> Problem:
        """Keep all of the training recordings: none of them is held out."""
        return training


@dataclass(frozen=True)
class BlocksOfSame(HoldOut):
    """Every fourth block of the training recordings themselves: what belongs to them is known from the fit."""

    def apply(self, fitted: Estimate) -> Estimate:
        """Apply the same unknowns to all blocks; the angle in those that are held out is measured there."""
        here = replace(self.problem, unknowns=fitted.problem.unknowns)
        if fitted.problem.tracks:
            whole = here.on_measured_angle(fitted.theta, here.unknowns.effects).tracks
            rows = zip(fitted.problem.tracks, whole, strict=True)
            here = replace(here, tracks=tuple(track.fill_in(measured) for track, measured in rows))
        return fitted.on(here)

    def restrict(self, training: Problem) -> Problem:
        """Take these blocks out."""
        return training.keeping_out(self.scored_blocks)


@dataclass(frozen=True)
class WholeRecordings(BlocksOfSame):
    """The training recordings themselves, nothing held out: the fit has seen all that it is judged by."""

    seen: ClassVar[bool] = True

    def restrict(self, training: Problem) -> Problem:
        """Keep all of the training recordings."""
        return training


def make_hold_out(
    recordings: Sequence[Recording],
    validation: Sequence[Recording],
    stopped: Callable[[], bool] | None = None,
) -> HoldOut:
    """Hold out `validation`, or every fourth block of the recordings themselves, if the command swings in these.

    Raises:
        RecordingError: a recording has no usable motion.
    """
    problem = thin_problem(make_problem(validation or recordings, (), stopped=stopped))
    if validation:
        return OtherRecordings(problem, TimeBlocks(2))
    swings = [measure_swings(recording) for recording in recordings]
    every = sum(float(part.sum()) for part in swings)
    tried = [TimeBlocks(4, stretch) for stretch in STRETCHES]
    least = max(LEAST_SWING, LEAST_SWING_SHARE * every / tried[0].every)
    swinging = [blocks for blocks in tried if sum_held_swing(problem, swings, blocks) >= least]
    if swinging:
        return BlocksOfSame(problem, _choose_travelling(problem, swinging))
    several = every >= LEAST_SWING or count_levels(recordings) >= LEAST_LEVELS
    several = several or count_responses(recordings) >= LEAST_RESPONSES
    return WholeRecordings(problem, TimeBlocks(1), several)


def _choose_travelling(problem: Problem, tried: Sequence[TimeBlocks]) -> TimeBlocks:
    """Choose the first blocks in which enough of the travel is, both ways, or those that come nearest to it."""
    nearest = {}
    for blocks in tried:
        held = measure_held_travel(problem, blocks)
        nearest[blocks] = min(held.share / LEAST_TRAVEL_SHARE, held.share_one_way / LEAST_WAY_SHARE)
        if nearest[blocks] >= 1.0:
            return blocks
    return max(nearest, key=nearest.__getitem__)


def sum_held_swing(problem: Problem, swings: Sequence[Floats], blocks: TimeBlocks) -> float:
    """Sum up how much the command swings in some blocks of every recording.

    swings: of its samples, in units of its largest voltage, shape (K,) each.
    """
    held = 0.0
    rows = zip(problem.recordings, problem.intervals, swings, strict=True)
    for number, (recording, data, own) in enumerate(rows):
        held += float(own[blocks.find_times(recording.time, data, problem.sample_period, number)].sum())
    return held


@dataclass(frozen=True)
class HeldTravel:
    """How much of the travel is in some blocks, 1 for as much as by chance."""

    share: float
    share_one_way: float  # of the way of which least is, unless hardly any goes that way


def measure_held_travel(problem: Problem, blocks: TimeBlocks) -> HeldTravel:
    """Measure how much of the travel of all recordings is in some blocks of theirs."""
    marks = np.concatenate(blocks.mark_each(problem.intervals, problem.sample_period))
    travel = np.concatenate([np.sign(data.speed) * data.travel for data in problem.intervals])
    both, *ways = (np.abs(np.where(way, travel, 0.0)) for way in (travel != 0.0, travel > 0.0, travel < 0.0))
    every = float(both.sum())
    if every == 0.0:
        return HeldTravel(0.0, 0.0)
    of_way = [float(way[marks].sum() / way.sum()) for way in ways if way.sum() > LEAST_WAY * every]
    return HeldTravel(blocks.every * float(both[marks].sum()) / every, blocks.every * min(of_way))
