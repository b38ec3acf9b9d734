"""Judge a lag by a bridge that slews: its output follows every change of the command no faster than so many V/s.

Soft starts and ramps of motor controllers do that. It is not in the table, and a dead time or an inductance stands in
for it. After a change by U volts at a rate r the output is late by U/(2·r) in the mean; a lag is late by the same after
any. Here the recorded command is made to slew before the motor gets it, as the mean of every row.
"""

from dataclasses import replace
from math import exp, log

import numpy as np
from scipy.optimize import minimize_scalar

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.candidate_test import likelihood_threshold
from motor_identification.diagnosis.fits.altered_commands import fit_altered, measure_share, score_alone
from motor_identification.diagnosis.fits.disturbed_fit import list_error_data
from motor_identification.diagnosis.fits.effect_fit import drop_effect
from motor_identification.discrepancy.free_curves import PAST
from motor_identification.discrepancy.structure import Structure
from motor_identification.estimation.estimate import Estimate
from motor_identification.noise.error_data import log_likelihood
from motor_identification.recording import Floats, Recording
from motor_model.compiled import compiled
from motor_model.effects import EFFECT_BY_NAME, LAGS

CAUSE = "a command that reaches the motor at {:.3g} V/s at most (a ramp or soft start of the controller)"
APART = 1.6  # of rates tried about that which makes the command as late as the lag
LONG_ROW = 1.5  # times the usual row: rows before it were lost, and what was commanded in them is not known
PRECISION, MOST_FITS = 0.03, 8  # of the logarithm of the rate, and fits that find it


def find_slewing(effect: str, without: Model, current: Model) -> Structure | None:
    """Find the slewing bridge that makes the motion likelier than the lags of a model, which are not needed beside it.

    without: the model that lacks the lag. None where the lag does not stand in for such a bridge.
    """
    if effect not in LAGS or not (current.beside_torque or current.above_floor):
        return None
    recordings = current.estimate.problem.recordings
    changes = np.abs(np.concatenate([np.diff(recording.voltage) for recording in recordings]))
    bare, late = _drop_lags(current.estimate)
    if not np.any(changes) or late <= 0.0:
        return None
    having, lacking = (score_alone(model.estimate, current) for model in (current, without))
    likeliest = _find_likeliest(bare, current, _guess_rate(changes, late), having - 0.5 * abs(having - lacking))
    if likeliest is None:
        return None
    rate, slewing, found = likeliest
    if found <= having + thresholds.SLEWING_GAIN:
        return None
    both = score_alone(_fit_slewing(current.estimate, current, rate), current)
    return None if both > found + likelihood_threshold() else _describe(slewing, without, found - lacking, rate)


def _drop_lags(estimate: Estimate) -> tuple[Estimate, float]:
    """Drop all that makes a motion late: two lags may stand in for one bridge; and by how much they do [s]."""
    late = 0.0
    for effect in LAGS:
        if effect in estimate.problem.unknowns.effects:
            late += estimate.parameters.value(EFFECT_BY_NAME[effect].parameters[0].name)
            estimate = drop_effect(estimate, effect)
    return estimate, late


def _guess_rate(changes: Floats, lag: float) -> float:
    """Guess the rate [V/s] that makes changes of a command [V], by size, as late in the mean as a lag [s]."""
    return float(np.sum(changes**2) / (2.0 * lag * np.sum(changes)))


def _find_likeliest(bare: Estimate, current: Model, guess: float, least: float) -> tuple[float, Estimate, float] | None:
    """Find the rate [V/s] with which the motion is likeliest, about a guess, its fit and score; None not above least.

    Near it each is judged under errors of its own: those of a long lag are as slow as what it leaves. Measured: under
    those of one of 44 ms 140 V/s were likelier than the true 150, under their own less likely by 758.
    """
    fits: dict[float, Estimate] = {}

    def fit(rate: float) -> Estimate:
        fits[rate] = _fit_slewing(bare, current, rate)
        return fits[rate]

    tried = [guess / APART, guess, guess * APART]
    most, best = max((log_likelihood(list_error_data(fit(rate)), current.errors, current.lag), rate) for rate in tried)
    if most <= least:
        return None
    within = log(best / APART), log(best * APART)
    options = {"xatol": PRECISION, "maxiter": MOST_FITS}
    found = minimize_scalar(
        lambda x: -score_alone(fit(exp(x)), current), bounds=within, method="bounded", options=options
    )
    score, rate = max((score_alone(fits[best], current), best), (-found.fun, exp(found.x)))
    return rate, fits[rate], score


def _fit_slewing(estimate: Estimate, current: Model, rate: float) -> Estimate:
    """Fit an estimate again to recordings whose command slews at a rate [V/s], as a model was fitted."""
    return fit_altered(estimate, current, [slew(recording, rate) for recording in estimate.problem.recordings])


def _describe(slewing: Estimate, without: Model, gain: float, rate: float) -> Structure:
    """Describe what a bridge that slews at a rate [V/s] takes of what a model leaves: it goes with the past."""
    share = measure_share(slewing, without, gain)
    return Structure(PAST, share, gain, relevant=True, cause=CAUSE.format(rate))


def slew(recording: Recording, rate: float) -> Recording:
    """Make a recording's command slew at a rate [V/s]: the mean of every row; not where rows were lost.

    Measured: of a loop whose log lost 8 % of its rows, such a bridge came nearer to the commands that nobody logged
    than the next that was, and was made up: 13 % of what was left at 0.98 of the floor.
    """
    given = np.empty_like(recording.voltage)
    durations = np.diff(recording.time, append=recording.time[-1] + recording.info.sample_period)
    follow(recording.voltage, durations, rate, LONG_ROW * float(np.median(durations)), given)
    return replace(recording, voltage=given)


@compiled
def follow(command: Floats, duration: Floats, rate: float, longest: float, given: Floats) -> None:
    """Average [V] what follows a command [V] at a rate [V/s] over rows of durations [s], all of shape (S,).

    In rows longer than the longest [s] it is there at once.
    """
    output = command[0]
    for s in range(len(command)):
        if duration[s] > longest:
            given[s] = output = command[s]
            continue
        change = command[s] - output
        way = 1.0 if change > 0.0 else -1.0
        possible = rate * duration[s]
        reached = min(way * change, possible)
        given[s] = output + way * reached * (1.0 - 0.5 * reached / possible)
        output += way * reached
