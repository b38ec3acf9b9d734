"""The way up: effects join a model one after the other, each taken because held-out motion speaks for it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import sqrt

from motor_identification.diagnosis.candidate_model import Model, Trial, explained, judged
from motor_identification.diagnosis.effect_test import (
    STANDS_IN,
    accepted,
    lacking,
    rivals,
    size,
    threshold,
    tried,
)
from motor_identification.estimation.direction_correction import redirected
from motor_identification.estimation.least_squares import Speeds, descend, typical
from motor_identification.estimation.miscounts import cleaned, find_miscounted, without_tails
from motor_identification.estimation.problem import Problem
from motor_identification.progress import Telling
from motor_identification.recording import Floats
from motor_identification.validation.held_out import Kept
from motor_model.effects import EFFECT_BY_NAME

MOST = 6  # findings
NEAR = 3.0  # times the floor: where most intervals may only be spoilt by a few
FIRST_OF_TWO = 3  # effects that are tried together with any other where none alone is a finding,
BESIDE = 2  # and fewer than so many findings are there already: what is not in the table would cost minutes
OTHER_WAYS = 2  # to begin
NEARLY = 0.75  # of the evidence of the first finding: another way to begin


@dataclass(frozen=True)
class Step:
    """A finding in the making."""

    before: Model
    found: Trial
    trials: tuple[Trial, ...]  # all that were tried there, best first
    rivals: tuple[str, ...]  # effects that would do as well
    explains: float  # share of the excess over the floor that it takes away; of two that were found together, both do


@dataclass(frozen=True)
class Way:
    """Steps, where they lead, and what it is judged by; `workers` try effects at a time."""

    steps: tuple[Step, ...]
    model: Model
    kept: Kept
    workers: int


def settled(problem: Problem, place: Floats, kept: Kept) -> tuple[Model, Kept]:
    """Directions judged by this model, miscounted intervals left out, and fitted again.

    As long as the model lacks more, only few intervals are plainly off by whole slots. Where nothing else is left once
    all that look like it have gone, they were miscounted.
    """
    problem = redirected(problem, place)
    careful = problem.without(find_miscounted(problem, place))
    place, _evaluations = descend(careful, Speeds(careful), place)
    kept = kept.redirected(careful, place)
    model = judged(kept, careful, place)
    most = without_tails(problem, place)
    if most is not None and typical(problem, most[0])[1] * sqrt(len(problem.weight)) < NEAR * model.floor:
        clean, there, _evaluations = cleaned(problem, most[0])
        rest = judged(kept, clean, there)
        if rest.at_floor:
            return rest, kept.redirected(clean, there)
    return model, kept


def climbed(way: Way, tell: Telling, pairs: bool = True) -> Way:
    """Effects added as long as one is found; where none is and a gap is left, two at once if there are `pairs`."""
    while True:
        trials = _all_tried(way, tell)
        best = accepted(trials)
        if len(way.steps) >= MOST:
            return way
        if best is not None:
            way = _taken(way, [Step(way.model, best, tuple(trials), rivals(best, trials), best.explains)])
            continue
        hopeful = pairs and len(way.steps) < BESIDE and not way.model.at_floor
        pair = _pair(way, trials, tell) if hopeful else []
        if not pair:
            return way
        further = climbed(_taken(way, pair), tell, pairs=False)
        if not further.model.at_floor and pair[-1].explains <= STANDS_IN:
            return way
        way = further


def _taken(way: Way, steps: Sequence[Step]) -> Way:
    last = steps[-1].found.model
    return Way((*way.steps, *steps), *settled(last.problem, last.place, way.kept), way.workers)


def _all_tried(way: Way, tell: Telling) -> list[Trial]:
    """Every effect that the model lacks, where a finding could be made at all.

    Those that repeat with the angle only where others leave a gap; slots learnt without them hide it.
    """
    number, current = len(way.steps) + 1, way.model
    left = lacking(current.effects)
    count = 0

    def heard(trial: Trial) -> None:
        nonlocal count
        count += 1
        share = 0.1 + 0.8 * (1.0 - 0.5 ** (number - 1)) + 0.8 * 0.5**number * count / len(left)
        tell(f"step {number}: {trial.effect}", share, trial.effect, min(trial.model.held.gap, current.held.gap))

    plain = [] if current.quiet else [effect for effect in left if not _periodic(effect)]
    trials = tried(current, way.kept, plain, way.workers, heard)
    best = accepted(trials)
    if best is None or best.model.above_floor:
        for effect in sorted(filter(_periodic, left), key=size):  # an eccentricity is a line in a ripple's spectrum too
            least = max((trial.evidence for trial in trials), default=0.0)
            trials += tried(current, way.kept, [effect], way.workers, heard, max(least, 0.0))
    return sorted(trials, key=lambda trial: -trial.evidence)


def _periodic(effect: str) -> bool:
    return EFFECT_BY_NAME[effect].periodic


def _pair(way: Way, trials: Sequence[Trial], tell: Telling) -> list[Step]:
    """The two effects that explain most together where neither does alone, as two steps; none if there are no such."""
    current, found = way.model, []
    likely = [trial for trial in trials if trial.evidence > threshold() and not _periodic(trial.effect)]
    for i, first in enumerate(likely[:FIRST_OF_TWO]):
        left = [effect for effect in lacking(first.model.effects) if not _periodic(effect)]

        def heard(trial: Trial, first: Trial = first) -> None:
            tell(f"{first.effect} with {trial.effect}", 0.5, trial.effect, trial.model.held.gap)

        seconds = tried(first.model, way.kept, left, way.workers, heard)
        second = accepted(seconds)
        if second is None:
            continue
        together = explained(current.held.gap, second.model.held.gap, second.model.floor)
        steps = [
            Step(current, first, tuple(trials), (), together),
            Step(first.model, second, tuple(seconds), rivals(second, seconds), together),
        ]
        found.append((second.model.likelihood, -i, steps))
    return max(found)[2] if found else []


def by_another_way(way: Way, tell: Telling) -> Way:
    """Where the gap stays above the floor, what was nearly taken first is taken instead, and all that follows from it.

    While others are missing too, one effect can do as well as another, and the wrong one blocks the way; not one that
    explains nearly everything.
    """
    if not way.steps or way.model.at_floor or way.steps[0].explains > STANDS_IN:
        return way
    first = way.steps[0]
    likely = max(NEARLY * first.found.evidence, threshold())
    others = [trial for trial in first.trials if trial is not first.found and trial.evidence > likely]
    for trial in others[:OTHER_WAYS]:
        left = tuple(name for name in first.rivals if name != trial.effect)
        begun = Step(first.before, trial, first.trials, left, trial.explains)
        start = Way((begun,), *settled(trial.model.problem, trial.model.place, way.kept), way.workers)
        other = climbed(start, tell, pairs=False)
        if other.model.held.gap < way.model.held.gap:
            way = other
        else:
            rest = tuple(name for name in way.steps[0].rivals if name != trial.effect)
            way = replace(way, steps=(replace(way.steps[0], rivals=rest), *way.steps[1:]))
    return way
