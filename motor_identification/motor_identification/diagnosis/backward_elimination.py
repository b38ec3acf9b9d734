"""Eliminate backward: take back selected effects that are not needed beside all that were selected later.

Backward elimination is the second half of a stepwise selection.
"""

from collections.abc import Sequence
from dataclasses import replace

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model, fit_again, judge_beside_torque, refit_without
from motor_identification.diagnosis.candidate_test import CandidateTest, share_explained
from motor_identification.diagnosis.effect_test import (
    EFFECT_ORDER,
    count_parameters,
    find_rivals,
    likelihood_threshold,
    list_candidates,
    sort_by_table,
    try_effects,
)
from motor_identification.diagnosis.selection import Selection, SelectionStep
from motor_identification.diagnosis.standstill_evidence import explains_standstills
from motor_identification.discrepancy.free_curves import PAST, REPEATING
from motor_identification.noise.error_model import ErrorModel
from motor_identification.progress import ProgressReporter
from motor_identification.validation.hold_out import HoldOut
from motor_model.effects import EFFECT_BY_NAME


def drop_stand_ins(selection: Selection) -> Selection:
    """Drop what may only stand in for an effect that is not in the table, where the gap stays above the floor.

    That is every finding that leaves a visible part of what it should explain, and what was found after it; a line in
    the spectrum over the angle is its own evidence, and so is a standstill under a voltage. Where what is left comes
    and goes whatever the motor does, no finding that answers its motion stands in for that; and no friction for what
    goes with the past, such as a sensor's filter.
    """
    if selection.model.complete:
        return selection
    apart = leaves_mostly(selection.model, REPEATING)
    past = leaves_mostly(selection.model, (PAST, *REPEATING), thresholds.MINOR_SHARE)
    for i, step in enumerate(selection.steps):
        effect = EFFECT_BY_NAME[step.found.effect]
        answers = (apart and not effect.anywhere) or (past and effect.holds)
        stays = step.explains > (thresholds.APART_SHARE if answers else thresholds.STAND_IN_SHARE)
        if not stays and not _is_own_evidence(selection, i):
            return replace(selection, steps=selection.steps[:i], model=step.before)
    return selection


def leaves_mostly(model: Model, variables: Sequence[str], minor: float = 0.0) -> bool:
    """Decide whether what can be predicted of what is left goes with some variables, but for a minor share of that."""
    certain = [one for one in model.structure if one.certain]
    own = [one.share for one in certain if one.variable in variables]
    others = [one.share for one in certain if one.variable not in variables]
    return bool(own) and max(others, default=0.0) <= minor * max(own)


def _is_own_evidence(selection: Selection, number: int) -> bool:
    """Decide whether a step's effect is told by what nothing outside the table does."""
    step = selection.steps[number]
    effect = EFFECT_BY_NAME[step.found.effect]
    if not effect.holds:
        return effect.periodic
    after = selection.steps[number + 1].before if number + 1 < len(selection.steps) else selection.model
    return explains_standstills(step.before, after)


def drop_stand_ins_of_either(first: Selection, second: Selection) -> Selection:
    """Drop what may only stand in for something from two selections, and choose the one that keeps more findings.

    Of equals the one with the smaller gap.
    """
    if second.model.complete or first is second:
        return drop_stand_ins(second)
    return max(drop_stand_ins(first), drop_stand_ins(second), key=lambda one: (len(one.steps), -one.model.held.gap))


def keep_confirmed(selection: Selection, effects: Sequence[str]) -> Selection:
    """Keep the findings up to the first that another selection does not have; effects: of that one's model."""
    for i, step in enumerate(selection.steps):
        if step.found.effect not in effects:
            return replace(selection, steps=selection.steps[:i], model=step.before)
    return selection


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


def stands_in_for_curve(without: Model, current: Model) -> bool:
    """Decide whether a free curve over the past predicts about as much beside a random torque as a finding does.

    without: the model that lacks the finding.
    """
    if not current.beside_torque:
        return False
    curve = max((one.share for one in without.structure if one.certain and one.variable == PAST), default=0.0)
    found = share_explained(without.held.gap, current.held.gap, current.sensor_floor)
    return found < thresholds.CURVE_MARGIN * curve


def _check_step(selection: Selection, step: SelectionStep, reporter: ProgressReporter) -> Selection:
    """Test one finding against the model without it, and against others instead of it."""
    effect, current = step.found.effect, selection.model
    without = refit_without(selection.model, effect, selection.hold_out)
    if without.learned is not None and without.likelihood > current.likelihood:  # by errors that it does not know
        current = _judge_by_errors_of(without.learned, current, selection.hold_out)
    if not CandidateTest(effect, without, current).is_likely(likelihood_threshold()):
        return replace_step(selection, step, None, without)
    if EFFECT_BY_NAME[effect].after_reversals and stands_in_for_curve(without, current):
        return replace_step(selection, step, None, without)
    judged_alike = step.found.model.beside_torque == current.beside_torque
    if step is selection.steps[-1] and judged_alike:  # what could be in its place was tried beside it
        return selection
    others = list_replacements(step, without.effects, current.effects)
    if not others:
        return replace_step(selection, step, replace(step, rivals=()), current)

    def heard(test: CandidateTest) -> None:
        reporter.report(f"{test.effect} in place of {effect}", 0.9, effect, current.held.gap)

    tried = try_effects(without, selection.hold_out, others, selection.workers, heard)
    tests = sorted(
        (_settle(test, current, selection.hold_out) for test in tried), key=lambda test: test.evidence, reverse=True
    )
    better = choose_better(tests, effect, current)
    if better is not None:
        replaced = replace(step, found=better, rivals=find_rivals(better, tests))
        return replace_step(selection, step, replaced, better.model)
    alike = [test.effect for test in tests if find_loss(test, effect, current) < thresholds.RIVAL_MARGIN]
    rivals = sort_by_table(name for name in alike if count_parameters(name) <= count_parameters(effect))
    return replace_step(selection, step, replace(step, rivals=rivals), current)


def _judge_by_errors_of(other: ErrorModel, model: Model, hold_out: HoldOut) -> Model:
    """Judge a model again from the errors of one without an effect, which describe its own at least as well."""
    again = judge_beside_torque(model, hold_out, other, thresholds.FINAL_EVALUATIONS)
    return again if again.likelihood > model.likelihood else model


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


def list_replacements(step: SelectionStep, without: Sequence[str], current: Sequence[str]) -> list[str]:
    """List the effects to try instead of a step's: likely where it was found, and not in the current model already.

    without: effects of the model that lacks the step's own.
    """
    likely = [test.effect for test in step.tests if test is not step.found and test.evidence > likelihood_threshold()]
    free = [name for name in list_candidates(without) if name not in current]
    return [name for name in likely if name in free][: thresholds.ELIMINATION_RIVALS]


def choose_better(tests: Sequence[CandidateTest], effect: str, current: Model) -> CandidateTest | None:
    """Choose among tests, best first, what does better than an effect of the current model; of equals the most common.

    None if nothing does.
    """
    best = next((test for test in tests if is_better(test, effect, current)), None)
    if best is None:
        return None
    least, most = best.evidence - thresholds.TIE_LIKELIHOOD, count_parameters(best.effect)
    equals = [test for test in tests if test.evidence > least and count_parameters(test.effect) <= most]
    return min(equals, key=lambda test: EFFECT_ORDER[test.effect])


def is_better(test: CandidateTest, effect: str, current: Model) -> bool:
    """Decide whether a test's model is better: more likely by the margin, or nearly as likely with fewer parameters.

    Beside a random torque the simpler one may be less likely in a few moments.
    """
    if count_parameters(test.effect) >= count_parameters(effect):
        return current.likelihood - test.model.likelihood < -thresholds.RIVAL_MARGIN
    return find_loss(test, effect, current) < thresholds.RIVAL_MARGIN


def find_loss(test: CandidateTest, effect: str, current: Model) -> float:
    """Find what a test's model loses of log likelihood beside the current one, which has an effect instead.

    Beside a random torque not counting the few moments that speak most against it, unless it predicts far worse: a
    slow torque does in one moment what a load step does.
    """
    loss = current.likelihood - test.model.likelihood
    if test.model.held.gap > thresholds.WORSE_GAP * current.held.gap:
        return loss
    return min(loss, CandidateTest(effect, test.model, current).steadiness) if current.beside_torque else loss


def drop_step(selection: Selection, step: SelectionStep) -> Selection:
    """Take one finding back, and fit the model again without it."""
    without = refit_without(selection.model, step.found.effect, selection.hold_out)
    return replace_step(selection, step, None, without)


def replace_step(selection: Selection, step: SelectionStep, by: SelectionStep | None, model: Model) -> Selection:
    """Put another step, or none, instead of one; steps that the model does not have go too."""
    steps = [by if one is step else one for one in selection.steps]
    kept = tuple(one for one in steps if one and one.found.effect in model.effects)
    return replace(selection, steps=kept, model=model)
