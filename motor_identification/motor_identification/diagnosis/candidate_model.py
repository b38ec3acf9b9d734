"""A trial: a fitted model on held-out data, with and without one more effect, and whether that matters to its user."""

from dataclasses import dataclass
from functools import cached_property

from motor_identification.estimation.problem import Problem
from motor_identification.noise.likelihood import Noise, likely_noise
from motor_identification.recording import Floats
from motor_identification.validation.held_out import HeldOut, Kept

RELEVANT = 0.3  # share of the excess over the noise floor that a finding has to explain,
MOSTLY = 0.5  # the same where the gap is at the floor already (see AT_FLOOR),
SEEN = 0.03  # and share of the gap that has to go; and the gap before has to be
ABOVE = 1.15  # times the floor,
LASTING = 0.1  # [s] all that in intervals of this length: of a coarse encoder, shorter ones show little but its steps
LEAST = 1e-3  # share of the gap itself that has to go in any case
QUIET = 1.05  # times the floor in lasting intervals, less than ABOVE: from there on nothing can be found
AT_FLOOR = 1.3  # times the noise floor: explained


@dataclass(frozen=True)
class Model:
    """A fitted motor, and how it does on held-out data."""

    problem: Problem  # its training data
    place: Floats
    held: HeldOut
    noise: Noise  # what it leaves in the training data
    likelihood: float  # logarithm, of the held-out data

    @property
    def effects(self) -> tuple[str, ...]:
        """What it has beyond kv and ka."""
        return self.problem.unknowns.effects

    @property
    def floor(self) -> float:
        """[rad/s] the gap that timer and slots alone leave."""
        return self.held.floor(self.noise.share)

    @cached_property
    def quiet(self) -> bool:
        """Whether it leaves nothing that lasts, so that no further effect could be relevant."""
        return self.lasting.gap < QUIET * self.lasting.floor(self.noise.share)

    @cached_property
    def lasting(self) -> HeldOut:
        """What it leaves in lasting intervals."""
        return self.held.joined(LASTING)

    @property
    def at_floor(self) -> bool:
        """Whether nothing is left to explain."""
        return self.held.gap <= AT_FLOOR * self.floor

    @property
    def above_floor(self) -> bool:
        """Whether something is; neither where there is nothing to judge by, and the gap no number."""
        return self.held.gap > AT_FLOOR * self.floor


@dataclass(frozen=True)
class Trial:
    """A model with one more effect."""

    effect: str
    before: Model  # without it, on the same held-out intervals
    model: Model

    @property
    def evidence(self) -> float:
        """Logarithm of the likelihood ratio to the model without it."""
        return self.model.likelihood - self.before.likelihood

    @property
    def explains(self) -> float:
        """Share of the excess over the noise floor that it takes away."""
        return explained(self.before.held.gap, self.model.held.gap, self.model.floor)

    @cached_property
    def relevant(self) -> bool:
        """Whether it takes away a good part of what lasts longer than the encoder's noise."""
        before, after = self.before.lasting, self.model.lasting
        floor = after.floor(self.model.noise.share)
        if before.gap < ABOVE * floor:
            return False
        explains = explained(before.gap, after.gap, floor)
        near = self.before.held.gap <= AT_FLOOR * self.model.floor
        seen = after.gap < (1.0 - SEEN) * before.gap and self.model.held.gap < (1.0 - LEAST) * self.before.held.gap
        return seen and explains > (MOSTLY if near else RELEVANT)


def explained(before: float, after: float, floor: float) -> float:
    """Share of a gap's excess over the noise floor, in squares, that is gone after."""
    return (before**2 - after**2) / (before**2 - floor**2) if before > floor else 1.0


def judged(kept: Kept, problem: Problem, place: Floats) -> Model:
    """A fitted motor on held-out data."""
    held = kept.judged(problem, place)
    noise = likely_noise(list(zip(problem.intervals, problem.increments(place), strict=True)))
    return Model(problem, place, held, noise, held.log_likelihood(noise))
