"""Fit motion and current together by least squares of white residuals, from a fit of the motion."""

from dataclasses import dataclass, replace
from math import isnan, nan

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_residuals
from motor_identification.estimation.parameter_space import map_theta
from motor_identification.estimation.problem import Problem
from motor_identification.estimation.whitened_fit import WhitenedFit, learn_encoders
from motor_identification.physical.current_samples import CurrentSamples
from motor_identification.physical.residuals import ElectricalResiduals, simulate_currents
from motor_identification.physical.unknowns import ElectricalUnknowns, add_electrical_unknowns, join_theta
from motor_identification.recording import Floats
from motor_model.effects import EFFECTS
from motor_model.errors import RecordingError

TURNS = 4  # that fit, encoders and noise of the current are learned from each other
ITERATIONS = 30  # of each
LESS_BACK_EMF = 0.8  # of kv: a second torque constant, that shows how the current depends on it
WHOLE_SAMPLES = (-1, 0, 1, 2, 3, 4, 6, 8, 12)  # by which the current may be late (−1: read after the voltage acted)
FIRST_LAG = 0.3  # of a sample period beyond that, to begin with
LAG = "electrical_time_constant"
(INDUCTANCE,) = (effect for effect in EFFECTS if any(spec.name == LAG for spec in effect.parameters))
AGAINST = (
    "The measured current runs against the voltage (resistance {:.3g} Ω): exchange the sensor's leads, or give its "
    "scale a minus sign, and check that the current is this motor's."
)


@dataclass(frozen=True)
class JointFit(WhitenedFit):
    """A fit of motion and current."""

    residuals: ElectricalResiduals

    @property
    def electrical(self) -> ElectricalUnknowns:
        """The unknowns."""
        unknowns = self.problem.unknowns
        assert isinstance(unknowns, ElectricalUnknowns)
        return unknowns

    @property
    def motion(self) -> Estimate:
        """The same motor without anything electrical: of the motion alone."""
        bare = self.problem.with_effects(self.electrical.effects)
        theta = map_theta(self.electrical, self.theta, bare.unknowns, {})
        return Estimate(bare, theta, self.estimate.simulations)

    @property
    def sum_of_currents(self) -> float:
        """[A²] what the fit leaves of all currents."""
        return float(np.sum(self.residuals.current_errors(self.theta) ** 2))


def fit_with_current(fit: WhitenedFit, currents: tuple[CurrentSamples, ...]) -> JointFit:
    """Fit motion and current together, from a fit of the motion and a linear regression of the current.

    Raises:
        RecordingError: the current is not this motor's.
    """
    whole = WHOLE_SAMPLES if isnan(_known_lag(fit.problem)) else (0,)
    start = min((_regress(fit, currents, samples) for samples in whole), key=lambda one: one.squares)
    if not start.conductance > 0.0:
        raise RecordingError(AGAINST.format(1.0 / start.conductance if start.conductance else np.inf))
    return _fit_in_turns(Estimate(start.problem, start.theta, fit.estimate.simulations), fit, currents)


def add_inductance(fit: WhitenedFit) -> list[WhitenedFit]:
    """Add an inductance to a fit of the motion: one start for each of its local minima; not fitted."""
    problem = fit.problem.adding(INDUCTANCE.name)
    (spec,) = INDUCTANCE.parameters
    sizes = [share * spec.scale.of(problem.unknowns.extent) for share in spec.starts]
    thetas = [map_theta(fit.problem.unknowns, fit.theta, problem.unknowns, {LAG: np.array(size)}) for size in sizes]
    return [replace(fit, estimate=replace(fit.estimate, problem=problem, theta=theta)) for theta in thetas]


@dataclass(frozen=True)
class Regression:
    """A start for a fit of motion and current: a problem and θ, the sum of squares [A²] there, and 1/R [1/Ω]."""

    problem: Problem
    theta: Floats
    squares: float
    conductance: float


def _regress(fit: WhitenedFit, currents: tuple[CurrentSamples, ...], samples: int) -> Regression:
    """Regress the current on what u, ω and the sensor's zero make of it, read so many whole samples late or more."""
    kv, unknowns = fit.estimate.parameters.values["kv"], fit.problem.unknowns
    most = max(float(np.max(np.abs(one.current))) for one in currents)
    electrical = add_electrical_unknowns(unknowns, kv, most, _known_lag(fit.problem), samples)
    problem = replace(fit.problem, unknowns=electrical)
    lag = (samples + FIRST_LAG) * unknowns.extent.sample
    # Of the other bounds none is asked here: only what the current is proportional to.
    wide = replace(electrical, low=np.full(len(electrical.low), -np.inf), high=np.full(len(electrical.low), np.inf))
    trials = [np.array([1.0, constant, 0.0, lag]) for constant in (kv, LESS_BACK_EMF * kv)]
    thetas = np.array([join_theta(unknowns, fit.theta, wide, values) for values in trials])
    all_of_kv, less = simulate_currents(problem, currents, thetas)
    per_constant = (all_of_kv - less) / ((1.0 - LESS_BACK_EMF) * kv)
    counts = [len(one.time) for one in currents]
    zeros = np.repeat(np.eye(len(counts)), counts, axis=1)
    design = np.array([all_of_kv - kv * per_constant, per_constant, *zeros]).T
    measured = np.concatenate([one.current for one in currents])
    solution = np.linalg.lstsq(design, measured, rcond=None)[0]
    conductance, product, *offsets = solution
    values = np.array([1.0 / max(conductance, 1e-12), product / max(conductance, 1e-12), np.mean(offsets), lag])
    squares = float(np.sum((design @ solution - measured) ** 2))
    return Regression(problem, join_theta(unknowns, fit.theta, electrical, values), squares, float(conductance))


def _known_lag(problem: Problem) -> float:
    """[s] by which the currents of all recordings are older than their samples; NaN where that is not known."""
    lags = {recording.info.current_lag for recording in problem.recordings}
    return lags.pop() if len(lags) == 1 else nan


def _fit_in_turns(estimate: Estimate, fit: WhitenedFit, currents: tuple[CurrentSamples, ...]) -> JointFit:
    """Fit, learn encoders and the current's noise from what that leaves, and again."""
    encoders = fit.residuals.encoders
    for turn in range(TURNS):
        unit = ElectricalResiduals(estimate.problem, encoders, currents, (1.0,) * len(currents))
        residuals = replace(unit, sigma=_measure_noise(unit, estimate.theta))
        if turn == TURNS - 1:
            break
        estimate = fit_residuals(estimate, residuals, iterations=ITERATIONS)
        encoders = learn_encoders(estimate)
    return JointFit(fit_residuals(estimate, residuals, iterations=ITERATIONS), residuals)


def _measure_noise(residuals: ElectricalResiduals, theta: Floats) -> tuple[float, ...]:
    """[A] RMS of every recording's current errors."""
    ends = np.cumsum([len(samples.time) for samples in residuals.currents])
    parts = np.split(residuals.current_errors(theta), ends[:-1])
    return tuple(float(np.sqrt(np.mean(part**2))) + 1e-12 for part in parts)
