"""The way back: what was found early has to hold its own beside all that was found later, or goes."""

from dataclasses import replace

from motor_identification.diagnosis.candidate_model import Model, Trial, judged
from motor_identification.diagnosis.effect_test import (
    MARGIN,
    STANDS_IN,
    as_in_the_table,
    lacking,
    size,
    threshold,
    tried,
)
from motor_identification.diagnosis.forward_selection import Step, Way
from motor_identification.estimation.least_squares import Speeds, descend
from motor_identification.estimation.parameter_space import carried
from motor_identification.progress import Telling
from motor_model.effects import EFFECT_BY_NAME

RIVALS = 3  # that are tried in a finding's place


def without_stand_ins(way: Way) -> Way:
    """Where the gap stays above the floor, nothing is named that may only stand in for what is not in the table.

    That is every finding that leaves a visible part of what it should explain, and what was found after it; a line in
    the spectrum over the angle is its own evidence.
    """
    if way.model.at_floor:
        return way
    for i, step in enumerate(way.steps):
        if step.explains < STANDS_IN and not EFFECT_BY_NAME[step.found.effect].periodic:
            return replace(way, steps=way.steps[:i], model=step.before)
    return way


def needed(way: Way, tell: Telling) -> Way:
    """The findings that are needed beside all others, or what does better in their place; and their rivals now.

    The last one too: fitted once more, the model may come to the same motion without it.
    """
    for step in way.steps:
        if any(one is step for one in way.steps):
            tell(f"checking {step.found.effect}", 0.9, step.found.effect, way.model.held.gap)
            way = _checked(way, step, tell)
    return way


def _checked(way: Way, step: Step, tell: Telling) -> Way:
    """One finding against the model without it, and against others in its place."""
    effect, current = step.found.effect, way.model
    without = _without(way, effect)
    if without.likelihood > current.likelihood - threshold():
        return _replaced(way, step, None, without)
    if step is way.steps[-1]:  # what could be in its place was tried beside it
        return way
    likely = [trial.effect for trial in step.trials if trial.effect != effect and trial.evidence > threshold()]
    others = [name for name in likely if name in lacking(without.effects) and name not in current.effects][:RIVALS]
    if not others:
        return _replaced(way, step, replace(step, rivals=()), current)

    def heard(trial: Trial) -> None:
        tell(f"{trial.effect} in place of {effect}", 0.9, effect, current.held.gap)

    trials = tried(without, way.kept, others, way.workers, heard)
    for trial in trials:
        grace = MARGIN if size(trial.effect) < size(effect) else -MARGIN
        if trial.model.likelihood > current.likelihood - grace:
            return _replaced(way, step, replace(step, found=trial, rivals=()), trial.model)
    alike = [trial.effect for trial in trials if trial.model.likelihood > current.likelihood - MARGIN]
    rivals = as_in_the_table(name for name in alike if size(name) <= size(effect))
    return _replaced(way, step, replace(step, rivals=rivals), current)


def _without(way: Way, effect: str) -> Model:
    """The last model without one effect, and without what there is only with it, fitted again."""
    current = way.model
    left = tuple(name for name in current.effects if name != effect and EFFECT_BY_NAME[name].implies != effect)
    smaller = current.problem.with_effects(left)
    start = carried(current.problem.unknowns, current.place, smaller.unknowns, {})
    place, _evaluations = descend(smaller, Speeds(smaller), start)
    return judged(way.kept, smaller, place)


def _replaced(way: Way, step: Step, by: Step | None, model: Model) -> Way:
    """The way with another step, or none, in the place of one; steps that the model does not have go too."""
    steps = [by if one is step else one for one in way.steps]
    return replace(way, steps=tuple(one for one in steps if one and one.found.effect in model.effects), model=model)
