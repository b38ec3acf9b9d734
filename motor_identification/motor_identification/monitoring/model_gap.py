"""Measure how well a model predicts a motor's motion just now: its RMS residual, and which parameters have changed."""

from dataclasses import dataclass
from math import isfinite, nan, sqrt

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.whitened_fit import fit_whitened
from motor_identification.monitoring.live_motor import Still
from motor_identification.recording import Floats, Recording
from motor_identification.reporting.model_comparison import DIFFERENT, Identified, deviations_of
from motor_identification.timing.speed_filter import SpeedFilter
from motor_identification.timing.timing import list_readings
from motor_identification.uncertainty.standard_errors import estimate_uncertainty
from motor_identification.validation.nuisance_fit import fit_nuisance_parameters
from motor_model.effects import SPEC_BY_NAME, VISCOUS_SHARE
from motor_model.parameters import Parameters
from motor_model.simulate import NOWHERE, roll_out


@dataclass(frozen=True)
class Model:
    """An identified motor, and how far it was from the motion that it was fitted to."""

    identified: Identified
    residual_rms: float = nan  # [rad/s] NaN: not known
    speed_filter: SpeedFilter | None = None  # that the speeds had passed which it was fitted to

    @property
    def parameters(self) -> Parameters:
        """The motor in numbers."""
        return self.identified.parameters


@dataclass(frozen=True)
class Gap:
    """A model beside a window of motion; speeds are time-weighted RMS [rad/s]."""

    rms: float  # of simulated − measured mean speed
    expected: float  # of the same, while the motor is as it was: at the identification, or what the sensor leaves
    measured: float  # speed
    predicted: float  # speed
    duration: float  # [s]
    estimate: Estimate | None = None  # to fit from; None of a motor that stands


@dataclass(frozen=True)
class Change:
    """A parameter that is no longer what it was, by more than the standard errors allow."""

    name: str
    value: float
    error: float
    was: float


def measure_gap(motion: Recording | Still, model: Model) -> Gap:
    """Simulate the model under the recorded voltage and compare it with the motion.

    What belongs to the window alone (initial speed, phases, time of a load step) is fitted to it; the motor is not.

    Raises:
        RecordingError: the window says nothing about the motion.
    """
    if isinstance(motion, Still):
        return _measure_still(motion, model)
    return min(
        (_measure_moving(reading, model) for reading in list_readings(motion, model.speed_filter)),
        key=lambda gap: gap.rms,
    )


def _measure_moving(motion: Recording, model: Model) -> Gap:
    problem = make_problem([motion], ())
    split = model.parameters.viscous_share > 0.0
    larger = problem.with_effects(model.parameters.effects, split)
    known = _place(Estimate(larger, np.empty(0)), model.parameters)
    estimate = fit_nuisance_parameters(problem, known, (np.ones(len(problem.weight), dtype=bool),))
    residuals = estimate.problem.residuals(estimate.theta)
    weight, speed = problem.weight, problem.speed
    floor = sqrt(float(weight @ np.concatenate([data.floor_squared(0.0) for data in problem.intervals])))
    return Gap(
        rms=sqrt(float(weight @ residuals**2)),
        expected=max(floor, model.residual_rms) if isfinite(model.residual_rms) else floor,
        measured=sqrt(float(weight @ speed**2)),
        predicted=sqrt(float(weight @ (speed + residuals) ** 2)),
        duration=motion.duration,
        estimate=estimate,
    )


def find_changes(gap: Gap, model: Model) -> tuple[Change, ...]:
    """Fit the model's parameters to the window, from where they are, and list those that have changed."""
    if gap.estimate is None:
        return ()
    unknowns = gap.estimate.problem.unknowns
    inside = np.clip(gap.estimate.theta, unknowns.low, unknowns.high)
    fit = fit_whitened(fit_speeds(Estimate(gap.estimate.problem, inside)))
    errors = unknowns.value_errors(fit.theta, estimate_uncertainty(fit, fit.residuals.jacobian(fit.theta)).errors)
    now = Identified("now", fit.estimate.parameters, errors)
    return tuple(
        Change(name, now.parameters.value(name), errors[name], model.parameters.value(name))
        for name, spec in zip(unknowns.names, unknowns.specs, strict=True)
        if not spec.of_recording and name in SPEC_BY_NAME and _differs(model.identified, now, name)
    )


def _differs(before: Identified, now: Identified, name: str) -> bool:
    """Whether a parameter differs by more than the errors; a value whose error is not known is taken as exact."""
    known = before.errors.get(name, nan)
    was = Identified(before.name, before.parameters, {name: known if isfinite(known) else 0.0})
    return deviations_of(was, now, name) > DIFFERENT


def _place(estimate: Estimate, parameters: Parameters) -> Estimate:
    """Put a motor's parameters in their places in θ; what belongs to a recording stays in the middle of its box."""
    unknowns = estimate.problem.unknowns
    theta = 0.5 * (unknowns.low + unknowns.high)
    for i, spec in enumerate(unknowns.specs):
        value = parameters.viscous_share if spec is VISCOUS_SHARE else parameters.value(spec.name)
        theta[i] = np.log(max(value, np.exp(unknowns.low[i]))) if spec.logarithmic else value
    return Estimate(estimate.problem, theta)


def _measure_still(still: Still, model: Model) -> Gap:
    """A motor that stands, beside what its model does from rest."""
    time: Floats = still.time
    angle, speed = np.empty(len(time)), np.empty(len(time))
    roll_out(model.parameters.vector(), 0.0, time, still.voltage, time, NOWHERE, angle, speed)
    predicted = float(np.sqrt(np.mean(speed**2)))
    known = model.residual_rms if isfinite(model.residual_rms) else 0.0
    return Gap(predicted, known, 0.0, predicted, float(time[-1]))
