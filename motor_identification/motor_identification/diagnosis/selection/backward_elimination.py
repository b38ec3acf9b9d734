"""Eliminate backward: take back selected effects that are not needed beside all that were selected later.

Backward elimination is the second half of a stepwise selection.
"""

from collections.abc import Sequence
from dataclasses import replace

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import (
    fit_in_place,
    judge_beside_torque,
    refit_without,
)
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold
from motor_identification.diagnosis.evidence.angle_evidence import find_angle_friction
from motor_identification.diagnosis.evidence.drooping_evidence import find_droop
from motor_identification.diagnosis.evidence.line_evidence import is_of_sensor
from motor_identification.diagnosis.evidence.presliding_evidence import find_presliding
from motor_identification.diagnosis.evidence.replacement import is_better
from motor_identification.diagnosis.evidence.slewing_evidence import find_slewing
from motor_identification.diagnosis.selection.rivals import list_lost, try_in_place
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep
from motor_identification.discrepancy.structure import Structure
from motor_identification.noise.error_model import ErrorModel
from motor_identification.progress import ProgressReporter
from motor_identification.validation.hold_out import HoldOut
from motor_model.effects import EFFECT_BY_NAME


def eliminate_backward(selection: Selection, reporter: ProgressReporter) -> Selection:
    """Keep the findings that are needed beside all others, or what does better instead of them; and their rivals now.

    The last one too: fitted once more, the model may come to the same motion without it. What was checked beside one
    that went is checked once more without it, and may have rivals now; unless that stood in for what is outside the
    table, which is there still.
    """
    given, beside_more = selection.steps, tuple[SelectionStep, ...]()
    for number, step in enumerate(given):
        if _is_among(step, selection.steps):
            before = selection
            selection = _report_and_check(before, step, reporter, compared=True)
            if len(selection.steps) < len(before.steps) and selection.outside is None:
                beside_more = tuple(one for one in selection.steps if not _is_among(one, given[number + 1 :]))
    for step in beside_more:
        if _is_among(step, selection.steps):
            selection = _report_and_check(selection, step, reporter, compared=False)
    return selection


def _is_among(step: SelectionStep, steps: Sequence[SelectionStep]) -> bool:
    return any(one is step for one in steps)


def _report_and_check(
    selection: Selection, step: SelectionStep, reporter: ProgressReporter, compared: bool
) -> Selection:
    reporter.report(f"checking {step.found.effect}", 0.9, step.found.effect, selection.model.held.gap)
    return _check_step(selection, step, reporter, compared)


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
    test = CandidateTest(effect, without, current)
    if not test.is_likely(likelihood_threshold()) or is_of_sensor(test):
        return selection.replace_step(step, None, without)
    outside = _find_outside([effect], without, current)
    if outside is not None:
        return replace(selection.replace_step(step, None, without), outside=outside)
    constant = _find_constant(effect, without, current, selection.hold_out)
    if constant is not None:
        by = replace(step, found=constant, rivals=tuple(name for name in step.rivals if name != constant.effect))
        return _check_step(selection.replace_step(step, by, constant.model), by, reporter, compared=False)
    judged_alike = step.found.model.beside_torque == current.beside_torque
    lost = list_lost(step, current.effects)
    if compared and step is selection.steps[-1] and judged_alike and not lost:
        return selection
    better = try_in_place(selection, step, without, current, reporter)
    put = [name for name in better.model.effects if name not in current.effects]
    outside = _find_outside(put, without, better.model)
    return better if outside is None else replace(selection.replace_step(step, None, without), outside=outside)


def _find_outside(effects: Sequence[str], without: Model, current: Model) -> Structure | None:
    """Find what is outside the table and explains what one of some effects of the current model stands in for."""
    for effect in effects:
        presliding = find_presliding(without, current) if EFFECT_BY_NAME[effect].after_reversals else None
        found = presliding or find_slewing(effect, without, current) or find_angle_friction(effect, without, current)
        found = found or find_droop(effect, without, current)
        if found is not None:
            return found
    return None


def _find_constant(effect: str, without: Model, current: Model, hold_out: HoldOut) -> CandidateTest | None:
    """Find the constant effect that one of the current model is, as it began before the motion did; None if it is none.

    From the very motion: without a load, friction stands in for it, and a fit from there may end far away.
    """
    constant = EFFECT_BY_NAME[effect].constant
    if constant is None or constant in current.effects:
        return None
    test = CandidateTest(constant, without, fit_in_place(current, effect, constant, hold_out))
    return test if is_better(test, effect, current) else None


def _judge_by_errors_of(other: ErrorModel, model: Model, hold_out: HoldOut) -> Model:
    """Judge a model again from the errors of one without an effect, which describe its own at least as well."""
    again = judge_beside_torque(model, hold_out, other, thresholds.FINAL_EVALUATIONS)
    return again if again.likelihood > model.likelihood else model


def drop_step(selection: Selection, step: SelectionStep) -> Selection:
    """Take one finding back, and fit the model again without it."""
    without = refit_without(selection.model, step.found.effect, selection.hold_out)
    return selection.replace_step(step, None, without)
