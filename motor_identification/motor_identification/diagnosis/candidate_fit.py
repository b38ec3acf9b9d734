"""Fit candidate models and validate them on held-out data, beside a random torque where there is one."""

from dataclasses import replace

import numpy as np

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model, Score
from motor_identification.diagnosis.candidate_test import likelihood_threshold
from motor_identification.diagnosis.evidence.torque_evidence import (
    compute_price,
    mark_common_set,
    score_held_out,
    score_training,
)
from motor_identification.diagnosis.fits.disturbed_fit import fit_beside_torque, list_error_data
from motor_identification.diagnosis.fits.effect_fit import drop_effect, make_target
from motor_identification.diagnosis.fits.starts import list_starts, start_with
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.kv_split import can_split_kv, fit_split_kv, is_split_of_motor
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.speed_noise import measure_noise, set_noise
from motor_identification.noise.error_model import ErrorModel
from motor_identification.noise.gain_learning import learn_errors_of_runs
from motor_identification.noise.likelihood import estimate_noise, log_likelihood
from motor_identification.noise.run_gain import price_scatter
from motor_identification.validation.hold_out import HoldOut
from motor_model.effects import EFFECT_BY_NAME, do_split_kv

END_ITERATIONS, END_TOLERANCE = 60, 1e-12


def validate_model(hold_out: HoldOut, estimate: Estimate, like: Model | None = None) -> Model:
    """Validate an estimate on held-out data, under the noise that it leaves in its training data.

    White noise that was assumed of speeds is at most what it leaves there; its floor, at most what it leaves in all.
    like: a similar model; where that is judged beside a random torque, so is this one.
    """
    share = measure_noise(estimate)
    estimate = set_noise(estimate, share)
    held = hold_out.validate(estimate).with_noise(share)
    rows = list(zip(estimate.problem.intervals, estimate.increments, strict=True))
    noise = estimate_noise(rows)
    each = tuple(log_likelihood(data, increments, noise) for data, increments in rows)
    training = sum(each)
    if held.seen:
        score = Score(training - compute_price(estimate), by_recording=each)
    else:
        score = Score(held.log_likelihood(noise), training, each)
    model = Model(estimate, held.with_noise(max(share, held.measure_noise())), noise, score)
    if like is None or not like.beside_torque:
        return model
    return judge_beside_torque(model, hold_out, like.learned, thresholds.CANDIDATE_EVALUATIONS)


def judge_beside_torque(model: Model, hold_out: HoldOut, guess: ErrorModel | None, evaluations: int) -> Model:
    """Judge a model beside a random torque: its errors are learned, from a guess if there is one."""
    rows, lag = list_error_data(model.estimate), model.estimate.lag
    errors = learn_errors_of_runs(rows, lag, guess, evaluations)
    held, training = score_held_out(hold_out, model.held, errors, lag), score_training(model.estimate, rows, errors)
    parts = (training,) if model.held.seen else (held, training)
    score = Score(
        sum(part.likelihood for part in parts) - price_scatter(errors.gain),
        held_out=held.likelihood,
        scored=sum(map(np.count_nonzero, mark_common_set(hold_out))),
        moments=np.concatenate([part.moments for part in parts]),
    )
    return replace(model, learned=errors, score=score)


def refine_beside_torque(model: Model, hold_out: HoldOut, begin: Estimate | None = None) -> Model:
    """Fit a model again beside the torque that it leaves itself, less than was left before, where that is better.

    begin: an estimate of the same effects to fit from, whether or not it splits kv; from where it is, without.
    """
    assert model.learned is not None
    start, problem = model.estimate, model.estimate.problem
    if begin is not None:
        known = begin.problem.unknowns
        start = begin.on(problem.with_effects(known.effects, known.splits_kv))
    plain = validate_model(hold_out, fit_beside_torque(start, model.learned))
    again = judge_beside_torque(plain, hold_out, None, thresholds.FINAL_EVALUATIONS)
    return again if again.likelihood > model.likelihood else model


def fit_again(model: Model, hold_out: HoldOut) -> Model:
    """Fit a model again from where it is, until nothing is gained, and judge it as before."""
    if model.learned is None:
        return validate_model(hold_out, fit_speeds(model.estimate))
    fitted = fit_beside_torque(model.estimate, model.learned, END_ITERATIONS, END_TOLERANCE)
    return judge_beside_torque(validate_model(hold_out, fitted), hold_out, None, thresholds.FINAL_EVALUATIONS)


def fit_in_place(model: Model, effect: str, other: str, hold_out: HoldOut) -> Model:
    """Fit a model again with another effect in the place of one, of the same size to begin with.

    What else it needs begins as for any fit: a static friction has a speed, too, and is above the sliding one.
    """
    bare, size = drop_effect(model.estimate, effect), EFFECT_BY_NAME[effect].parameters[0].name
    larger, own = bare.problem.adding(other), EFFECT_BY_NAME[other].parameters[0]
    usual = list_starts(bare, larger)[0].sizes
    least = 0.0 if own.at_least is None else {**bare.parameters.values, **usual}[own.at_least]
    sizes = {**usual, own.name: least + model.estimate.parameters.value(size)}
    theta = start_with(bare, larger, sizes)
    again = fit_again(validate_model(hold_out, Estimate(larger, theta, bare.simulations), model), hold_out)
    return split_kv(again, hold_out)


def split_kv(model: Model, hold_out: HoldOut) -> Model:
    """Split kv into back-EMF and viscous friction where an effect tells them apart, and unseen data speak for it."""
    estimate = model.estimate
    if not do_split_kv(model.effects) or not can_split_kv(estimate.problem):
        return model
    target = make_target(estimate, model.learned)
    fitted = fit_split_kv(estimate, lambda problem: replace(target, problem=problem))
    split = validate_model(hold_out, fitted, model)
    if split.beside_torque and split.likelihood > model.likelihood:
        split = refine_beside_torque(split, hold_out)
    better = split.likelihood - model.likelihood > likelihood_threshold() and is_split_of_motor(split.estimate)
    return split if better else model


def refit_without(model: Model, effect: str, hold_out: HoldOut) -> Model:
    """Fit a model again without one effect, and without what there is only with it, from where it is.

    Beside a random torque the model is kept as it is without it, where that is likelier: a fit may leave the summit of
    the likelihood that the rest of the model is on. Measured: beside friction and a ripple a warming-up was likelier by
    140; without it, as it was, that model was likelier by 191, and by 83 fitted again.
    """
    begin = drop_effect(model.estimate, effect)
    fitted = fit_speeds(begin) if model.learned is None else fit_beside_torque(begin, model.learned)
    again = validate_model(hold_out, fitted, model)
    if not again.beside_torque:
        return again
    bare = validate_model(hold_out, begin, model)
    return max(refine_beside_torque(again, hold_out), bare, key=lambda one: one.likelihood)
