"""Eliminate backward: take back selected effects that are not needed beside all that were selected later.

Backward elimination is the second half of a stepwise selection.
"""

from collections.abc import Sequence
from dataclasses import replace

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import (
    fit_again,
    fit_constant,
    judge_beside_torque,
    refine_beside_torque,
    refit_without,
)
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold
from motor_identification.diagnosis.effect_test import (
    are_alike,
    count_parameters,
    find_rivals,
    is_there_from_the_start,
    list_candidates,
    sort_by_table,
    try_effects,
)
from motor_identification.diagnosis.evidence.line_evidence import drop_chance_harmonics
from motor_identification.diagnosis.evidence.presliding_evidence import find_presliding
from motor_identification.diagnosis.evidence.replacement import choose_better, find_loss, is_better
from motor_identification.diagnosis.selection import Selection, SelectionStep, begin_beside_torque
from motor_identification.diagnosis.stand_ins import has_same_evidence, is_own_evidence
from motor_identification.noise.error_model import ErrorModel
from motor_identification.progress import ProgressReporter
from motor_identification.validation.hold_out import HoldOut
from motor_model.effects import EFFECT_BY_NAME


def eliminate_backward(selection: Selection, reporter: ProgressReporter) -> Selection:
    """Keep the findings that are needed beside all others, or what does better instead of them; and their rivals now.

    The last one too: fitted once more, the model may come to the same motion without it.
    """
    for step in selection.steps:
        if any(one is step for one in selection.steps):
            gap = selection.model.held.gap
            reporter.report(f"checking {step.found.effect}", 0.9, step.found.effect, gap)
            selection = _check_step(selection, step, reporter)
    return selection


def _check_step(
    selection: Selection, step: SelectionStep, reporter: ProgressReporter, compared: bool = True
) -> Selection:
    """Test one finding against the model without it, and against others instead of it.

    compared: with others where it was found, if nothing was found after it.
    """
    effect, current = step.found.effect, selection.model
    without = refit_without(current, effect, selection.hold_out)
    if without.learned is not None and without.likelihood > current.likelihood:  # by errors that it does not know
        current = _judge_by_errors_of(without.learned, current, selection.hold_out)
    if not CandidateTest(effect, without, current).is_likely(likelihood_threshold()):
        return selection.replace_step(step, None, without)
    building_up = find_presliding(without, current) if EFFECT_BY_NAME[effect].after_reversals else None
    if building_up is not None:
        return replace(selection.replace_step(step, None, without), building_up=building_up)
    constant = _find_constant(effect, without, current, selection.hold_out)
    if constant is not None:
        by = replace(step, found=constant, rivals=tuple(name for name in step.rivals if name != constant.effect))
        return _check_step(selection.replace_step(step, by, constant.model), by, reporter, compared=False)
    judged_alike = step.found.model.beside_torque == current.beside_torque
    lost = list_lost(step, current.effects)
    if compared and step is selection.steps[-1] and judged_alike and not lost:
        return selection
    return _try_in_place(selection, step, without, current, reporter)


def _find_constant(effect: str, without: Model, current: Model, hold_out: HoldOut) -> CandidateTest | None:
    """Find the constant effect that one of the current model is, as it began before the motion did; None if it is none.

    From the very motion: without a load, friction stands in for it, and a fit from there may end far away.
    """
    constant = EFFECT_BY_NAME[effect].constant
    if constant is None or constant in current.effects:
        return None
    test = CandidateTest(constant, without, fit_constant(current, effect, constant, hold_out))
    return test if is_better(test, effect, current) else None


def _try_in_place(
    selection: Selection, step: SelectionStep, without: Model, current: Model, reporter: ProgressReporter
) -> Selection:
    """Try others in the place of a finding: what is better replaces it, and what does as well is a rival."""
    effect = step.found.effect
    others = list_replacements(step, without.effects, current.effects)
    if not others:
        return selection.replace_step(step, replace(step, rivals=()), current)

    def heard(test: CandidateTest) -> None:
        reporter.report(f"{test.effect} in place of {effect}", 0.9, effect, current.held.gap)

    tried = try_effects(without, selection.hold_out, others, selection.workers, heard)
    tried = [test for test in drop_chance_harmonics(tried) if not is_there_from_the_start(test)]
    tried = [_start_where_found(test, step, current, selection.hold_out) for test in tried]
    settled = [_settle(test, current, selection.hold_out) for test in tried]
    tests = sorted(settled, key=lambda test: test.evidence, reverse=True)
    current = _catch_up(current, tests, selection.hold_out)
    better = choose_better(_drop_without_own_evidence(tests, effect, without, current), effect, current)
    if better is None:
        return selection.replace_step(step, replace(step, rivals=_list_rivals(tests, effect, current)), current)
    rivals = find_rivals(better, tests)
    if _is_as_likely_from_there(effect, better, selection):
        rivals = sort_by_table({*rivals, effect})
    return selection.replace_step(step, replace(step, found=better, rivals=rivals), better.model)


def _drop_without_own_evidence(
    tests: Sequence[CandidateTest], effect: str, without: Model, current: Model
) -> list[CandidateTest]:
    """Drop from tests in the place of an effect that holds the motor, and is seen to, those that are not seen so.

    What bends the motion in few moments may well be likelier, and is found beside the friction if it is there.
    """
    if not EFFECT_BY_NAME[effect].holds or not is_own_evidence(effect, without, current):
        return list(tests)
    return [test for test in tests if has_same_evidence(test.model, without, current)]


def add_rivals_beside_torque(selection: Selection, reporter: ProgressReporter) -> Selection:
    """Add to every finding the rivals that it has beside the random torque that is left.

    For what is chosen as if the rest was white: a slow torque makes the one likelier than the other by hundreds.
    """
    begun = begin_beside_torque(selection.model, selection.hold_out, selection.workers)
    steps = []
    for step in selection.steps:
        effect, current = step.found.effect, begun.model
        reporter.report(f"checking {effect}", 0.9, effect, current.held.gap)
        without = refit_without(current, effect, begun.hold_out)
        others = list_replacements(step, without.effects, current.effects)
        tests = try_effects(without, begun.hold_out, others, begun.workers, lambda test: None)
        tests = drop_chance_harmonics(tests)
        told = [test for test in tests if test.evidence > thresholds.TIE_LIKELIHOOD]  # what does nothing is no rival
        rivals = _list_rivals([_settle(test, current, begun.hold_out) for test in told], effect, current)
        steps.append(replace(step, rivals=sort_by_table({*step.rivals, *rivals})))
    return replace(selection, steps=tuple(steps))


def _list_rivals(tests: Sequence[CandidateTest], effect: str, current: Model) -> tuple[str, ...]:
    """List what does as well as an effect of the current model, with no more parameters."""
    alike = [
        test.effect
        for test in tests
        if find_loss(test, current) < thresholds.RIVAL_MARGIN or are_alike(test.model, current)
    ]
    return sort_by_table(name for name in alike if count_parameters(name) <= count_parameters(effect))


def _judge_by_errors_of(other: ErrorModel, model: Model, hold_out: HoldOut) -> Model:
    """Judge a model again from the errors of one without an effect, which describe its own at least as well."""
    again = judge_beside_torque(model, hold_out, other, thresholds.FINAL_EVALUATIONS)
    return again if again.likelihood > model.likelihood else model


def _start_where_found(test: CandidateTest, step: SelectionStep, current: Model, hold_out: HoldOut) -> CandidateTest:
    """Fit a rival of a step beside a random torque from where it did as well without one, too.

    The torque that a model leaves without both is most of what they explain: from there a fit may end far away.
    """
    alike = find_loss(test, current) < thresholds.RIVAL_MARGIN
    if not current.beside_torque or test.effect not in step.rivals or alike:
        return test
    effects = set(test.model.effects)
    found = (one.model for one in step.tests if one.effect == test.effect and set(one.model.effects) == effects)
    begin = next(found, None)
    if begin is None or begin.beside_torque:
        return test
    model = replace(test.model, learned=current.learned)
    return replace(test, model=refine_beside_torque(model, hold_out, begin.estimate))


def _settle(test: CandidateTest, current: Model, hold_out: HoldOut) -> CandidateTest:
    """Fit to the end what leads to much the same motion as the current model but seems less likely.

    A candidate's fit ends early: where the sensor is fine, one that is a hundred-thousandth short, and beside a torque
    one that is 2 % short, is less likely by a hundred.
    """
    model = test.model
    if model.held.gap > thresholds.GAP_CHANCE * current.held.gap or model.likelihood >= current.likelihood:
        return test
    again = fit_again(model, hold_out)
    return replace(test, model=again) if again.likelihood > model.likelihood else test


def _is_as_likely_from_there(effect: str, better: CandidateTest, selection: Selection) -> bool:
    """Decide whether an effect is a rival of what is better, fitted from where that leads: as good a chance."""
    if count_parameters(effect) > count_parameters(better.effect):
        return False
    bare = refit_without(better.model, better.effect, selection.hold_out)
    (test,) = try_effects(bare, selection.hold_out, [effect], selection.workers, lambda test: None)
    return are_alike(test.model, better.model)


def _catch_up(current: Model, tests: Sequence[CandidateTest], hold_out: HoldOut) -> Model:
    """Fit the current model to the end, too, where a test's leads to much the same motion and seems likelier."""
    near = thresholds.GAP_CHANCE * current.held.gap
    if not any(test.model.likelihood > current.likelihood and test.model.held.gap <= near for test in tests):
        return current
    again = fit_again(current, hold_out)
    return again if again.likelihood > current.likelihood else current


def list_replacements(step: SelectionStep, without: Sequence[str], current: Sequence[str]) -> list[str]:
    """List the effects to try instead of a step's: likely where it was found, and not in the current model already.

    First those that did as well there, then what was beside it and is not any more, then what explained more of what
    was found since. without: effects of the model that lacks the step's own.
    """
    likely = [test.effect for test in step.tests if test is not step.found and test.evidence > likelihood_threshold()]
    free = {name for name in list_candidates(without) if name not in current}
    lost = list_lost(step, current)
    names = [name for name in dict.fromkeys((*step.rivals, *lost, *likely)) if name in free]
    return names[: max(thresholds.ELIMINATION_RIVALS, len(free.intersection((*step.rivals, *lost))))]


def list_lost(step: SelectionStep, current: Sequence[str]) -> list[str]:
    """List the effects that a step was found beside and that are not among the current model's any more."""
    return [name for name in step.before.effects if name not in current]


def drop_step(selection: Selection, step: SelectionStep) -> Selection:
    """Take one finding back, and fit the model again without it."""
    without = refit_without(selection.model, step.found.effect, selection.hold_out)
    return selection.replace_step(step, None, without)
