"""Doubt whose the size of a finding is: most of it may be another effect's, beside which it is smaller."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import fit_again, validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import likelihood_threshold
from motor_identification.diagnosis.effect_test import sort_by_table
from motor_identification.diagnosis.evidence.likeness import both_hold
from motor_identification.diagnosis.fits.starts import start_with
from motor_identification.diagnosis.selection.selection import Selection, SelectionStep
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.parameter_space import set_values
from motor_identification.validation.hold_out import HoldOut
from motor_model.effect import ParameterSpec
from motor_model.effects import EFFECT_BY_NAME


def doubt_shared_sizes(selection: Selection) -> Selection:
    """Add to each finding the effects that, as far as the recordings tell, may have half of its size beside it.

    A friction alone may be likelier than a dead zone alone, and both together as likely. Measured: of 0.6 V each a
    friction of 1.204 ± 0.004 V was named, likelier than a dead zone of as much by 12.
    """
    steps = [_doubt_size(step, selection) for step in selection.steps]
    return replace(selection, steps=tuple(steps))


def _doubt_size(step: SelectionStep, selection: Selection) -> SelectionStep:
    model, effect = selection.model, step.found.effect
    alike = list_sharing(step, model.effects)
    tried = {name: fit_beside(model, effect, name, selection.hold_out) for name in alike}
    sharing = [name for name, both in tried.items() if may_have_half(both, effect, name)]
    return replace(step, rivals=sort_by_table({*step.rivals, *sharing})) if sharing else step


def list_sharing(step: SelectionStep, current: Sequence[str]) -> list[str]:
    """List the effects that hold the motor as a finding does, and did most of what that does where it was found.

    Not those that are its rivals, or in the current model, already.
    """
    effect, least = step.found.effect, (1.0 - thresholds.HOLDING_LEAD) * step.found.evidence
    likely = [test.effect for test in step.tests if test.evidence > max(least, likelihood_threshold())]
    known = {effect, *step.rivals, *current}
    return [name for name in likely if effect in current and name not in known and _hold_alike(name, effect)]


def _hold_alike(one: str, other: str) -> bool:
    return both_hold(one, other) and EFFECT_BY_NAME[one].linear_onset and EFFECT_BY_NAME[other].linear_onset


def fit_beside(model: Model, effect: str, other: str, hold_out: HoldOut) -> Model:
    """Fit a model with another effect beside one that it has, each of half its size to begin with."""
    estimate, size = model.estimate, _size_of(effect).name
    larger, half = estimate.problem.adding(other), 0.5 * estimate.parameters.value(size)
    theta = start_with(estimate, larger, {_size_of(other).name: half})
    theta = set_values(larger.unknowns, theta, {size: np.array(half)})
    return fit_again(validate_model(hold_out, Estimate(larger, theta, estimate.simulations), model), hold_out)


def may_have_half(model: Model, effect: str, other: str) -> bool:
    """Decide whether half of what an effect and another one do is the other's, within its standard error.

    Of one that is not determined beside the effect, it may be. By what knows of the random torque, where there is one:
    encoders alone tell a size a tenth as well there. Measured: of 0.5 V of friction beside a torque of 0.15 V half was
    doubted in three of seven logs.
    """
    fit, uncertainty = model.told_beside_torque or (model.whitened, model.uncertainty)
    one, two = (fit.problem.unknowns.names.index(_size_of(name).name) for name in (effect, other))
    most = fit.theta[two] + thresholds.SURE_SIZE * uncertainty.errors[two]
    return not most < 0.5 * (fit.theta[one] + fit.theta[two])  # an error that is no number is none


def _size_of(effect: str) -> ParameterSpec:
    return EFFECT_BY_NAME[effect].parameters[0]
