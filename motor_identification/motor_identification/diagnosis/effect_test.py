"""One step of a diagnosis: every effect that a model lacks is tried, and judged on data that no fit has seen."""

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from math import log

from motor_identification.diagnosis.candidate_model import Model, Trial, judged
from motor_identification.diagnosis.effect_fit import extended
from motor_identification.validation.held_out import Kept
from motor_model.effects import EFFECT_BY_NAME

FALSE_ALARMS = 0.01  # chance that a complete model is given an effect that it does not have
MARGIN = 5.0  # of log likelihood by which a finding has to beat another effect, else both are named
TIE = 0.5  # of log likelihood within which the more common effect is taken, the one that is earlier in the table
STANDS_IN = 0.95  # of the excess: what explains less and leaves the gap above the floor may stand in for another effect


def lacking(effects: Sequence[str]) -> list[str]:
    """The effects a model can be given next: what it does not have, whose own condition it has."""
    return [
        effect.name
        for effect in EFFECT_BY_NAME.values()
        if effect.name not in effects and effect.fitted and (effect.implies is None or effect.implies in effects)
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
    effect = EFFECT_BY_NAME[trial.effect]
    if not effect.on_disc:
        return True
    unknowns = trial.model.problem.unknowns
    size = float(trial.model.place[unknowns.names.index(effect.parameters[0].name)])
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
