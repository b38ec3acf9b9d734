"""Fit a motor beside what shapes most motions, to learn how its speeds were made."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf, isfinite, log

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import SpeedResiduals, fit_speeds
from motor_identification.estimation.parameter_space import map_theta
from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.recording import Floats, Recording
from motor_identification.timing.row_times import AS_STAMPED, RowTimes
from motor_identification.timing.telling_blocks import Span, choose_blocks
from motor_identification.timing.timing import Timing
from motor_model.effects import SHAPING, SHAPING_BOTH_WAYS, normalised, specs_of

ITERATIONS, TOLERANCE = 30, 1e-7
BOTH_WAYS = 0.2  # of the largest voltage: what drives a motor both ways
BEGIN = 0.25  # rows: the dead time that a fit begins with


@dataclass(frozen=True)
class ShapedFit:
    """A motor beside what shapes most motions, fitted to recordings that were read by a timing."""

    estimate: Estimate

    @cached_property
    def residuals(self) -> Floats:
        """The weighted residuals (I,) that it leaves."""
        return SpeedResiduals(self.estimate.problem).residuals(self.estimate.theta)

    @property
    def delay(self) -> float:
        """[s] The dead time that it asks for."""
        return self.estimate.parameters.value("delay")


@dataclass(frozen=True)
class Shaper:
    """Fits recordings beside what shapes most motions, from an estimate's kv and ka, by any timing."""

    recordings: Sequence[Recording]
    estimate: Estimate
    restrict: Callable[[Problem], Problem] | None  # to what a fit may see; all, without
    known: tuple[str, ...] = ()  # effects that are in the motor, whatever its timing
    rows: RowTimes = AS_STAMPED

    @cached_property
    def blocks(self) -> list[list[Span]]:
        """The spans [s] of every recording that tell how its speeds were made."""
        return choose_blocks(self.recordings)

    def fit(self, timing: Timing, beside: Sequence[str] = ()) -> ShapedFit:
        """Fit the recordings read by a timing, beside more effects too."""
        timed = replace(timing, rows=self.rows).set_on(self.recordings)
        driven = np.concatenate([recording.voltage for recording in timed])
        both = min(-driven.min(), driven.max()) >= BOTH_WAYS * np.abs(driven).max()
        shaping, begin = normalised((*(SHAPING_BOTH_WAYS if both else SHAPING), *self.known, *beside)), self.estimate
        problem = make_problem(timed, shaping, begin.problem.workers, begin.problem.stopped)
        problem = problem if self.restrict is None else self.restrict(problem)
        row = problem.sample_period
        starts = {
            spec.name: np.full(len(timed), BEGIN * row * spec.scale.sample or spec.off) for spec in specs_of(shaping)
        }
        theta = map_theta(begin.problem.unknowns, begin.theta, problem.unknowns, starts)
        return ShapedFit(fit_speeds(Estimate(problem, theta), np.inf, ITERATIONS, TOLERANCE))


def measure_gain(before: Floats, after: Floats) -> float:
    """Measure how much likelier residuals are, each as noise of which a part is that of the row before (AR(1))."""
    count = min(len(before), len(after))  # at the beginning a row may have no whole window
    old, new = (_innovate(one[-count:]) for one in (before, after))
    if not (isfinite(old) and isfinite(new)) or old <= 0.0:
        return 0.0
    return 0.5 * count * log(old / new) if new > 0.0 else inf


def _innovate(residuals: Floats) -> float:
    """Compute the power that the best prediction of each residual from the one before leaves."""
    power = float(np.sum(residuals**2))
    alike = float(residuals[1:] @ residuals[:-1]) / power if power > 0.0 else 0.0
    return power * (1.0 - alike**2)
