"""Fit what is tried in the place of a finding to the end: from where it has as good a chance as the finding had."""

from collections.abc import Sequence
from dataclasses import replace

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import fit_again, fit_in_place, refine_beside_torque
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.evidence.likeness import both_hold
from motor_identification.diagnosis.evidence.replacement import find_loss
from motor_identification.diagnosis.selection.selection import SelectionStep
from motor_identification.validation.hold_out import HoldOut


def start_where_found(test: CandidateTest, step: SelectionStep, current: Model, hold_out: HoldOut) -> CandidateTest:
    """Fit a rival of a step beside a random torque from where it did as well without one, too.

    The torque that a model leaves without both is most of what they explain: from there a fit may end far away.
    """
    alike = find_loss(test, current, step.found.effect) < thresholds.RIVAL_MARGIN
    if not current.beside_torque or test.effect not in step.rivals or alike:
        return test
    effects = set(test.model.effects)
    found = (one.model for one in step.tests if one.effect == test.effect and set(one.model.effects) == effects)
    begin = next(found, None)
    if begin is None or begin.beside_torque:
        return test
    model = replace(test.model, learned=current.learned)
    return replace(test, model=refine_beside_torque(model, hold_out, begin.estimate))


def start_from_same_size(test: CandidateTest, effect: str, current: Model, hold_out: HoldOut) -> CandidateTest:
    """Fit what holds the motor, in the place of another effect that does, from that one's size and motion, too.

    The model without both may be far from either: beside a random torque, or where a ripple follows what they do.
    """
    if not both_hold(test.effect, effect) or find_loss(test, current, effect) < thresholds.RIVAL_MARGIN:
        return test
    again = fit_in_place(current, effect, test.effect, hold_out)
    return replace(test, model=again) if again.likelihood > test.model.likelihood else test


def settle(test: CandidateTest, current: Model, hold_out: HoldOut) -> CandidateTest:
    """Fit to the end what leads to much the same motion as the current model but seems less likely.

    A candidate's fit ends early: where the sensor is fine, one that is a hundred-thousandth short, and beside a torque
    one that is 2 % short, is less likely by a hundred.
    """
    model = test.model
    if model.held.gap > thresholds.GAP_CHANCE * current.held.gap or model.likelihood >= current.likelihood:
        return test
    again = fit_again(model, hold_out)
    return replace(test, model=again) if again.likelihood > model.likelihood else test


def catch_up(current: Model, tests: Sequence[CandidateTest], hold_out: HoldOut) -> Model:
    """Fit the current model to the end, too, where a test's leads to much the same motion and seems likelier."""
    near = thresholds.GAP_CHANCE * current.held.gap
    if not any(test.model.likelihood > current.likelihood and test.model.held.gap <= near for test in tests):
        return current
    again = fit_again(current, hold_out)
    return again if again.likelihood > current.likelihood else current
