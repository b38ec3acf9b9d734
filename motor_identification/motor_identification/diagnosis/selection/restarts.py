"""Restart a selection where its first effect leads nowhere: from another first one, or from two together."""

from dataclasses import replace

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold
from motor_identification.diagnosis.effect_test import (
    choose_finding,
    comes_back,
    is_there_from_the_start,
    list_candidates,
    sort_by_table,
    try_effects,
)
from motor_identification.diagnosis.selection.forward_selection import select_forward
from motor_identification.diagnosis.selection.hidden_pairs import find_pair, list_partners
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep, begin_selection
from motor_identification.progress import ProgressReporter
from motor_identification.validation.instants import needs_instant
from motor_model.effects import EFFECT_BY_NAME, LAGS


def begin_from_kindred(selection: Selection) -> list[Selection]:
    """Begin selections with what is kindred to the first finding of one that leaves structure, where that is likely."""
    if not selection.steps or not selection.model.held.confirms:
        return []
    first = selection.steps[0]
    likely = _list_kindred(first)
    return [_begin_with(test, first, selection) for test in likely if not is_there_from_the_start(test)]


def _list_kindred(step: SelectionStep) -> list[CandidateTest]:
    """List the tests of what is kindred to a step's finding, where they are likely."""
    kindred = [one for one in step.tests if _are_kindred(one.effect, step.found.effect)]
    return [one for one in kindred if one.evidence > likelihood_threshold()]


def _are_kindred(one: str, other: str) -> bool:
    """Decide whether each of two effects does most of what the other does, and so hides it where it comes first.

    Both make the motion late, or hold the motor by themselves, or one is the other from some instant on.
    """
    rows = EFFECT_BY_NAME[one], EFFECT_BY_NAME[other]
    late, hold = {one, other} <= set(LAGS), all(row.holds and row.implies is None for row in rows)
    return one != other and (late or hold or rows[0].constant == other or rows[1].constant == one)


def _begin_with(
    test: CandidateTest, step: SelectionStep, selection: Selection, earlier: tuple[SelectionStep, ...] = ()
) -> Selection:
    """Begin a selection with another finding in the place of a step's, after earlier ones."""
    rivals = tuple(name for name in step.rivals if name != test.effect)
    begun = SelectionStep(step.before, test, step.tests, rivals, test.explains)
    return begin_selection(test.model.estimate, selection.hold_out, selection.workers, (*earlier, begun))


def retry_with_another_first(selection: Selection, reporter: ProgressReporter) -> Selection:
    """Select forward again from another first effect that was nearly as likely, where the gap stays above the floor.

    Or where a complete model took many findings: fewer may do as well; or leaves what a wrong static curve does, too.
    While others are missing too, one effect can do as well as another, and the wrong
    one ends in a local minimum of the selection, or with more than are there.
    """
    settled = selection.model.complete and not _may_lack_more(selection.model)
    if not selection.steps or (settled and len(selection.steps) < thresholds.MANY_STEPS):
        return selection
    first = selection.steps[0]
    for test in list_other_firsts(first):
        other = select_forward(_begin_with(test, first, selection), reporter, pairs=False)
        if selection.model.complete:
            better = _is_simpler(other, selection) or (not settled and _leaves_less(other, selection))
            selection = other if better else selection
            continue
        if _is_alike(other.model, selection.model):
            selection = _add_rival(selection, other)  # the one that was more likely at first stays
            continue
        if other.model.held.gap < selection.model.held.gap:
            selection = other if other.model.likelihood > selection.model.likelihood else _add_rival(other, selection)
        else:
            head, *tail = selection.steps
            rest = tuple(name for name in head.rivals if name != test.effect)
            selection = replace(selection, steps=(replace(head, rivals=rest), *tail))
    return selection


def retry_with_pair(selection: Selection, reporter: ProgressReporter) -> Selection:
    """Select forward again from two effects together, where what needs an instant came first and leaves a gap.

    An instant is found for whatever bends a motion; of steps one way a load step takes more than friction or drag alone
    does, neither of which is then a finding beside it. Where one is, and nothing is left, there is no need.
    """
    if not selection.steps or not selection.model.above_floor or not selection.model.held.confirms:
        return selection
    first, alone = selection.steps[0], len(selection.steps) == 1
    if not needs_instant(first.found.effect) or (selection.model.complete and not alone):
        return selection
    start = begin_selection(first.before.estimate, selection.hold_out, selection.workers)
    likely = [test.effect for test in list_partners([one for one in first.tests if not needs_instant(one.effect)])]
    # Tried once more: a selection that begins anew may read the directions of held-out motion otherwise.
    tests = try_effects(start.model, start.hold_out, likely, start.workers, lambda test: None)
    pair = find_pair(start, tests, reporter)
    if not pair:
        return selection
    other = select_forward(start.add(pair), reporter, pairs=False)
    better = other.model.likelihood > selection.model.likelihood and other.model.held.gap < selection.model.held.gap
    return other if better else selection


def retry_with_dependent(selection: Selection, reporter: ProgressReporter) -> Selection:
    """Select forward again from what is kindred to a finding where an effect that comes with that alone explains more.

    A static friction is tried beside a Coulomb friction only, which a dead zone that comes first leaves no room for.
    Measured: of a motor that breaks away at 1.68 V and slides at 0.72 a dead zone was likelier than a friction by 8,
    and beside it a drag that is not there was found; they left 0.45 rad/s, and the static friction leaves 0.32.
    """
    for i, step in enumerate(selection.steps):
        for test in _list_kindred(step):
            other = _select_with_dependent(test, i, selection, reporter)
            if other is not None:
                return other
    return selection


def _select_with_dependent(
    test: CandidateTest, number: int, selection: Selection, reporter: ProgressReporter
) -> Selection | None:
    """Select from another effect in the place of a step where what comes with it is a finding that is likelier."""
    model = test.model
    names = list_candidates(model.effects, model.held, model.beside_torque)
    dependent = [name for name in names if EFFECT_BY_NAME[name].implies == test.effect]
    if not dependent or test.effect in selection.model.effects or model.beside_torque:
        return None
    least = selection.model.likelihood + likelihood_threshold()
    begun = _begin_with(test, selection.steps[number], selection, selection.steps[:number])
    best = choose_finding(try_effects(begun.model, begun.hold_out, dependent, begun.workers, lambda one: None))
    if best is None or best.model.likelihood <= least:
        return None
    other = select_forward(begun, reporter, pairs=False)
    better = other.model.likelihood > least and other.model.held.gap < selection.model.held.gap
    return other if better else None


def _may_lack_more(model: Model) -> bool:
    """Decide whether what a complete model leaves may be of a wrong static curve.

    It is said to be a torque that the motor is at rest with nearly all the time, as what is left of a staircase whose
    levels the fit has seen; or a coarse sensor hides it from row to row.
    """
    slow = model.errors.correlation_time * model.lag.rate > thresholds.SLOW_TORQUE
    return slow if model.above_floor else model.lasts


def _leaves_less(other: Selection, selection: Selection) -> bool:
    """Decide whether another selection is likelier, and leaves so little that what chance leaves is no question."""
    likelier = other.model.likelihood > selection.model.likelihood
    left, least = (_find_seen_gap(one.model, selection.model.above_floor) for one in (other, selection))
    return likelier and left < thresholds.HALVED_GAP * least


def _find_seen_gap(model: Model, above_floor: bool) -> float:
    """Find the gap [rad/s] that is seen: of what lasts, where a coarse sensor hides it from row to row."""
    return model.held.gap if above_floor else model.lasting.gap


def _is_simpler(other: Selection, many: Selection) -> bool:
    """Decide whether fewer findings explain everything, and the motion is as likely; or as many, and it is likelier.

    Measured: of a coasting bridge with friction on five stairs a limit of the voltage, a drag and a step of the load,
    at the instant of the last stair, left no more than those two and a step where there was one.
    """
    gain = other.model.likelihood - many.model.likelihood
    fewer = len(other.steps) < len(many.steps)
    likelier = gain >= 0.0 if fewer else gain > likelihood_threshold()
    return other.model.complete and len(other.steps) <= len(many.steps) and likelier


def _is_alike(again: Model, first: Model) -> bool:
    """Decide whether a model is the first one's motion in other words: neither likelihood nor gap speaks against that.

    One that is likelier by less than what makes a rival is no better.
    """
    low, high = sorted((again.held.gap, first.held.gap))
    gain = again.likelihood - first.likelihood
    return -thresholds.TIE_LIKELIHOOD < gain < thresholds.RIVAL_MARGIN and high < thresholds.SAME_GAP * low


def _add_rival(selection: Selection, likelier: Selection) -> Selection:
    """Add the first finding of a likelier selection to the rivals of the first: gap and likelihood disagree."""
    head, *tail = selection.steps
    rivals = sort_by_table({*head.rivals, likelier.steps[0].found.effect} - {head.found.effect})
    return replace(selection, steps=(replace(head, rivals=rivals), *tail))


def list_other_firsts(first: SelectionStep) -> list[CandidateTest]:
    """List the tests, best first, that were nearly as likely as a first step.

    Not what begins at an instant but is there from the start, nor what does not come back over the angle: it is no
    finding, whatever comes beside it. Measured: from an eccentricity of a disc that turned by 0.56.
    """
    likely = max(thresholds.SECOND_START_EVIDENCE * first.found.evidence, likelihood_threshold())
    others = [test for test in first.tests if test is not first.found and test.evidence > likely]
    others = [test for test in others if comes_back(test) and not is_there_from_the_start(test)]
    return others[: thresholds.SECOND_STARTS]
