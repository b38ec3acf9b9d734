"""Judge a backlash by a friction that builds up after every reversal: both show where a motor turns round.

Presliding friction goes from one side to the other over an angle d, x being the travel since the reversal,

    friction = ks·(1 − 2·exp(−x/d))·sign ω

(P. Dahl, "A solid friction model", Aerospace Corp. TOR-0158(3107-18)-1, 1968). A backlash lets the inertia of a load
go instead, until the play is taken up. The friction is not in the table: it takes the place of the Coulomb friction in
the motion that a model simulates, by linear least squares of what that leaves; kv, the gain and a load are fitted again
with it, and so they are in the models that it is compared with.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.fits.disturbed_fit import list_error_data
from motor_identification.discrepancy.free_curves import KNOTS, PAST, TRAVEL, respond
from motor_identification.discrepancy.motion_history import MotionHistory
from motor_identification.discrepancy.rest import ROBUST
from motor_identification.discrepancy.rests import list_training_rests
from motor_identification.discrepancy.structure import Structure
from motor_identification.noise.error_data import ErrorData, log_likelihood
from motor_identification.noise.gain_learning import score_under_own_errors
from motor_identification.recording import Floats

CAUSE = "a friction that builds up after every reversal (presliding)"
RIDGE = 1e-9  # of a column's power: in a motor that turns one way, friction and load are one column
Rest = tuple[ErrorData, MotionHistory]  # what a model leaves in a recording, and the motion that it simulates there


def find_presliding(without: Model, current: Model) -> Structure | None:
    """Find the friction that builds up and explains much of what a backlash of a model does, of fitted motion.

    without: the model that lacks the backlash. None where the backlash does not stand in for such a friction.
    """
    rests = _list_rests(without)
    before = _score_refitted(without, rests)
    backlash = _score_refitted(current, _list_rests(current)) - before
    left = _refit_presliding(without, rests)
    gain = _score(without, left) - before
    if gain <= thresholds.PRESLIDING_SHARE * backlash:
        return None
    share = 1.0 - _sum_squares(left) / _sum_squares([errors for errors, _ in rests])
    white_share = 2.0 * gain / sum(len(errors.increments) for errors in left)  # where the sensor hides it
    return Structure(PAST, max(share, white_share), gain, relevant=True, cause=CAUSE)


def _sum_squares(left: Sequence[ErrorData]) -> float:
    """Sum up the squared mean speeds [rad²/s] that are left, over time."""
    return sum(float(np.sum(errors.increments**2 / errors.duration)) for errors in left)


def _score_refitted(model: Model, rests: Sequence[Rest]) -> float:
    """Compute the log likelihood of what a model leaves, refitted where that is likelier; standstills bend it.

    Under errors that are learned of it, too: those of a model that explains all down to the sensor's floor are the
    sensor's to begin with. Measured: by these a backlash that took a gap from 9.3 to 0.13 rad/s was less likely than
    nothing by 123, and a presliding friction took its place that was likelier by 9.
    """
    left = [errors for errors, _ in rests]
    own = max(log_likelihood(left, model.errors, model.lag), _score(model, left))
    return max(own, _score(model, _refit(model, rests, 0.0)))


def _score(model: Model, left: Sequence[ErrorData]) -> float:
    """Compute the log likelihood of what is left, under errors that are learned of it."""
    return score_under_own_errors(left, model.lag, model.errors, thresholds.CANDIDATE_EVALUATIONS)


def _refit_presliding(model: Model, rests: Sequence[Rest]) -> list[ErrorData]:
    """Refit with the likeliest presliding friction in a model."""
    reach = max(float(np.abs(motion.speed).max(initial=0.0)) for _, motion in rests) / model.lag.rate
    fits = [_refit(model, rests, angle) for angle in np.geomspace(*TRAVEL, KNOTS) * reach]
    return max(fits, key=lambda left: log_likelihood(left, model.errors, model.lag))


def _list_rests(model: Model) -> list[Rest]:
    rests = list_training_rests(model.estimate, list_error_data(model.estimate))
    return [(rest.errors, rest.simulated()) for rest in rests]


def _refit(model: Model, rests: Sequence[Rest], angle: float) -> list[ErrorData]:
    """Refit kv, friction, gain and load to white residuals; what is left then, recording by recording.

    angle: [rad] over which the friction builds up after a reversal; 0 of one that does not.
    """
    torques = partial(_list_torques, ks=model.estimate.parameters.values.get("ks", 0.0), angle=angle)
    responses = [respond(motion, torques(motion), model.lag) for _, motion in rests]
    known = [
        replace(errors, increments=errors.increments - response[0])
        for (errors, _), response in zip(rests, responses, strict=True)
    ]
    sizes, _ = fit_torques(model, known, [response[1:] for response in responses])
    rows = zip(known, responses, strict=True)
    return [replace(row, increments=row.increments - sizes @ response[1:]) for row, response in rows]


def fit_torques(model: Model, rows: Sequence[ErrorData], responses: Sequence[Floats]) -> tuple[Floats, Floats]:
    """Fit torques to what a model leaves: their sizes (C,), and moments (C,) with the white residuals.

    responses: of every row to each torque of unit size, shape (C, I).
    """
    count = len(responses[0])
    normal, moment = np.zeros((count, count)), np.zeros(count)
    for row, response in zip(rows, responses, strict=True):
        white = row.whiten(model.errors, model.lag, response)[1][:, ~row.still]
        normal += white[1:] @ white[1:].T
        moment += white[1:] @ np.clip(white[0], -ROBUST, ROBUST)
    power = np.diag(np.maximum(np.diag(normal), np.finfo(float).tiny))
    return np.asarray(np.linalg.solve(normal + RIDGE * power, moment), dtype=np.float64), moment


def _list_torques(motion: MotionHistory, ks: float, angle: float) -> Floats:
    """List torques [V], shape (S, 5): the friction of the model, then of unit size another friction, kv, gain, load."""
    way = np.sign(motion.speed)
    build_up = 2.0 * np.exp(-motion.travel / angle) if angle > 0.0 else 0.0
    return np.stack([-ks * way, way * (1.0 - build_up), motion.speed, motion.voltage, np.ones_like(way)], axis=1)
