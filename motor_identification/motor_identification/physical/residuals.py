"""Compute residuals of motion and current together, white: the measured current is one more output of the motor."""

from dataclasses import dataclass

import numpy as np

from motor_identification.estimation.problem import DERIVATIVE_STEP, Problem
from motor_identification.estimation.whitened_fit import Beside, WhitenedResiduals
from motor_identification.physical.current_samples import CurrentSamples
from motor_identification.physical.unknowns import ElectricalUnknowns
from motor_identification.recording import Floats
from motor_model.effects import INDEX
from motor_model.simulate import NOWHERE, roll_out_with_current

OFFSET = INDEX["current_offset"]


def simulate_currents(problem: Problem, currents: tuple[CurrentSamples, ...], thetas: Floats) -> Floats:
    """Simulate what the sensors of all recordings read [A] at θ (S, D), shape (S, K), one recording after the other.

    `problem` has electrical unknowns, see `unknowns.py`.
    """
    problem.raise_if_stopped()
    unknowns = problem.unknowns
    assert isinstance(unknowns, ElectricalUnknowns)
    lags = [unknowns.lag_of(theta) for theta in thetas]
    vectors, starts = problem.unknowns.decode(thetas)
    parts = []
    for r, (samples, (time, voltage)) in enumerate(zip(currents, problem.commands, strict=True)):
        angle, speed, current = (np.empty(len(samples.time) + 1) for _ in range(3))
        rows = np.empty((len(thetas), len(samples.time)))
        for s, row in enumerate(rows):
            out = np.append(0.0, np.maximum(samples.time - lags[s], 0.0))  # motion starts with the recording
            anchor = problem.tracks[r].at(out) if problem.tracks else NOWHERE
            p, start = vectors[s, r], float(starts[s, r])
            roll_out_with_current(p, start, time, voltage, out, anchor, angle, speed, current)
            row[:] = current[1:] + p[OFFSET]
        parts.append(rows)
    return np.concatenate(parts, axis=1)


@dataclass(frozen=True)
class ElectricalResiduals(WhitenedResiduals):
    """White residuals of the motion, then of every recording's current over the sensor's noise."""

    currents: tuple[CurrentSamples, ...]
    sigma: tuple[float, ...]  # [A] of every recording's sensor

    @property
    def beside(self) -> tuple[Beside, ...]:
        """The instants of the rows that are not of the motion."""
        return tuple(Beside(samples.time) for samples in self.currents)

    def residuals(self, theta: Floats) -> Floats:
        """White residuals at θ (D,)."""
        return np.concatenate([super().residuals(theta), self.current_errors(theta) / self._sigmas()])

    def jacobian(self, theta: Floats) -> Floats:
        """Their derivative over the unknowns, one column each."""
        steps = DERIVATIVE_STEP * (self.problem.unknowns.high - self.problem.unknowns.low)
        some = np.concatenate([theta + np.diag(steps), theta - np.diag(steps)])
        ahead, back = np.split(simulate_currents(self.problem, self.currents, some), 2)
        columns = (ahead - back) / (2.0 * steps[:, None]) / self._sigmas()
        return np.concatenate([super().jacobian(theta), np.where(np.isfinite(columns), columns, 0.0).T])

    def current_errors(self, theta: Floats) -> Floats:
        """Simulated less measured current [A] at θ (D,), shape (K,)."""
        measured = np.concatenate([samples.current for samples in self.currents])
        return np.asarray(simulate_currents(self.problem, self.currents, theta[None])[0] - measured)

    def _sigmas(self) -> Floats:
        return np.repeat(self.sigma, [len(samples.time) for samples in self.currents])
