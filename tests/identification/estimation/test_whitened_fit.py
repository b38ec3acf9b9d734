"""Whitened residuals of the truth are white; a fit of them leaves out what no noise explains, if it is little."""

from dataclasses import replace

import numpy as np
import pytest
from plant import profiles, record
from small import THETA, TRUE

from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.whitened_fit import (
    MOST_OUTLIERS,
    OUTLIER_SIGMA,
    WhitenedFit,
    fit_whitened,
    learn_encoders,
    make_whitened,
)
from motor_identification.recording import Recording, check

RECORDING = check(record(TRUE, *profiles.staircase(10.0, 3, 0.25), seed=1, irregularity=0.008, disc_seed=2)[0])


def at_truth(recording: Recording = RECORDING) -> Estimate:
    return Estimate(make_problem([recording], ("coulomb_friction",)), THETA)


def spoilt(count: int, size: float) -> Estimate:
    """The truth, with some intervals' travel off by so many radians."""
    estimate = at_truth()
    (data,) = estimate.problem.intervals
    wrong = np.zeros(len(data.speed))
    moving = np.flatnonzero(data.slack == 0.0)
    wrong[moving[:: len(moving) // count][:count]] = size
    return estimate.on(estimate.problem.with_intervals((replace(data, speed=data.speed + wrong / data.duration),)))


def test_the_disc_is_learned_and_the_rest_is_white() -> None:
    whitened = make_whitened(at_truth())
    (encoder,) = whitened.residuals.encoders
    assert encoder.irregularity == pytest.approx(0.008, rel=0.2) and encoder.drift < 1e-9
    white = whitened.residuals.residuals(THETA)
    assert 0.8 < np.sqrt(np.mean(white**2)) < 1.1
    assert 0.8 < whitened.residuals.noise_floor / np.sqrt(whitened.estimate.cost) < 1.2


def test_a_wrong_motor_drifts() -> None:
    (encoder,) = learn_encoders(Estimate(at_truth().problem, THETA + [0.02, 0.0, 0.0]))
    assert encoder.drift > 1e-5


def test_the_jacobian_is_whitened_column_by_column() -> None:
    residuals = make_whitened(at_truth()).residuals
    plain = residuals.problem.jacobian(THETA)
    white = residuals.jacobian(THETA)
    for column, expected in zip(white.T, plain.T, strict=True):
        assert column == pytest.approx(residuals.white(expected))


def test_white_residuals_are_worth_more_than_speeds() -> None:
    start = replace(at_truth(), theta=THETA + [0.01, -0.01, 0.02])
    speeds = fit_speeds(start)
    white = fit_whitened(speeds).theta
    assert np.abs(white[0] - THETA[0]) < 0.2 * np.abs(speeds.theta[0] - THETA[0]) < 1e-3


@pytest.mark.parametrize(("times", "marked"), [(0.6, False), (2.0, True)])
def test_an_outlier_is_beyond_all_noise(times: float, marked: bool) -> None:
    """One wrong stamp, so many standard deviations of the angle; the encoder is that of the clean recording."""
    clean = make_whitened(at_truth())
    (data,) = clean.problem.intervals
    k = len(data.speed) // 3
    assert not data.fresh[k + 1]
    wrong = np.zeros(len(data.speed))
    wrong[[k, k + 1]] = np.array([1.0, -1.0]) * times * OUTLIER_SIGMA / clean.residuals.encoders[0].whitening.scale[k]
    later = replace(data, speed=data.speed + wrong / data.duration)
    fit = WhitenedFit(clean.estimate.on(clean.problem.with_intervals((later,))), clean.residuals)
    (marks,) = fit.find_outliers()
    assert np.flatnonzero(marks).tolist() == ([k] if marked else [])


@pytest.mark.parametrize(("share", "few"), [(0.4, True), (4.0, False)])
def test_many_outliers_are_a_wrong_model(share: float, few: bool) -> None:
    estimate = at_truth()
    count = max(int(share * MOST_OUTLIERS * len(estimate.problem.weight)), 1)
    fit = fit_whitened(spoilt(count, 0.05))
    left_out = len(estimate.problem.weight) - len(fit.problem.weight)
    assert (left_out > 0) == few
