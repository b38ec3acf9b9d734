"""Drop findings that may only stand in for what is not in the table, where the gap stays above the floor."""

from collections.abc import Sequence
from dataclasses import replace

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import refit_without
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import likelihood_threshold, share_explained
from motor_identification.diagnosis.effect_test import is_static, list_candidates, sort_by_table, try_effects
from motor_identification.diagnosis.evidence.calm_evidence import explains_calm
from motor_identification.diagnosis.evidence.standstill_evidence import explains_standstills
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep
from motor_identification.discrepancy.free_curves import PAST, REPEATING
from motor_identification.validation.instants import comes_slowly, needs_instant
from motor_model.effects import EFFECT_BY_NAME


def drop_stand_ins(selection: Selection) -> Selection:
    """Drop what may only stand in for an effect that is not in the table, where the gap stays above the floor.

    That is every finding that leaves a visible part of what it should explain, and what was found after it; a line in
    the spectrum over the angle is its own evidence, and so is a standstill under a voltage, or friction nearly all of
    the time. Where what is left comes and goes whatever the motor does, no finding that answers its motion stands in
    for that; and no friction for what goes with the past, such as a sensor's filter. Where nothing else is left, nor
    does anything that is said by speed and voltage of the moment, as a coasting bridge is: those are explained. Nor
    does a warming-up that is not quite the table's, as where the heat follows the drive.
    """
    if selection.model.complete:
        return selection
    apart = leaves_mostly(selection.model, REPEATING)
    past = leaves_mostly(selection.model, (PAST, *REPEATING), thresholds.MINOR_SHARE)
    past_alone = leaves_mostly(selection.model, (PAST, *REPEATING))
    for i, step in enumerate(selection.steps):
        effect = EFFECT_BY_NAME[step.found.effect]
        answers = (apart and not effect.anywhere) or (past and effect.holds) or (past_alone and is_static(effect.name))
        least = thresholds.SLOW_SHARE if apart and comes_slowly(effect.name) else thresholds.STAND_IN_SHARE
        stays = step.explains > (thresholds.APART_SHARE if answers else least)
        after = selection.steps[i + 1].before if i + 1 < len(selection.steps) else selection.model
        if not stays and not is_own_evidence(step.found.effect, step.before, after):
            return replace(selection, steps=selection.steps[:i], model=step.before)
    return selection


def leaves_mostly(model: Model, variables: Sequence[str], minor: float = 0.0) -> bool:
    """Decide whether what can be predicted of what is left goes with some variables, but for a minor share of that."""
    certain = [one for one in model.structure if one.certain]
    own = [one.share for one in certain if one.variable in variables]
    others = [one.share for one in certain if one.variable not in variables]
    return bool(own) and max(others, default=0.0) <= minor * max(own)


def is_own_evidence(effect: str, without: Model, model: Model) -> bool:
    """Decide whether an effect is told by what nothing outside the table does, from a model without it and with it."""
    row = EFFECT_BY_NAME[effect]
    if not row.holds:
        return row.periodic
    # What bends the motion at some speeds, as a friction that falls with them does, may stand in for other bends.
    return explains_standstills(without, model) or (row.linear_onset and explains_calm(without, model))


def has_same_evidence(other: Model, without: Model, model: Model) -> bool:
    """Decide whether another model explains what an effect that holds the motor is told by, from a model without it."""
    explains = explains_standstills if explains_standstills(without, model) else explains_calm
    return explains(without, other)


def drop_stand_ins_of_either(first: Selection, second: Selection) -> Selection:
    """Drop what may only stand in for something from two selections, and choose the one that keeps more findings.

    From each in the order in which they were found, and by what each does beside all others. Of equals the one with the
    smaller gap.
    """
    if second.model.complete:
        return second
    several = (first,) if first is second else (first, second)
    left = [drop(one) for one in several for drop in (drop_stand_ins, drop_unneeded)]
    return max(left, key=lambda one: (len(one.steps), -one.model.held.gap))


def drop_unneeded(selection: Selection) -> Selection:
    """Drop the finding that explains least beside all others, as long as that may stand in for what is not there.

    What explains little alone may explain nearly everything beside what was found after it: a friction under which a
    coasting bridge is another one.
    """
    while selection.steps and not selection.model.complete:
        model, weakest = selection.model, None
        for step in selection.steps:
            without = refit_without(model, step.found.effect, selection.hold_out)
            share = share_explained(without.held.gap, model.held.gap, model.unpredictable_gap)
            stays = share > thresholds.STAND_IN_SHARE or is_own_evidence(step.found.effect, without, model)
            if not stays and (weakest is None or share < weakest[0]):
                weakest = share, step, without
        if weakest is None:
            break
        selection = selection.replace_step(weakest[1], None, weakest[2])
    return selection


def doubt_instants(selection: Selection) -> Selection:
    """Add to what begins at an instant the effects that explain nearly as much without one, where a gap is left.

    The instant that fits best is the command's own, where a friction or another gain between two levels is missing.
    """
    if selection.model.complete:
        return selection
    return replace(selection, steps=tuple(_doubt_instant(step, selection) for step in selection.steps))


def _doubt_instant(step: SelectionStep, selection: Selection) -> SelectionStep:
    if not needs_instant(step.found.effect):
        return step
    model, without = selection.model, refit_without(selection.model, step.found.effect, selection.hold_out)
    least = share_explained(without.held.gap, model.held.gap, model.unpredictable_gap) - thresholds.NEARLY_AS_MUCH
    names = list_candidates(without.effects, without.held, without.beside_torque)
    steady = [name for name in names if not needs_instant(name) and not EFFECT_BY_NAME[name].periodic]
    tests = try_effects(without, selection.hold_out, steady, selection.workers, lambda test: None)
    alike = {test.effect for test in tests if test.evidence > likelihood_threshold() and test.explains > least}
    return replace(step, rivals=sort_by_table({*step.rivals, *alike}))


def keep_confirmed(selection: Selection, effects: Sequence[str]) -> Selection:
    """Keep the findings up to the first that another selection does not have; effects: of that one's model."""
    for i, step in enumerate(selection.steps):
        if step.found.effect not in effects:
            return replace(selection, steps=selection.steps[:i], model=step.before)
    return selection
