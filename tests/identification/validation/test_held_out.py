"""Held-out motion is judged by a mixture of drifts: what nobody could predict in one place refutes no model."""

from dataclasses import replace
from math import exp, log

import numpy as np
import pytest
from diagnosed import fitted, held
from stub_models import stub_held

from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.measurement.edit_intervals import exclude_intervals
from motor_identification.noise.likelihood import Noise, log_likelihood
from motor_identification.validation.held_out import UNFORESEEN_DRIFTS, HeldOut


def alone(one: HeldOut, noise: Noise) -> float:
    """Under one drift."""
    rows = zip(one.intervals, one.increments, one.scored, strict=True)
    return sum(log_likelihood(exclude_intervals(data, ~scored), part[scored], noise) for data, part, scored in rows)


@pytest.mark.parametrize("ks", [0.0, 0.4])
def test_half_of_the_chances_are_the_training_datas_drift(ks: float) -> None:
    one, noise = held(ks=ks), Noise(0.003, 0.0)
    slot = one.intervals[0].slot
    own = alone(one, noise)
    larger = [alone(one, replace(noise, drift=share * slot**2)) for share in UNFORESEEN_DRIFTS]
    best = max(own, *larger)
    mixed = 0.5 * exp(own - best) + 0.5 * np.mean([exp(value - best) for value in larger])
    assert one.log_likelihood(noise) == pytest.approx(best + log(mixed), abs=1e-6)
    assert (best == own) == (ks == 0.0)  # friction that the model lacks makes it drift
    assert best - log(2 * len(UNFORESEEN_DRIFTS)) <= one.log_likelihood(noise) <= best


def test_a_drift_beyond_all_others_is_the_only_one() -> None:
    one = held(ks=0.4)
    noise = Noise(0.003, 2.0 * max(UNFORESEEN_DRIFTS) * one.intervals[0].slot ** 2)
    assert one.log_likelihood(noise) == alone(one, noise)


def test_a_moment_that_nobody_could_predict_refutes_no_complete_model() -> None:
    """For a second of the motion to judge by, the angle drifts as it never did in the training data."""
    estimate, hold_out = fitted()
    (data,) = hold_out.problem.intervals
    moment = (data.time[data.first] > 5.0) & (data.time[data.first] < 6.0)
    random = np.random.default_rng(1).normal(size=len(moment)) * moment
    drift = replace(data, speed=data.speed + random * np.sqrt(5e-5 / data.duration))
    hold_out = replace(hold_out, problem=replace(hold_out.problem, intervals=(drift,)))
    off = replace(estimate, theta=estimate.theta + np.array([1e-4, 0.0]))
    complete, wrong = validate_model(hold_out, estimate), validate_model(hold_out, off)
    assert complete.noise.drift < 1e-3 * wrong.noise.drift  # in the training data
    assert alone(complete.held, complete.noise) < alone(wrong.held, wrong.noise) - 100.0
    assert complete.likelihood > wrong.likelihood + 100.0


def test_where_there_are_no_slots_what_blurs_the_angle_is_the_measure() -> None:
    """Counts that are read at samples have no slots, and drift as much as edges do."""
    one = held(ks=0.4)
    blurred = replace(
        one, intervals=tuple(replace(data, slot=0.0, blur=np.full_like(data.blur, 0.02)) for data in one.intervals)
    )
    noise = Noise(0.0, 0.0)
    larger = [alone(blurred, replace(noise, drift=share * 12.0 * 0.02**2)) for share in UNFORESEEN_DRIFTS]
    own = alone(blurred, noise)
    best = max(own, *larger)
    mixed = 0.5 * exp(own - best) + 0.5 * np.mean([exp(value - best) for value in larger])
    assert best > own and blurred.log_likelihood(noise) == pytest.approx(best + log(mixed), abs=1e-6)


@pytest.mark.parametrize("wild", [0.1, 0.25])
def test_a_calm_gap_is_that_of_all_but_the_worst_of_the_time(wild: float) -> None:
    steady = stub_held(2.0)  # 40 intervals as long
    (angle,), bumps = steady.angles, np.zeros(41)
    bumps[1:5] = 1.0  # [rad] in a tenth of them
    bumpy = replace(steady, angles=(angle + np.cumsum(bumps),))
    assert bumpy.gap > 4.0 and bumpy.find_calm_gap(wild) == pytest.approx(2.0)
    assert 2.5 < bumpy.find_calm_gap(0.05) < bumpy.find_calm_gap(0.0) == pytest.approx(bumpy.gap, rel=0.05)


def test_speeds_whose_noise_was_assumed_have_a_share_of_it_and_no_more_than_is_left() -> None:
    one = held(ks=0.4)
    noise, more = 2.0 * one.gap, {"independent": True, "window": 1.0, "noise": 1.0}
    speeds = tuple(
        replace(data, **more, slack=0.0 * data.slack, blur=noise * data.duration / np.sqrt(2.0))
        for data in one.intervals
    )
    logged = replace(one, intervals=speeds)
    assert logged.floor(0.0) == pytest.approx(noise)
    assert logged.with_noise(0.3).floor(0.0) == pytest.approx(0.3 * noise)
    assert logged.with_noise(0.3).with_noise(1.0).floor(0.0) == pytest.approx(noise)
    assert logged.measure_noise() == pytest.approx(np.sqrt(np.mean(logged.residuals**2)) / noise)
    assert logged.with_noise(0.3).measure_noise() == pytest.approx(logged.measure_noise())
    assert one.measure_noise() == 1.0 and one.with_noise(0.3).floor(0.0) == one.floor(0.0)
