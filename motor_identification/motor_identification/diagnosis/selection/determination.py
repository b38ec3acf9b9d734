"""Drop what is not determined: an effect of which nothing can be said but that something like it is missing."""

from dataclasses import replace

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold, predicts_far_worse
from motor_identification.diagnosis.effect_test import sort_by_table, try_effects
from motor_identification.diagnosis.evidence.line_evidence import is_no_ripple
from motor_identification.diagnosis.selection.backward_elimination import drop_step, eliminate_backward
from motor_identification.diagnosis.selection.chance import (
    count_errors_beside_torque,
    has_vague_instant,
    is_chance,
    is_chance_size,
)
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep
from motor_identification.progress import ProgressReporter
from motor_identification.uncertainty.summary import find_bounds_hit
from motor_identification.validation.instants import needs_instant
from motor_model.effects import EFFECT_BY_NAME, SPEC_BY_NAME


def drop_undetermined(selection: Selection, reporter: ProgressReporter) -> tuple[Selection, tuple[str, ...]]:
    """Drop the findings whose one parameter the training data do not determine; and name them with their rivals.

    First the one whose absence costs least likelihood: of effects that do each other's work, what is left is then
    determined. One that has a rival which is determined gives way to that. What is not needed any more goes, too. What
    has a size by chance, predicts no better with it and leaves a complete model, is not named.
    """
    dropped: list[str] = []
    gone: set[str] = set()  # of which some is not worth telling
    settled: set[tuple[frozenset[str], str]] = set()  # in which company an effect stays, or was exchanged once
    while weak := _list_weak(selection, settled):
        reporter.report("checking what is determined", 0.95, "", selection.model.held.gap)
        without = {step.found.effect: drop_step(selection, step) for step in weak}
        step = max(weak, key=lambda one: without[one.found.effect].model.likelihood)
        smaller = without[step.found.effect]
        settled.add((frozenset(selection.model.effects), step.found.effect))
        rival = _replace_by_rival(selection, step, smaller.model)
        if rival is not None:
            selection = rival
            continue
        if is_needed(step, selection.model, smaller.model) or is_steady_beside_torque(step, selection, smaller):
            continue
        gone |= {step.found.effect, *step.rivals}
        if not (smaller.model.complete and is_chance(step.found.effect, selection.model)):
            dropped += [step.found.effect, *step.rivals]
        selection = _eliminate_unless_seen(smaller, reporter)
        if any(one.found.effect in gone for one in selection.steps):  # back in the place of another: no circles
            selection = smaller
    return selection, sort_by_table(set(dropped) - set(selection.model.effects))


def drop_undetermined_at_once(selection: Selection) -> Selection:
    """Drop the findings that are not determined, the last one first, where no time is left to compare them."""
    for step in reversed(selection.steps):
        if step.found.effect in find_undetermined(selection.model):
            smaller = drop_step(selection, step)
            selection = selection if is_needed(step, selection.model, smaller.model) else smaller
    return selection


def _list_weak(selection: Selection, settled: set[tuple[frozenset[str], str]]) -> list[SelectionStep]:
    """List the steps of undetermined effects that are not settled in this company."""
    undetermined = find_undetermined(selection.model) if selection.steps else ()
    company = frozenset(selection.model.effects)
    effects = [effect for effect in undetermined if (company, effect) not in settled]
    return [step for step in selection.steps if step.found.effect in effects]


def _eliminate_unless_seen(smaller: Selection, reporter: ProgressReporter) -> Selection:
    """Eliminate what is not needed any more; not what leaves a far larger gap, in which something can be predicted.

    Nor what is unlikely to be absent together: a slow torque does in turn for each what it does not for all of them.
    """
    if not smaller.steps:
        return smaller
    rest = eliminate_backward(smaller, reporter)
    seen = predicts_far_worse(rest.model.held.gap, smaller.model.held.gap) and not rest.model.complete
    lost = len(smaller.steps) - len(rest.steps)
    beside = rest.outside is None and smaller.model.beside_torque and rest.model.beside_torque
    unlikely = beside and smaller.model.likelihood - rest.model.likelihood > lost * likelihood_threshold()
    return smaller if seen or (lost > 0 and unlikely) else rest


def is_needed(step: SelectionStep, model: Model, without: Model) -> bool:
    """Decide whether a finding is seen in the gap: one block of time tells it, with wide errors.

    Such as an instant, a warming-up of which only the product of rise and rate shows, or a friction that one slow step
    of a staircase tells; not where that is one of several effects, unless one of those it takes, or ended at a limit of
    the search. Measured: a dead time of 26 ± 9 ms, or an inductance, of eight steps, likelier by 253. A line that
    repeats with the angle makes any gap smaller that it was fitted to; one that is larger than ripples are, and goes
    round more than once a turn, bends it as any curve over the place; and beside a motor whose own back-EMF is not
    determined, anything does. What came at no instant was no step, nor what has a size by chance where everything is
    explained without it; nor is anything of which a size at a limit of the search is all that is known.
    """
    effect = EFFECT_BY_NAME[step.found.effect]
    if effect.periodic and (model.held.seen or is_no_ripple(model, effect.name)):
        return False
    if "kv" in model.uncertainty.not_identifiable:
        return False
    if has_vague_instant(effect.name, model) or (without.complete and is_chance_size(effect.name, model)):
        return False
    limits = find_limits_hit(model)
    if effect.parameters[0].name in limits and is_undetermined(effect.name, model.uncertainty.not_identifiable):
        return False
    several = bool(step.rivals) and (without.complete or not model.complete)
    told = effect.anywhere or not (several or any(spec.name in limits for spec in effect.parameters))
    return told and without.held.gap > thresholds.WORSE_GAP * model.held.gap


def is_steady_beside_torque(step: SelectionStep, selection: Selection, without: Selection) -> bool:
    """Decide whether a size that by its standard error is chance is told by what knows of a random torque, or gains.

    The motion speaks for it all the time: by far, or with a size of some standard errors beside a torque that is all
    that is left. Of an effect that bends what others do a standard error says little: a share of 1.00 ± 0.33.
    """
    effect, model = step.found.effect, selection.model
    if not model.beside_torque or step.rivals or EFFECT_BY_NAME[effect].periodic or needs_instant(effect):
        return False
    chance = is_chance_size(effect, model)
    if not (chance or is_undetermined(effect, model.uncertainty.not_identifiable)):  # but for a limit that it ended at
        return False
    steadiness = CandidateTest(effect, without.model, model).steadiness
    told = count_errors_beside_torque(effect, model) > thresholds.STEADY_BESIDE_TORQUE
    return (told and steadiness > likelihood_threshold()) or (chance and steadiness > thresholds.STEADY_LIKELIHOOD)


def _replace_by_rival(selection: Selection, step: SelectionStep, without: Model) -> Selection | None:
    """Replace a step by a rival of its effect that is as likely, and determined; None if there is no such.

    Nor does one take its place whose size chance gave, where all is explained without either. Measured: a drag of
    0.0066 ± 0.0048 V·s²/rad² gave way to a limit that may be beyond every command, and that to the drag.
    """
    tests = try_effects(without, selection.hold_out, step.rivals, selection.workers, lambda test: None)
    for test in tests:
        if test.evidence <= likelihood_threshold():
            break
        alike = test.model.likelihood > selection.model.likelihood - thresholds.RIVAL_MARGIN
        told = not is_undetermined(test.effect, _find_unknown(test.model))
        if alike and told and not (without.complete and is_chance(test.effect, test.model)):
            others = sort_by_table({step.found.effect, *step.rivals} - {test.effect})
            return selection.replace_step(step, replace(step, found=test, rivals=others), test.model)
    return None


def find_undetermined(model: Model) -> tuple[str, ...]:
    """Find the effects of a model none of whose own parameters its training data determine.

    Size and time constant of one effect may each be unsure, because the other is, where both together are not. A
    parameter that belongs to a recording, such as an instant, says nothing of the motor; but one that may be anywhere
    is a slow torque's. A size that ended at a limit of the search is none, nor that of a ripple that is no load.
    """
    unknown, limits = (_find_unknown(model), find_limits_hit(model)) if model.effects else ((), ())
    return tuple(
        name
        for name in model.effects
        if is_undetermined(name, unknown)
        or EFFECT_BY_NAME[name].parameters[0].name in limits
        or is_no_ripple(model, name)
        or is_chance(name, model)
    )


def _find_unknown(model: Model) -> tuple[str, ...]:
    """Find the parameters that the training data do not determine, or that ended at a limit of the search alone."""
    return (*model.uncertainty.not_identifiable, *find_limits_hit(model))


def find_limits_hit(model: Model) -> tuple[str, ...]:
    """Find the parameters that ended at a limit of the search that is none of physics."""
    return tuple(name for name, hit in find_bounds_hit(model.estimate).items() if hit and not _is_physical(name))


def is_of_no_motor(model: Model) -> bool:
    """Decide whether a model's kv ended at a limit of the search: no motor moves like that by such voltages."""
    return "kv" in find_limits_hit(model)


def _is_physical(name: str) -> bool:
    """Whether a search ends where physics does, such as at a bridge that coasts all the time, and not far before."""
    spec = SPEC_BY_NAME.get(name)
    return spec is not None and spec.high > thresholds.NEAR_PHYSICS * spec.maximum


def is_undetermined(effect: str, not_identifiable: tuple[str, ...]) -> bool:
    """Decide whether an effect's one own parameter is not determined, or all of what takes its time in a recording."""
    own = [spec.name for spec in EFFECT_BY_NAME[effect].parameters if not spec.of_recording]
    return all(name in not_identifiable for name in own) and (len(own) == 1 or EFFECT_BY_NAME[effect].anywhere)
