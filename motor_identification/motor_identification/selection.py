"""One step of a diagnosis: every effect that a model lacks is tried, and judged on data that no fit has seen."""

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from math import log

from motor_identification.candidates import extended
from motor_identification.evidence import Noise, likely_noise
from motor_identification.held_out import HeldOut, Kept
from motor_identification.problem import Problem
from motor_identification.recording import Floats
from motor_model.effects import EFFECT_BY_NAME

FALSE_ALARMS = 0.01  # chance that a complete model is given an effect that it does not have
MARGIN = 5.0  # of log likelihood by which a finding has to beat another effect, else both are named
TIE = 0.5  # of log likelihood within which the more common effect is taken, the one that is earlier in the table
RELEVANT = 0.3  # share of the excess over the noise floor that a finding has to explain,
MOSTLY = 0.5  # the same where the gap is at the floor already (see AT_FLOOR),
SEEN = 0.03  # and share of the gap that has to go; and the gap before has to be
ABOVE = 1.15  # times the floor,
LASTING = 0.1  # [s] all that in intervals of this length: of a coarse encoder, shorter ones show little but its steps
LEAST = 1e-3  # share of the gap itself that has to go in any case
QUIET = 1.05  # times the floor in lasting intervals, less than ABOVE: from there on nothing can be found
STANDS_IN = 0.95  # of the excess: what explains less and leaves the gap above the floor may stand in for another effect
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


def lacking(effects: Sequence[str]) -> list[str]:
    """The effects a model can be given next: what it does not have, whose own condition it has."""
    return [
        effect.name
        for effect in EFFECT_BY_NAME.values()
        if effect.name not in effects
        and effect.name != "missed_edges"
        and (effect.implies is None or effect.implies in effects)
    ]


def tried(
    current: Model,
    kept: Kept,
    effects: Sequence[str],
    workers: int,
    heard: Callable[[Trial], None],
    least: float = 0.0,
) -> list[Trial]:
    """Every effect added to a model, best first; `heard` is told of each as it is done.

    A periodic effect is not fitted where its spectrum promises less than `least`.
    """

    def one(effect: str) -> Trial:
        larger = extended(current.problem, current.place, effect, least)
        if larger is None:
            trial = Trial(effect, current, current)
        elif EFFECT_BY_NAME[effect].periodic:  # it may turn the shaft back where the model without it does not
            own = kept.redirected(*larger[:2])
            trial = Trial(effect, judged(own, current.problem, current.place), judged(own, *larger[:2]))
        else:
            trial = Trial(effect, current, judged(kept, *larger[:2]))
        heard(trial)
        return trial

    with ThreadPoolExecutor(max(workers, 1)) as pool:
        return sorted(pool.map(one, effects), key=lambda trial: -trial.evidence)


def threshold() -> float:
    """What the logarithm of the likelihood ratio has to exceed, by Markov's inequality for all effects together."""
    return log(len(EFFECT_BY_NAME) / FALSE_ALARMS)


def accepted(trials: Sequence[Trial]) -> Trial | None:
    """The trial that is a finding, if there is one: likely, and relevant to the gap; of equals the most common."""
    best = next((trial for trial in trials if _convinces(trial)), None)
    if best is None:
        return None
    equals = [
        trial
        for trial in trials
        if trial.evidence > best.evidence - TIE and size(trial.effect) <= size(best.effect) and _convinces(trial)
    ]
    return min(equals, key=lambda trial: list(EFFECT_BY_NAME).index(trial.effect))


def _convinces(trial: Trial) -> bool:
    return trial.evidence > threshold() and trial.relevant and _visible(trial)


def size(effect: str) -> int:
    """Number of parameters of an effect."""
    return len(EFFECT_BY_NAME[effect].parameters)


def _visible(trial: Trial) -> bool:
    """Whether an eccentricity is more than the first harmonic that random slots have by chance."""
    if trial.effect != "encoder_eccentricity":
        return True
    unknowns = trial.model.problem.unknowns
    size = float(trial.model.place[unknowns.names.index("eccentricity")])
    slot = max(data.slot for data in trial.model.problem.intervals)
    chance = trial.model.noise.share * slot * (2.0 * slot / 6.2832) ** 0.5
    return bool(size > 5.0 * chance)


def rivals(found: Trial, trials: Sequence[Trial]) -> tuple[str, ...]:
    """Effects that explain as much as a finding does, and with no more parameters."""
    least = max(found.evidence - MARGIN, threshold())
    alike = [trial.effect for trial in trials if trial.effect != found.effect and trial.evidence > least]
    return as_in_the_table(name for name in alike if size(name) <= size(found.effect))


def as_in_the_table(names: Iterable[str]) -> tuple[str, ...]:
    """Effects in the table's order: it does not depend on the last digit of a likelihood."""
    given = set(names)
    return tuple(name for name in EFFECT_BY_NAME if name in given)
