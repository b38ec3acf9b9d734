"""Find when a log's speeds were made, where nobody said: means over the row before, or values of the row's own instant.

Speeds that were counted are means over the row before, and so an importer takes them. The value of a tachogenerator, or
what a simulation wrote, is that of its own instant: half a row younger, and sharper where the motion bends. Some
programs write a row when its voltage has been applied: then the motion seems to answer a voltage before it is there,
which no effect does, since a dead time is never negative. So every timing is fitted beside what shapes most motions,
and one that is much likelier is taken; a row more only where the motion still comes too early.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import inf, isfinite, log

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import SpeedResiduals, fit_speeds
from motor_identification.estimation.parameter_space import map_theta
from motor_identification.estimation.problem import Problem, make_problem
from motor_identification.recording import Floats, Recording
from motor_identification.sensor.speed_sensor import is_assumed
from motor_model.effects import SHAPING, SHAPING_BOTH_WAYS, specs_of
from motor_model.sample import Measurement

INSTANT = 0.02  # rows: the window of a value of one instant
# Of log likelihood, in all and a row, which another timing has to be worth. Measured: 100 and more, 0.1 to 1 a row,
# where it is another; up to 17 in all (0.004 a row) where it is as assumed and something else is missing; 0 to 25
# (0.03) in logs of others, of which nobody knows.
LEAST_GAIN, LEAST_GAIN_OF_ROW = 20.0, 0.02
LEAST_DELAY = 0.05  # rows: with a longer dead time nothing comes too early
ITERATIONS, TOLERANCE = 30, 1e-7
LEAST_SPEEDS = 50
BOTH_WAYS = 0.2  # of the largest voltage: what drives a motor both ways
BEGIN = 0.25  # rows: the dead time that a fit begins with

TIMING = (
    "The speeds are taken as {}: as means over the row before they fit the motion much worse "
    "(--speed-window {:.3g} --speed-lag {:.3g} says so to an import)."
)
OWN, BEFORE = "values of their rows' own instants", "{} of the row after the voltage's"


@dataclass(frozen=True)
class Timing:
    """When speeds were made, in rows: how long the window of each is, and how old its middle."""

    window: float
    lag: float
    name: str

    def set_on(self, recordings: Sequence[Recording]) -> tuple[Recording, ...]:
        """Read recordings with this timing, those of which nobody said another; the first one's notes say so."""
        timed = [self._set(recording) if is_open(recording) else recording for recording in recordings]
        if self.name and timed and is_open(recordings[0]):
            row = timed[0].info.sample_period
            note = TIMING.format(self.name, self.window * row, self.lag * row)
            timed[0] = replace(timed[0], notes=(*timed[0].notes, note))
        return tuple(timed)

    def _set(self, recording: Recording) -> Recording:
        info, row = recording.info, recording.info.sample_period
        return replace(recording, info=replace(info, speed_window=self.window * row, speed_lag=self.lag * row))


ASSUMED = Timing(1.0, 0.5, "")
OTHERS = (
    Timing(INSTANT, 0.0, OWN),
    Timing(1.0, -0.5, BEFORE.format("means")),
    Timing(INSTANT, -1.0, BEFORE.format("values")),
)


@dataclass(frozen=True)
class _Fitted:
    """A timing's fit: the weighted residuals (I,) that it leaves, and the dead time [s] that it asks for."""

    residuals: Floats
    delay: float


def find_timing(
    recordings: Sequence[Recording], estimate: Estimate, restrict: Callable[[Problem], Problem] | None = None
) -> Timing | None:
    """Find when the speeds of recordings were made, as their motion shows; None if as assumed, or as was said.

    estimate: of the same motor, as the assumed timing gives it. restrict: to what a fit may see; all, without.
    """
    few = sum(len(recording) for recording in recordings) < LEAST_SPEEDS
    if few or not all(is_open(recording) for recording in recordings):
        return None
    least = LEAST_DELAY * min(recording.info.sample_period for recording in recordings)
    best, fitted = ASSUMED, _fit(recordings, ASSUMED, estimate, restrict)
    early = fitted.delay <= least
    others = [(timing, _fit(recordings, timing, estimate, restrict)) for timing in (OTHERS if early else OTHERS[:1])]
    if early and others[-1][1].delay <= least:  # earlier than any row says: not for its timing
        return None
    for timing, other in others:  # each makes the speeds younger than the one before
        if (fitted.delay <= least or timing is OTHERS[0]) and _is_likelier(other, fitted):
            best, fitted = timing, other
    return None if best is ASSUMED else best


def read_again(recording: Recording, timing: Timing | None) -> Recording:
    """Read a recording again with the timing that a fit found for it; None: as was assumed."""
    return recording if timing is None else timing.set_on([recording])[0]


def list_readings(recording: Recording) -> tuple[Recording, ...]:
    """List how a recording may be read: as it says, and with values of its rows' own instants where it says nothing."""
    return (recording, *OTHERS[0].set_on([recording])) if is_open(recording) else (recording,)


def is_open(recording: Recording) -> bool:
    """Decide whether a recording is of speeds of which nobody said when they were made, nor that they are counts.

    A window of one row that ends there, said by hand, is what is assumed, and open as that is.
    """
    info = recording.info
    unsaid = info.measurement is Measurement.SPEED and not info.edges_per_revolution and is_assumed(info)
    return unsaid and abs(info.speed_lag - ASSUMED.lag * info.sample_period) < LEAST_DELAY * info.sample_period


def _fit(
    recordings: Sequence[Recording],
    timing: Timing,
    estimate: Estimate,
    restrict: Callable[[Problem], Problem] | None,
) -> _Fitted:
    """Fit speeds of this timing beside what shapes every motion, from kv and ka."""
    timed = timing.set_on(recordings)
    driven = np.concatenate([recording.voltage for recording in recordings])
    shaping = SHAPING if min(-driven.min(), driven.max()) < BOTH_WAYS * np.abs(driven).max() else SHAPING_BOTH_WAYS
    problem = make_problem(timed, shaping, estimate.problem.workers, estimate.problem.stopped)
    problem = problem if restrict is None else restrict(problem)
    row = problem.sample_period
    starts = {spec.name: np.full(len(timed), BEGIN * row * spec.scale.sample or spec.off) for spec in specs_of(shaping)}
    theta = map_theta(estimate.problem.unknowns, estimate.theta, problem.unknowns, starts)
    end = fit_speeds(Estimate(problem, theta), np.inf, ITERATIONS, TOLERANCE)
    return _Fitted(SpeedResiduals(problem).residuals(end.theta), end.parameters.values["delay"])


def _is_likelier(one: _Fitted, other: _Fitted) -> bool:
    """Decide whether one timing is much likelier than another."""
    return _measure_gain(other, one) > max(LEAST_GAIN, LEAST_GAIN_OF_ROW * len(one.residuals))


def _measure_gain(before: _Fitted, after: _Fitted) -> float:
    """Measure how much likelier residuals are, each as noise of which a part is that of the row before (AR(1))."""
    count = min(len(before.residuals), len(after.residuals))  # at the beginning a row may have no whole window
    old, new = (_innovate(one.residuals[-count:]) for one in (before, after))
    if not (isfinite(old) and isfinite(new)) or old <= 0.0:
        return 0.0
    return 0.5 * count * log(old / new) if new > 0.0 else inf


def _innovate(residuals: Floats) -> float:
    """Compute the power that the best prediction of each residual from the one before leaves."""
    power = float(np.sum(residuals**2))
    alike = float(residuals[1:] @ residuals[:-1]) / power if power > 0.0 else 0.0
    return power * (1.0 - alike**2)
