"""Compare candidate models on held-out data, with and without one more effect, and decide whether that matters."""

from dataclasses import dataclass
from functools import cached_property

from motor_identification.diagnosis import thresholds
from motor_identification.estimation.estimate import Estimate
from motor_identification.noise.likelihood import Noise, estimate_noise
from motor_identification.validation.held_out import HeldOut
from motor_identification.validation.hold_out import HoldOut


@dataclass(frozen=True)
class Model:
    """A fitted motor, and how it does on held-out data."""

    estimate: Estimate  # on its training data
    held: HeldOut
    noise: Noise  # what it leaves in the training data
    likelihood: float  # logarithm, of the held-out data

    @property
    def effects(self) -> tuple[str, ...]:
        """What it has beyond kv and ka."""
        return self.estimate.problem.unknowns.effects

    @property
    def floor(self) -> float:
        """[rad/s] the gap that timer and slots alone leave."""
        return self.held.floor(self.noise.share)

    @cached_property
    def lasting(self) -> HeldOut:
        """What it leaves in lasting intervals."""
        return self.held.joined(thresholds.LASTING_INTERVAL)

    @cached_property
    def quiet(self) -> bool:
        """Whether it leaves nothing that lasts, so that no further effect could be relevant."""
        return self.lasting.gap < thresholds.QUIET_GAP * self.lasting.floor(self.noise.share)

    @property
    def at_floor(self) -> bool:
        """Whether nothing is left to explain."""
        return self.held.gap <= thresholds.EXPLAINED_GAP * self.floor

    @property
    def above_floor(self) -> bool:
        """Whether something is; neither where there is nothing to judge by, and the gap no number."""
        return self.held.gap > thresholds.EXPLAINED_GAP * self.floor


@dataclass(frozen=True)
class CandidateTest:
    """A model with one more effect, beside the one without it."""

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
        return share_explained(self.before.held.gap, self.model.held.gap, self.model.floor)

    @cached_property
    def relevant(self) -> bool:
        """Whether it takes away a good part of what lasts longer than the encoder's noise."""
        before, after = self.before.lasting, self.model.lasting
        floor = after.floor(self.model.noise.share)
        if before.gap < thresholds.RELEVANT_GAP * floor:
            return False
        near = self.before.held.gap <= thresholds.EXPLAINED_GAP * self.model.floor
        least = thresholds.RELEVANT_SHARE_NEAR_FLOOR if near else thresholds.RELEVANT_SHARE
        seen = self.model.held.gap < (1.0 - thresholds.LEAST_DROP) * self.before.held.gap
        return seen and share_explained(before.gap, after.gap, floor) > least


def share_explained(before: float, after: float, floor: float) -> float:
    """Compute the share of a gap's excess over the noise floor, in squares, that is gone after."""
    return (before**2 - after**2) / (before**2 - floor**2) if before > floor else 1.0


def validate_model(hold_out: HoldOut, estimate: Estimate) -> Model:
    """Validate an estimate on held-out data, under the noise that it leaves in its training data."""
    held = hold_out.validate(estimate)
    noise = estimate_noise(list(zip(estimate.problem.intervals, estimate.increments, strict=True)))
    return Model(estimate, held, noise, held.log_likelihood(noise))
