"""Tell structure from disturbance: can free curves learnt on training motion predict what a model leaves elsewhere?

In the whitened residual a curve is linear: its knots come from ridge regression on training intervals, with a prior
whose strength maximises the marginal likelihood, and are judged by the likelihood ratio on intervals that neither the
fit nor the curve has seen. What no curve can predict is disturbance, however large; what one can is structure.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import log

import numpy as np

from motor_identification.discrepancy.free_curves import (
    FAMILIES,
    OF_ONE_RECORDING,
    OF_SPEED,
    Reach,
    measure_reach,
    respond,
)
from motor_identification.discrepancy.rest import ROBUST, Rest, make_up_disc
from motor_identification.discrepancy.spectrum_lines import find_lines
from motor_identification.noise.error_model import ErrorModel, Lag
from motor_identification.recording import Floats

CERTAIN = log(len(FAMILIES) / 0.01)  # [nat] likelihood ratio that chance exceeds in 1 % of complete models (Markov)
LEAST_SHARE = 0.1  # of the power of what is left: complete models show −0.03 to +0.04 in every variable
LEAST_WHITE_SHARE = 0.03  # of the white residual's power
OVER_THE_DISC = "angle"  # the family whose curves an irregular disc has too
OF_TIME = 0.5  # a bridge that slews shows to four fifths in the motion before; a supply's ripple in no motion at all


@dataclass(frozen=True)
class Structure:
    """What curves over one variable predict of what a model leaves."""

    variable: str
    share: float  # of the power of what is left in held-out speed, beyond the sensor's
    significance: float  # [nat] log likelihood ratio on held-out motion
    relevant: bool = False  # however small its share, because an effect that does no more was
    cause: str = ""  # what outside the table leaves that, where it was tried

    @property
    def certain(self) -> bool:
        """Whether it is there, and more than a sensor's pattern."""
        return self.significance > CERTAIN and (self.relevant or self.share > LEAST_SHARE)

    @property
    def most(self) -> float:
        """Its share, of all that is left at most: one that the white residual tells is scaled up, and may be more."""
        return min(self.share, 1.0)


def find_structure(own: Sequence[Rest], others: Sequence[Rest], model: ErrorModel, lag: Lag) -> tuple[Structure, ...]:
    """Judge every family of curves, the one that predicts most first.

    own: recordings with intervals to judge by. others: training recordings, to learn from what holds in all of them.
    model, lag: of what is left, and of the fitted motor.
    """
    reach = measure_reach([rest.history for rest in (*own, *others)], 1.0 / lag.rate)
    reach = replace(reach, lines=find_lines(own, model, lag))
    found = []
    for name in FAMILIES:
        rests = own if name in OF_ONE_RECORDING or not others else (*(_to_judge(rest) for rest in own), *others)
        judged = _judge_family(name, rests, reach, model, lag)
        if judged.certain and name in OF_SPEED:  # a torque that is in the measured speed is predicted by it, too
            simulated = [replace(rest, history=rest.simulated()) for rest in rests]
            again = _judge_family(name, simulated, reach, model, lag)
            judged = min(judged, again, key=lambda one: one.significance)
        found.append(judged)
    return rank(found)


def rank(found: Sequence[Structure]) -> tuple[Structure, ...]:
    """Rank structures: what is certain first, by its share; then the others by their significance.

    A curve over time is learnt in the recording that it is judged in, between whose samples it interpolates: beside a
    variable of the motion, learnt elsewhere too, it counts half.
    """

    def key(one: Structure) -> tuple[bool, float]:
        share = one.most * (OF_TIME if one.variable in OF_ONE_RECORDING else 1.0)
        return not one.certain, -share if one.certain else -one.significance

    return tuple(sorted(found, key=key))


def _to_judge(rest: Rest) -> Rest:
    return replace(rest, learnt=np.zeros_like(rest.learnt))


@dataclass(frozen=True)
class _Prediction:
    """What curves predict on intervals that they have not seen."""

    gain: float  # [nat] log likelihood ratio
    white_power: float  # of the white residual, half its squares
    before: float  # [rad²/s] squares of the mean speeds that are left, over time
    after: float  # the same less what curves predict
    floor: float  # of them, what the sensor leaves


def _judge_family(name: str, rests: Sequence[Rest], reach: Reach, model: ErrorModel, lag: Lag) -> Structure:
    """Judge a family; what it predicts of a disc's slots is the sensor's, however well it does."""
    told = _predict(name, rests, reach, model, lag)
    judged = _measure_structure(name, told, told.gain, told.before - told.after)
    if name != OVER_THE_DISC or not judged.certain:  # less a disc it is less certain still
        return judged
    disc = _predict(name, [make_up_disc(rest, model) for rest in rests], reach, model, lag)
    gain, explained = told.gain - max(disc.gain, 0.0), told.before - told.after - max(disc.before - disc.after, 0.0)
    return _measure_structure(name, told, gain, explained)


def _measure_structure(name: str, told: _Prediction, gain: float, explained: float) -> Structure:
    """Measure a structure by how likely it is [nat], and by its share of squared speeds, or of the white residual."""
    share = explained / (told.before - told.floor) if told.before > told.floor else 0.0
    white_share = gain / told.white_power if told.white_power > 0.0 else 0.0
    return Structure(name, max(share, white_share * LEAST_SHARE / LEAST_WHITE_SHARE), gain)


def _predict(name: str, rests: Sequence[Rest], reach: Reach, model: ErrorModel, lag: Lag) -> _Prediction:
    """Learn the knots of a family of curves, and predict what is left where they are judged."""
    normal: Floats = np.zeros((0, 0))
    moment: Floats = np.zeros(0)
    kept = []
    for rest in rests:
        response = respond(rest.history, FAMILIES[name](rest.history, reach), lag)
        _value, white = rest.errors.whiten(model, lag, response)
        learnt, judged = (mask & ~rest.errors.still for mask in (rest.learnt, rest.judged))
        x, z = white[1:, learnt], np.clip(white[0, learnt], -ROBUST, ROBUST)
        normal, moment = (normal + x @ x.T, moment + x @ z) if len(moment) else (x @ x.T, x @ z)
        speeds = (response / rest.errors.duration)[:, judged]
        kept.append((white[0, judged], white[1:, judged], rest.speeds[judged], speeds, rest, judged))
    knots = solve_ridge(normal, moment)
    gain = white_power = before = after = floor = 0.0
    for z, x, speed, response, rest, judged in kept:
        left = z - knots @ x
        gain += float(np.sum(_loss(z) - _loss(left)))
        white_power += float(np.sum(_loss(z)))
        duration = rest.errors.duration[judged]
        before += float(duration @ speed**2)
        after += float(duration @ (speed - knots @ response) ** 2)
        sensor = rest.errors.blur[judged] ** 2 + (model.share * rest.errors.unit) ** 2
        floor += float(np.sum(2.0 * sensor / duration))
    return _Prediction(gain, white_power, before, after, floor)


def _loss(white: Floats) -> Floats:
    """Minus the logarithm of a white residual's density, which falls exponentially beyond some standard deviations."""
    size = np.abs(white)
    return np.where(size < ROBUST, 0.5 * size**2, ROBUST * size - 0.5 * ROBUST**2)


def solve_ridge(normal: Floats, moment: Floats) -> Floats:
    """Solve a ridge regression from XᵀX (C, C) and Xᵀz (C,) of white z: every knot is as likely to be some volts off.

    The prior's variance [V²] maximises the marginal likelihood on a grid (D. MacKay, Neural Comp. 4(3), 1992).
    """
    values, vectors = np.linalg.eigh(normal)
    values, projected = np.maximum(values, 0.0), vectors.T @ moment
    best, chosen = 0.0, 0.0
    for prior in np.geomspace(1e-10, 1e2, 49):
        gain = 0.5 * float(np.sum(projected**2 * prior / (1.0 + prior * values) - np.log1p(prior * values)))
        if gain > best:
            best, chosen = gain, float(prior)
    return np.asarray(vectors @ (projected * chosen / (1.0 + chosen * values)))
