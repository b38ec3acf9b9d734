"""Fit nuisance parameters: what belongs to a held-out recording, on blocks of it; the motor stays as it is.

That is the initial speed, phases, the time of a load step.
"""

from dataclasses import dataclass, replace

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import Box, Tolerance, minimise_squares
from motor_identification.estimation.parameter_space import Unknowns, map_theta
from motor_identification.estimation.problem import Problem
from motor_identification.measurement.measured_angle import Track
from motor_identification.periodic import periodic_fit
from motor_identification.recording import Bools, Floats
from motor_identification.validation.instants import list_instant_columns, try_instants
from motor_model.effects import EFFECT_BY_NAME

INSTANTS_TRIED = 24  # at which an instant is tried: one a second of the rich profile
NUISANCE_TOLERANCE = Tolerance(iterations=30)
NUISANCE_DIFFERENCE = 1e-5  # relative step of forward differences


@dataclass(frozen=True)
class NuisanceResiduals:
    """Speed residuals as a function of the nuisance parameters alone, on the intervals that are for them."""

    estimate: Estimate
    free: Bools  # (D,) which unknowns are nuisance parameters
    used: Bools  # (I,)

    def complete(self, part: Floats) -> Floats:
        """θ (D,) with these nuisance parameters."""
        theta = self.estimate.theta.copy()
        theta[self.free] = part
        return theta

    def residuals(self, part: Floats) -> Floats:
        """Weighted residuals of the intervals that are used."""
        problem = self.estimate.problem
        return np.asarray((np.sqrt(problem.weight) * problem.residuals(self.complete(part)))[self.used])

    def cost(self, theta: Floats) -> float:
        """The sum of their squares at θ (D,)."""
        return float(np.sum(self.residuals(theta[self.free]) ** 2))


def fit_nuisance_parameters(problem: Problem, fitted: Estimate, blocks: tuple[Bools, ...]) -> Estimate:
    """Apply a motor fitted elsewhere to the recordings of a problem without effects.

    blocks: which intervals of every recording its nuisance parameters may be fitted on.
    """
    unknowns, used = fitted.problem.unknowns, np.concatenate(blocks)
    here = problem.with_effects(periodic_fit.drop_periodic_effects(unknowns.effects), unknowns.splits_kv)
    estimate = _fit(Estimate(here, _map_motor(unknowns, fitted.theta, here.unknowns)), used)
    for effect in unknowns.effects:
        if EFFECT_BY_NAME[effect].periodic:
            estimate = _add_phases(estimate, effect, fitted, used)
    return estimate


def _map_motor(old: Unknowns, theta: Floats, new: Unknowns) -> Floats:
    """Map the motor's own parameters to the unknowns of other recordings; the rest to the middle of its box."""
    moved = 0.5 * (new.low + new.high)
    for i, name in enumerate(new.names):
        if not new.specs[i].of_recording:
            moved[i] = theta[old.names.index(name)]
    return moved


def _fit(estimate: Estimate, used: Bools) -> Estimate:
    """Fit what belongs to the recordings, on the intervals that are used."""
    unknowns = estimate.problem.unknowns
    free = np.ones(len(unknowns.low), dtype=bool)
    free[[i for i, spec in enumerate(unknowns.specs) if not spec.of_recording]] = False
    if not free.any():
        return estimate
    target = NuisanceResiduals(estimate, free, used)
    theta = estimate.theta
    for column, duration in list_instant_columns(estimate.problem, unknowns.effects):
        theta = try_instants(target.cost, theta, column, duration, INSTANTS_TRIED)[0]
    box = Box(unknowns.low[free], unknowns.high[free])
    minimum = minimise_squares(target.residuals, None, theta[free], box, NUISANCE_TOLERANCE, step=NUISANCE_DIFFERENCE)
    return replace(estimate, theta=target.complete(minimum.theta))


def _add_phases(bare: Estimate, effect: str, fitted: Estimate, used: Bools) -> Estimate:
    """Add a periodic effect with the phases that fit best on measured angles, or, if that is better, on its own.

    Not where it was fitted on measured ones: beside a random torque the simulated angle runs away from them, and in
    what the torque leaves that hardly shows.
    """
    names = [spec.name for spec in EFFECT_BY_NAME[effect].parameters if not spec.of_recording]
    motor = fitted.problem.unknowns.names
    values = {name: np.array(float(fitted.theta[motor.index(name)])) for name in names}
    without = bare.problem.unknowns
    larger = bare.problem.with_effects((*without.effects, effect))
    nothing = np.zeros(len(larger.unknowns.low), dtype=bool)
    choices: list[tuple[float, Estimate]] = []
    tracks: tuple[Track, ...] = ()
    for _ in range(periodic_fit.PERIODIC_ROUNDS):
        cycles = float(values.get("ripple_cycles", np.array(1.0)))
        start = periodic_fit.estimate_phases(bare, effect, cycles, tracks)
        theta = map_theta(without, bare.theta, larger.unknowns, {**values, **start.values})
        measured = replace(larger, tracks=start.tracks)
        simulated = () if fitted.problem.tracks else (replace(larger, tracks=()),)
        for trial in (measured, *simulated):
            end = _fit(Estimate(trial, theta), used)
            choices.append((NuisanceResiduals(end, nothing, used).cost(end.theta), end))
        best = min(choices, key=lambda row: row[0])[1]
        tracks = periodic_fit.measure_angles(best, best.problem.unknowns.effects)  # it bridges the gaps better
    return best
