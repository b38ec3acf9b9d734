"""Judge a warming-up by a supply that runs down: both make a motor slower and slower while it runs.

Of a winding that heats up, the motor needs more voltage for every torque; of a battery that runs down, or a regulator
that gives way, less of every command arrives, whatever the torque. That is not in the table. Here the recorded voltage
falls by 1 − d·(1 − e^(−t/τ)) before the motor gets it.
"""

from dataclasses import replace
from math import exp, log
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.fits.altered_commands import fit_altered, measure_share, score_alone
from motor_identification.diagnosis.fits.disturbed_fit import list_error_data
from motor_identification.diagnosis.fits.effect_fit import drop_effect
from motor_identification.discrepancy.free_curves import BY_TIME
from motor_identification.discrepancy.structure import Structure
from motor_identification.estimation.estimate import Estimate
from motor_identification.noise.error_data import log_likelihood
from motor_identification.recording import Recording
from motor_identification.validation.instants import comes_slowly
from motor_model.effects import EFFECT_BY_NAME

CAUSE = "a supply that runs down, by {:.0%} within the recording (a battery, or a regulator that gives way)"
TIMES = (0.15, 0.5, 3.5)  # of the longest recording: constants in which it runs down, beside the warming-up's own
APART, TIME_PRECISION = 3.0, 0.05  # about the likeliest of those: times, and of a time's logarithm
MOST_DROOP = 0.5  # of the voltage at the start
PRECISION, MOST_FITS = 0.005, 8  # of the droop at the end of a recording, and fits that find it


class _Droop(NamedTuple):
    """A supply that runs down, and the motor under it."""

    likelihood: float  # under a model's errors
    end: float  # share of the voltage that is gone at the longest recording's end
    time: float  # [s] time constant
    fit: Estimate


def find_droop(effect: str, without: Model, current: Model) -> Structure | None:
    """Find the supply that runs down and makes the motion likelier than the warming-up of a model.

    without: the model that lacks the warming-up. None where it does not stand in for such a supply, or where the supply
    was measured.
    """
    if not comes_slowly(effect) or not (current.beside_torque or current.above_floor):
        return None
    recordings = current.estimate.problem.recordings
    if any(np.any(np.isfinite(recording.supply_voltage)) for recording in recordings):
        return None
    bare = drop_effect(current.estimate, effect)
    duration = max(recording.duration for recording in recordings)
    own = current.estimate.parameters.value(EFFECT_BY_NAME[effect].parameters[-1].name)
    times = [*(share * duration for share in TIMES), own]
    droop = _refine_time(bare, current, max((_find_likeliest(bare, current, time) for time in times), key=_likelihood))
    having, lacking, found = (score_alone(one, current) for one in (current.estimate, without.estimate, droop.fit))
    if found <= having + thresholds.DROOPING_GAIN:
        return None
    share = measure_share(droop.fit, without, found - lacking)
    return Structure(BY_TIME, share, found - lacking, relevant=True, cause=CAUSE.format(droop.end))


def _likelihood(droop: _Droop) -> float:
    return droop.likelihood


def _refine_time(bare: Estimate, current: Model, best: _Droop) -> _Droop:
    """Find the droop with the likeliest time constant about one."""
    tried = [best]

    def judge(logarithm: float) -> float:
        tried.append(_find_likeliest(bare, current, exp(logarithm)))
        return -tried[-1].likelihood

    within = log(best.time / APART), log(best.time * APART)
    minimize_scalar(judge, bounds=within, method="bounded", options={"xatol": TIME_PRECISION, "maxiter": MOST_FITS})
    return max(tried, key=_likelihood)


def _find_likeliest(bare: Estimate, current: Model, time: float) -> _Droop:
    """Find the droop with which the motion is likeliest, for a time constant [s]."""
    ends = 1.0 - exp(-max(recording.duration for recording in bare.problem.recordings) / time)
    fits: dict[float, tuple[float, Estimate]] = {}

    def fit(droop: float) -> float:
        fitted = _fit_drooping(bare, current, droop / ends, time)
        fits[droop] = log_likelihood(list_error_data(fitted), current.errors, current.lag), fitted
        return -fits[droop][0]

    options = {"xatol": PRECISION, "maxiter": MOST_FITS}
    found = minimize_scalar(fit, bounds=(0.0, MOST_DROOP * ends), method="bounded", options=options)
    likelihood, fitted = fits[float(found.x)]
    return _Droop(likelihood, float(found.x), time, fitted)


def _fit_drooping(estimate: Estimate, current: Model, droop: float, time: float) -> Estimate:
    """Fit an estimate again to recordings under a supply that runs down, as a model was fitted."""
    return fit_altered(estimate, current, [run_down(one, droop, time) for one in estimate.problem.recordings])


def run_down(recording: Recording, droop: float, time: float) -> Recording:
    """Make a recording's voltage fall by a share of itself, with a time constant [s] from its start on."""
    since = recording.time - recording.time[0]
    return replace(recording, voltage=recording.voltage * (1.0 - droop * (1.0 - np.exp(-since / time))))
