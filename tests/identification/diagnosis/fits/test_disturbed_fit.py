"""Generalised least squares beside a random torque: white residuals, and less scatter than mean speeds have."""

from functools import cache

import numpy as np
import pytest
from plant import profiles, record
from tiers import keep_fast

from motor_identification.diagnosis.candidate_model import learn_errors
from motor_identification.diagnosis.fits.disturbed_fit import (
    fit_beside_torque,
    make_disturbed_residuals,
    whiten_beside_torque,
)
from motor_identification.estimation.direction_correction import correct_directions
from motor_identification.estimation.estimate import Estimate
from motor_identification.estimation.least_squares import fit_speeds
from motor_identification.estimation.problem import make_problem
from motor_identification.estimation.whitened_fit import fit_whitened
from motor_identification.recording import check
from motor_identification.uncertainty.standard_errors import estimate_uncertainty
from motor_model.parameters import PAPER_KA, PAPER_KV

TRUE = {"kv": PAPER_KV, "ka": PAPER_KA}


@cache
def fits(seed: int) -> tuple[Estimate, Estimate]:
    """By mean speeds as they are, and beside the torque that is learned from what that leaves."""
    torque = {"random_torque": 0.15, "random_torque_time": 0.05, "random_torque_seed": seed}
    recording = check(record(TRUE | torque, *profiles.compact(12.0, seed), seed=seed)[0])
    ordinary = fit_speeds(Estimate(make_problem([recording], ()), np.log([PAPER_KV, PAPER_KA])))
    ordinary = fit_speeds(correct_directions(ordinary))
    return ordinary, fit_beside_torque(ordinary, learn_errors(ordinary))


def test_residuals_are_white_and_of_unit_variance() -> None:
    _ordinary, disturbed = fits(1)
    errors = learn_errors(disturbed)
    assert 0.12 < errors.rms_voltage < 0.18
    white = make_disturbed_residuals(disturbed, errors).residuals(disturbed.theta)
    assert 0.95 < np.std(white) < 1.05
    assert abs(np.mean(white[1:] * white[:-1])) < 0.05
    speeds = disturbed.problem.residuals(disturbed.theta)
    assert np.mean(speeds[1:] * speeds[:-1]) > 0.5 * np.mean(speeds**2)  # mean speeds themselves err alike


@pytest.mark.slow
def test_it_scatters_less_than_least_squares_of_mean_speeds() -> None:
    true = np.log([PAPER_KV, PAPER_KA])
    ordinary, disturbed = (
        np.array([fit.theta - true for fit in row]) for row in zip(*map(fits, range(6)), strict=True)
    )
    assert np.sqrt(np.mean(disturbed[:, 1] ** 2)) < 0.7 * np.sqrt(np.mean(ordinary[:, 1] ** 2))
    assert np.abs(disturbed).max() < 0.02


def test_the_derivative_is_that_of_the_residuals() -> None:
    _ordinary, disturbed = fits(2)
    target = make_disturbed_residuals(disturbed, learn_errors(disturbed))
    step = 1e-5
    for i, column in enumerate(target.jacobian(disturbed.theta).T):
        moved = disturbed.theta + step * np.eye(len(disturbed.theta))[i]
        difference = (target.residuals(moved) - target.residuals(disturbed.theta)) / step
        assert np.allclose(column, difference, rtol=1e-2, atol=1e-2 * np.abs(column).max())


@pytest.mark.parametrize("seed", keep_fast(range(6), 1))
def test_what_is_whitened_beside_it_stays_so_and_is_not_what_is_without(seed: int) -> None:
    _ordinary, disturbed = fits(seed)
    fit = whiten_beside_torque(disturbed, learn_errors(disturbed))
    assert np.array_equal(fit.theta, disturbed.theta)
    beside, alone = fit.residuals.on(fit.problem), fit_whitened(disturbed).residuals.on(fit.problem)
    assert np.array_equal(beside.residuals(fit.theta), fit.residuals.residuals(fit.theta))
    assert not np.allclose(alone.residuals(fit.theta)[:100], fit.residuals.residuals(fit.theta)[:100])
    assert 0.95 < np.std(fit.residuals.residuals(fit.theta)) < 1.05


@pytest.mark.slow
def test_its_standard_errors_are_what_it_scatters_by() -> None:
    off, said = [], []
    for seed in range(6):
        _ordinary, disturbed = fits(seed)
        fit = whiten_beside_torque(disturbed, learn_errors(disturbed))
        said.append(estimate_uncertainty(fit, fit.residuals.jacobian(fit.theta)).errors)
        off.append(disturbed.theta - np.log([PAPER_KV, PAPER_KA]))
    ratio = np.sqrt(np.mean(np.square(off), axis=0) / np.mean(np.square(said), axis=0))
    assert np.all((ratio > 0.4) & (ratio < 1.8))
