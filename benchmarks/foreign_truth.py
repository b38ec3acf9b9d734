"""How much likelier what is hidden in a log is than what a diagnosis named: what nobody could have told is no miss.

Both are fitted to the same intervals of the same log, what is hidden from its true values, and judged as the diagnosis
judges: by held-out motion beside the random torque that each leaves, or less a price for every parameter where the fits
have seen all that they are judged by.
"""

from collections.abc import Mapping, Sequence
from math import log, nan

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import fit_again, judge_beside_torque, validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.effect_test import refine_repeatedly
from motor_identification.diagnosis.result import Diagnosis
from motor_identification.diagnosis.start import begin
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.request import Request
from motor_identification.periodic.periodic_fit import (
    LOAD_OVER_ANGLE,
    add_load_once_a_turn,
    add_periodic_effects,
    drop_periodic_effects,
)
from motor_identification.recording import Recording
from motor_identification.sensor.description import note_sensors
from motor_identification.validation.hold_out import HoldOut
from motor_model.effects import EFFECT_BY_NAME, normalised

ROUNDS = 4  # in which each is fitted beside the torque that it leaves


def measure_lead(
    runs: Sequence[Recording], values: Mapping[str, float], hidden: Sequence[str], found: Diagnosis
) -> float:
    """Measure by how much (of log likelihood) the hidden effects are likelier than those that a diagnosis named.

    NaN where one of them is not in the table. values: what is true of the motor, by parameters' names.
    """
    if any(name not in EFFECT_BY_NAME for name in hidden):
        return nan
    runs = note_sensors(runs)
    if found.model.timing is not None:
        runs = found.model.timing.set_on(runs)
    start = begin(runs, (), Request(), lambda: False).selection
    named = tuple(one.effect for one in found.findings if EFFECT_BY_NAME[one.effect].fitted)
    true = _fit(start.model, start.hold_out, normalised(tuple(hidden)), values)
    return true - _fit(start.model, start.hold_out, normalised(named), found.model.parameters.values)


def _fit(bare: Model, hold_out: HoldOut, effects: Sequence[str], values: Mapping[str, float]) -> float:
    """Fit a motor with these effects from these values, beside a random torque, and return its log likelihood."""
    problem = bare.estimate.problem.with_effects(drop_periodic_effects(tuple(effects)))
    unknowns, known = problem.unknowns, bare.estimate.problem.unknowns
    theta = 0.5 * (unknowns.low + unknowns.high)
    for i, spec in enumerate(unknowns.specs):
        name = unknowns.names[i]
        if name in values and not spec.of_recording:
            theta[i] = log(values[name]) if spec.logarithmic else values[name]
        elif name in known.names:
            theta[i] = bare.estimate.theta[known.names.index(name)]
    estimate = Estimate(problem, np.clip(theta, unknowns.low, unknowns.high), 0)
    model = fit_again(validate_model(hold_out, estimate), hold_out)
    if len(drop_periodic_effects(tuple(effects))) < len(effects):
        lines = [add_periodic_effects(model.estimate, tuple(effects))]
        if LOAD_OVER_ANGLE in effects and values.get("ripple_cycles", 1.0) == 1.0:
            lines.append(add_load_once_a_turn(model.estimate))
        model = max((validate_model(hold_out, line) for line in lines), key=lambda one: one.likelihood)
    model = judge_beside_torque(model, hold_out, None, thresholds.FINAL_EVALUATIONS)
    return refine_repeatedly(model, hold_out, ROUNDS).likelihood
