"""Tell structure from disturbance: can free curves learnt on training motion predict what a model leaves elsewhere?

In the whitened residual a curve is linear: its knots come from ridge regression on training intervals, with a prior
whose strength maximises the marginal likelihood, and are judged by the likelihood ratio on intervals that neither the
fit nor the curve has seen. What no curve can predict is disturbance, however large; what one can is structure.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import log, tau

import numpy as np

from motor_identification.discrepancy.free_curves import (
    FAMILIES,
    OF_ONE_RECORDING,
    OF_SPEED,
    Reach,
    measure_reach,
    respond,
)
from motor_identification.discrepancy.motion_history import MotionHistory
from motor_identification.noise.error_data import ErrorData
from motor_identification.noise.error_model import ErrorModel, Lag
from motor_identification.noise.slots.first_harmonic import bound_chance_eccentricity
from motor_identification.recording import Bools, Floats

CERTAIN = log(len(FAMILIES) / 0.01)  # [nat] likelihood ratio that chance exceeds in 1 % of complete models (Markov)
LEAST_SHARE = 0.1  # of the power of what is left: complete models show −0.03 to +0.04 in every variable
LEAST_WHITE_SHARE = 0.03  # of the white residual's power
OVER_THE_DISC = "angle"  # the family whose curves an irregular disc has too
ROBUST = 4.0  # standard deviations: beyond, a white residual counts linearly
OF_TIME = 0.5  # a bridge that slews shows to four fifths in the motion before; a supply's ripple in no motion at all
LINES = 3  # of a spectrum that are taken together
SMOOTHED = 20_000  # intervals that a spectrum is taken of at most


@dataclass(frozen=True)
class Structure:
    """What curves over one variable predict of what a model leaves."""

    variable: str
    share: float  # of the power of what is left in held-out speed, beyond the sensor's
    significance: float  # [nat] log likelihood ratio on held-out motion

    @property
    def certain(self) -> bool:
        """Whether it is there, and more than a sensor's pattern."""
        return self.significance > CERTAIN and self.share > LEAST_SHARE


@dataclass(frozen=True)
class Rest:
    """What a model leaves in one recording, with the motion's history; masks of shape (I,)."""

    errors: ErrorData
    history: MotionHistory
    simulated: Callable[[], MotionHistory]  # with the model's speeds, which no random torque is in
    learnt: Bools  # intervals that curves may be learnt on
    judged: Bools  # others, that they are judged by
    slot: float = 0.0  # [rad] of the encoder's disc; 0 where there is none

    @property
    def speeds(self) -> Floats:
        """[rad/s] simulated less measured mean speed."""
        return np.asarray(self.errors.increments / self.errors.duration)


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
        share = one.share * (OF_TIME if one.variable in OF_ONE_RECORDING else 1.0)
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
    gain, explained = told.gain, told.before - told.after
    if name == OVER_THE_DISC:
        disc = _predict(name, [make_up_disc(rest, model) for rest in rests], reach, model, lag)
        gain -= max(disc.gain, 0.0)
        explained -= max(disc.before - disc.after, 0.0)
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


def make_up_disc(rest: Rest, model: ErrorModel) -> Rest:
    """Make up what a disc leaves that is as irregular as a model's, and as eccentric as chance may have it at most."""
    errors, history = rest.errors, rest.history
    if rest.slot == 0.0:
        return replace(rest, errors=replace(errors, increments=np.zeros_like(errors.increments)))
    count = max(round(tau / rest.slot), 1)
    flanks = model.share * errors.unit * np.random.default_rng(0).standard_normal(count)
    ends = np.append(history.angle, history.angle[-1:])  # to half a segment
    wave = bound_chance_eccentricity(rest.slot, model.share) * errors.unit / rest.slot * np.sin(ends)
    error = flanks[np.rint(ends / rest.slot).astype(np.int64) % count] + wave
    return replace(rest, errors=replace(errors, increments=error[history.at_end] - error[history.at_start]))


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


def find_lines(rests: Sequence[Rest], model: ErrorModel, lag: Lag) -> tuple[float, ...]:
    """Find the frequencies [Hz] of a load, or a supply, that is periodic in time: lines in the residual's spectrum.

    The white residual is summed into even bins of time, as it is and times the command, and both are transformed.
    """
    longest = max(float(rest.history.time[-1]) for rest in rests)
    step = float(np.median(np.concatenate([rest.errors.duration for rest in rests])))
    bins = int(min(max(longest / step, 64), SMOOTHED))
    power: Floats = np.zeros(bins + 1)
    for rest in rests:
        used = rest.learnt & ~rest.errors.still
        _value, white = rest.errors.whiten(model, lag)
        z = np.clip(white[0, used], -ROBUST, ROBUST)
        middle = np.minimum((rest.history.at_start + rest.history.at_end) // 2, len(rest.history.time) - 1)[used]
        index = np.minimum((rest.history.time[middle] / longest * bins).astype(np.int64), bins - 1)
        command = rest.history.voltage[middle]
        for factor in (np.ones(len(z)), command / (float(np.abs(command).max(initial=0.0)) or 1.0)):
            even = np.bincount(index, factor * z, bins) / max(float(np.sum(factor**2)), 1e-9) ** 0.5
            power = np.maximum(power, np.abs(np.fft.rfft(even, 2 * bins)) ** 2)
    frequency = np.fft.rfftfreq(2 * bins, longest / bins)
    power = np.where(frequency * longest < 2.0, 0.0, power)  # slower is what changes over time
    chosen: list[float] = []
    for k in np.argsort(-power):
        if all(abs(frequency[k] - line) * longest > 1.5 for line in chosen):
            chosen.append(float(frequency[k]))
        if len(chosen) == LINES:
            break
    return tuple(chosen)
