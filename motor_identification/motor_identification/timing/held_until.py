"""Find whether the voltages of a counted log held until their rows, where nobody said from when on they hold.

A program that writes a row before it commands anew logs the voltage that held until then. Read as if it held from there
on, its motor answers a row before it is asked, which no effect does: a dead time is never negative. So the motor is
fitted to both readings of the same counts, each beside what shapes most motions and beside a random torque, which a
controller answers and which would look like a motion that comes early (U. Forssell and L. Ljung, Automatica 35, 1999).
The later voltage is taken only if nothing is late by the earlier one, and the motion is much likelier by the later one
and late by less than half a row: a reading that is taken by mistake would hide a row of dead time.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import tau

import numpy as np

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_residuals, fit_speeds
from motor_identification.estimation.parameter_space import map_theta
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.whitened_fit import FilteredResiduals
from motor_identification.noise.error_data import ErrorData, log_likelihood, make_error_data, make_whitening
from motor_identification.noise.error_learning import learn_error_model
from motor_identification.noise.error_model import ErrorModel
from motor_identification.recording import Recording
from motor_identification.sensor.speed_sensor import find_counts, find_speed_sensor
from motor_identification.timing.shaped_fit import BEGIN, ITERATIONS, TOLERANCE, Shaper
from motor_identification.timing.timing import ASSUMED, LEAST_DELAY, OTHERS, UNTIL, Timing, is_open, is_voltage_open
from motor_model.effects import LAGGING, SPEC_BY_NAME

# Of log likelihood, in all and a row, which the later reading has to be worth. Measured in some hundred simulated logs,
# written either way, with nothing late in them: 20 to 1,100 (0.015 to 0.5 a row) where voltages held until their rows
# and rows are not much finer than the motor answers; up to 33 (0.015) where they hold from there on, where a bridge
# coasted of which this fit knows nothing.
LEAST_GAIN, LEAST_GAIN_OF_ROW = 20.0, 0.02
MOST_DELAY = 0.5  # rows: with a longer dead time the voltage of half a row earlier is nearer
ROUNDS = 2  # of learning the torque that is left, and fitting beside it
# Of ka, and its standard errors: what it has to differ by from reading to reading for that to be said. No row that
# is a smaller part of the time constant makes it differ so much.
MATTERS, SURE_ERRORS = 0.05, 3.0
# Of log likelihood: a later reading that is less likely by more is none, as far as a fit without all effects goes. None
# is taken for less than LEAST_GAIN, so that where ka, or a dead time, would be quite another one, so much less is said.
AS_LIKELY = 10.0
# Of the value, and its standard errors: what is quite another one. Measured: a ka of 2.6 times the true one, of which
# its error said 1.5 %, by speeds of their instants that were taken for means over rows, likelier by 10.7.
FAR, FAR_ERRORS = 0.5, 10.0
MOST_COUNTS = 20_000  # a turn, of an encoder
UNTOLD = "this log does not tell"
HARDLY_TOLD = "this log hardly tells"
LIKELIER = "this motion rather speaks for another reading"
OF_VOLTAGES = (
    "From when on a row's voltage holds was not said, and {}: of voltages that held until their rows (import_log "
    "--voltage-before)"
)
OF_SPEEDS = (
    "When speeds were made was not said, and {}: of values of their rows' own instants (import_log --speed-window "
    "ROW --speed-lag 0)"
)
OF_BOTH = (
    "When speeds were made was not said, and {}: of values of their rows' own instants, and voltages that held until "
    "these (import_log --speed-window ROW --speed-lag 0 --voltage-before)"
)


@dataclass(frozen=True)
class _Reading:
    """A motor fitted to one reading of the voltages, and how likely the counts are by it."""

    estimate: Estimate
    errors: ErrorModel
    likelihood: float

    @property
    def delay(self) -> float:
        """Rows of dead time that it asks for."""
        return self.estimate.parameters.value("delay") / self.estimate.problem.sample_period


def held_until(shaper: Shaper, complete: bool = False) -> bool:
    """Decide whether the voltages of a shaper's recordings held until their rows.

    complete: whether nothing is left beside what the shaper knows: then no row counts for less, the more there are.
    """
    fitted = shaper.fit(ASSUMED)
    first = fitted.estimate
    if fitted.delay > LEAST_DELAY * first.problem.sample_period:
        return False
    as_logged = _fit_beside_torque(first)
    if as_logged.delay > LEAST_DELAY:
        return False
    later = _fit_beside_torque(_read_later(first))
    gain = later.likelihood - as_logged.likelihood
    least = LEAST_GAIN if complete else max(LEAST_GAIN, LEAST_GAIN_OF_ROW * count_intervals(first))
    return later.delay < MOST_DELAY and gain > least


def find_held_behind_lag(shaper: Shaper, known: Timing) -> Timing | None:
    """Find how speeds were made if voltages held until the rows, beside an inductance; None if that is not likelier.

    A lag of the sensor and voltages that are a row early hide each other, as far as a dead time goes. known: as what
    else was found has them. Measured: a tachogenerator's filter of a row and a half, likelier by 1,256.
    """
    others = (UNTIL,) if all(map(is_voltage_open, shaper.recordings)) else (UNTIL, OTHERS[2])
    least = _fit_beside_torque(shaper.fit(known, LAGGING).estimate).likelihood + LEAST_GAIN
    found = [(_fit_beside_torque(shaper.fit(timing, LAGGING).estimate), timing) for timing in others]
    likely = [one for one in found if one[0].delay < MOST_DELAY and one[0].likelihood > least]
    return max(likely, key=lambda one: one[0].likelihood)[1] if likely else None


def describe_untold(estimate: Estimate, errors: Mapping[str, float]) -> list[str]:
    """Say what ka and a dead time would be by another timing of the rows, where nobody said it, nor does the log.

    Of counts, if voltages held until their rows; of speeds that are none, if they are of their rows' own instants.
    errors: the standard errors by parameters' names. Nothing where they are much the same.
    """
    problem = estimate.problem
    imported = all(one.info.source == "import" for one in problem.recordings)
    late = "delay" in errors
    if not imported or (problem.sample_period < MATTERS * estimate.parameters.time_constant and not late):
        return []
    if all(map(is_voltage_open, problem.recordings)):
        return _compare(estimate, _read_later(estimate), errors, OF_VOLTAGES, estimate)
    if not all(map(is_open, problem.recordings)):
        return []
    row, here = OTHERS[0].window * problem.sample_period, _read_rows(estimate, ASSUMED)
    unsaid = all(one.info.voltage_assumed for one in problem.recordings)
    if any(map(_is_counted, problem.recordings)):  # each is the mean of its row: only its voltage may be of another
        return _compare(here, _read_rows(estimate, UNTIL), errors, OF_VOLTAGES, estimate) if unsaid else []
    others = ((OTHERS[0], OF_SPEEDS), *([(OTHERS[2], OF_BOTH)] if unsaid else []))
    return [
        note
        for timing, text in others
        for note in _compare(here, _read_rows(estimate, timing), errors, text.replace("ROW", f"{row:.3g}"), estimate)
    ]


def _is_counted(recording: Recording) -> bool:
    """Whether speeds are multiples of a count in a row, and of no converter's step, which is finer than encoders'.

    Nor of one that is far finer than their noise, so that they are not taken for counts.
    """
    step = find_counts(recording.speed, recording.sample_period)
    return step * recording.sample_period * MOST_COUNTS > tau and find_speed_sensor(recording).sigma == 0.0


def _compare(estimate: Estimate, other: Estimate, errors: Mapping[str, float], text: str, told: Estimate) -> list[str]:
    """Say what two readings give, the other and this, where that differs and the other is as likely.

    Or hardly less likely, where that differs by far. told: the estimate that a user is told of, whose values are said.
    """
    here, there = _fit_beside_torque(estimate), _fit_beside_torque(other)
    gain = there.likelihood - here.likelihood
    if gain < -LEAST_GAIN:
        return []
    share, times = (MATTERS, SURE_ERRORS) if gain >= -AS_LIKELY else (FAR, FAR_ERRORS)
    said = []
    for name in ("ka", "delay") if "delay" in errors else ("ka",):
        own, ours, theirs = (one.parameters.value(name) for one in (told, here.estimate, there.estimate))
        least = max(share * ours, times * errors[name])
        if min(abs(theirs - ours), abs(theirs - own)) > least:
            said.append(f"{name} would be {theirs:.3g} instead of {own:.3g} {SPEC_BY_NAME[name].unit}")
    which = LIKELIER if gain > AS_LIKELY else UNTOLD if gain >= -AS_LIKELY else HARDLY_TOLD
    return [f"{text.format(which)} {' and '.join(said)}."] if said else []


def count_intervals(estimate: Estimate) -> int:
    """Count the intervals of an estimate's problem."""
    return sum(len(data.first) for data in estimate.problem.intervals)


def _read_later(estimate: Estimate) -> Estimate:
    """Fit the same intervals with the voltages that held until their rows."""
    problem = replace(estimate.problem, recordings=UNTIL.set_on(estimate.problem.recordings))
    unknowns = problem.unknowns
    begin = {"delay": np.full(len(problem.recordings), BEGIN * problem.sample_period)}
    theta = map_theta(unknowns, estimate.theta, unknowns, begin)
    return fit_speeds(Estimate(problem, theta), np.inf, ITERATIONS, TOLERANCE)


def _read_rows(estimate: Estimate, timing: Timing) -> Estimate:
    """Fit all rows that a fit may see, also of a problem that was thinned, with speeds that were made so."""
    before = estimate.problem
    effects, split = before.unknowns.effects, before.unknowns.splits_kv
    problem = make_problem(timing.set_on(before.recordings), effects, before.workers, before.stopped)
    problem = replace(problem.with_effects(effects, split), tracks=before.tracks, kept_out=before.kept_out)
    problem = problem.with_intervals(problem.intervals)
    theta = map_theta(before.unknowns, estimate.theta, problem.unknowns, {})
    return fit_speeds(Estimate(problem, theta), np.inf, ITERATIONS, TOLERANCE)


def _fit_beside_torque(estimate: Estimate) -> _Reading:
    """Fit by generalised least squares beside the random torque that is left, as long as that makes it likelier."""
    best = _judge(estimate)
    for _ in range(ROUNDS):
        filters = tuple(make_whitening(row, best.errors, best.estimate.lag) for row in _list_errors(best.estimate))
        target = FilteredResiduals(best.estimate.problem, filters)
        again = _judge(fit_residuals(best.estimate, target, np.inf, ITERATIONS, TOLERANCE))
        if again.likelihood <= best.likelihood:
            break
        best = again
    return best


def _judge(estimate: Estimate) -> _Reading:
    rows = _list_errors(estimate)
    errors = learn_error_model(rows, estimate.lag)
    size = sum(float(np.sum(np.log(row.duration))) for row in rows)  # what was logged is a speed, not an angle
    return _Reading(estimate, errors, log_likelihood(rows, errors, estimate.lag) + size)


def _list_errors(estimate: Estimate) -> list[ErrorData]:
    """List what an estimate leaves of every recording."""
    return [make_error_data(*row) for row in zip(estimate.problem.intervals, estimate.increments, strict=True)]
