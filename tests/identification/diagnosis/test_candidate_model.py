"""A model says what it leaves: noise, what lasts, and what no curve predicts of it."""

from dataclasses import replace
from functools import cache
from math import exp
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from diagnosed import fitted
from plant import profiles, record
from stub_models import FLOOR, stub_model

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.selection.selection import begin_beside_torque
from motor_identification.diagnosis.start import fit_known
from motor_identification.estimation.request import Request
from motor_identification.noise.error_model import ErrorModel, Lag
from motor_identification.recording import check
from motor_identification.validation.hold_out import make_hold_out


@pytest.mark.parametrize(("times", "above"), [(0.999, False), (1.001, True)])
def test_what_a_model_leaves_is_beside_the_floor(times: float, above: bool) -> None:
    model = stub_model(times * thresholds.EXPLAINED_GAP * FLOOR, 0.0)
    assert model.above_floor is above and model.at_floor is not above and model.complete is not above


def test_of_the_gap_is_unpredictable_what_no_curve_predicts_but_never_less_than_the_floor() -> None:
    structured = stub_model(5.0, 0.0)
    assert structured.unpredictable_gap == FLOOR and not structured.complete  # all of it is structure
    random = replace(structured, random=True)
    assert random.unpredictable_gap == random.held.gap == pytest.approx(5.0) and random.complete


@pytest.mark.parametrize(
    ("volts", "time", "tossed"), [(0.51, 0.01, True), (0.49, 0.01, False), (0.51, 0.009, False), (0.0, 0.01, False)]
)
def test_a_torque_of_a_twentieth_of_the_voltage_is_more_than_gears_make(
    volts: float, time: float, tossed: bool
) -> None:
    recording = SimpleNamespace(voltage=np.array([-10.0, 4.0]), info=SimpleNamespace(sample_period=0.01))
    errors = ErrorModel(0.0, 0.0, volts, time)
    model = SimpleNamespace(held=SimpleNamespace(recordings=(recording,)), errors=errors)
    assert Model.is_tossed.fget(model) is tossed  # type: ignore[attr-defined]


def test_a_complete_model_leaves_the_sensors_noise_and_no_structure() -> None:
    estimate, hold_out = fitted()
    model = validate_model(hold_out, estimate)
    assert model.structure == () and model.errors.share == model.noise.share and not model.errors.rms_voltage
    assert model.noise_floor == pytest.approx(model.sensor_floor) and model.sensor_floor == pytest.approx(model.floor)
    lacking, other = fitted(ks=0.4)
    wrong = validate_model(other, lacking)
    assert wrong.structure[0].certain and wrong.structure[0].share > 0.5 and wrong.errors.rms_voltage > 0.01
    assert wrong.floor < wrong.sensor_floor < 0.2 * wrong.noise_floor  # friction passes for a torque rather than slots
    scatter = wrong.scatter_of_travel()
    assert all(np.all(part > 0.0) for part in scatter) and len(scatter) == len(wrong.held.intervals)


@cache
def beside_slow_torque(*effects: str) -> Model:
    """A motor with a friction, beside a random torque that is as slow as it is."""
    motor = {"kv": 0.07, "ka": 0.0105, "ks": 0.5}
    torque = {"random_torque": 0.2, "random_torque_time": 0.2, "random_torque_seed": 1.0}
    recording = check(record(motor | torque, *profiles.random(10.0, 14.0, 1), seed=1)[0])
    known, _search = fit_known([recording], Request(effects=effects), make_hold_out([recording], []))
    return begin_beside_torque(known.model, known.hold_out, 1).model


def test_a_fit_that_knows_of_a_slow_torque_tells_more_than_encoders() -> None:
    model = beside_slow_torque("coulomb_friction")
    assert model.complete and model.told_beside_torque is not None
    fit, uncertainty = model.told_beside_torque
    assert abs(fit.theta[2] - 0.5) < 0.02
    assert 0.1 < uncertainty.errors[2] / model.uncertainty.errors[2] < 0.25
    assert 0.05 < uncertainty.errors[1] / model.uncertainty.errors[1] < 0.2  # of ka


def test_where_more_is_left_no_torque_is_known() -> None:
    model = beside_slow_torque()
    assert not model.complete and model.learned is not None and model.told_beside_torque is None
    random = beside_slow_torque("coulomb_friction")
    assert random.learned is not None
    for errors in (None, replace(random.learned, rms_voltage=0.0)):
        assert replace(random, learned=errors).told_beside_torque is None


def judged(ratio: float, duration: float, judged_share: float = 1.0, calm: float | None = None) -> Any:
    """What a model's randomness is told from: 100 intervals of a duration [s] in 25 s, beside a torque of 0.5 s."""
    time = np.linspace(0.0, 25.0, 101)
    data = SimpleNamespace(time=time, duration=np.full(100, duration))
    scored = (np.arange(100) < 100 * judged_share,)
    held = SimpleNamespace(intervals=(data,), scored=scored, gap=ratio, find_calm_gap=lambda wild: calm or ratio)
    return SimpleNamespace(errors=ErrorModel(0.0, 0.0, 0.1, 0.4), lag=Lag(10.0, 1.0), held=held, noise_floor=1.0)


@pytest.mark.parametrize("duration", [0.25, 1e-9])  # [s] intervals, or speeds of instants
@pytest.mark.parametrize(("low", "side"), [(True, 1.001), (True, 0.999), (False, 1.001), (False, 0.999)])
def test_a_torque_leaves_about_as_much_as_it_has_samples_to(duration: float, low: bool, side: float) -> None:
    """Of 0.5 s in 25 s: a tenth is the standard deviation of the RMS of fifty independent samples."""
    chance = exp(thresholds.RANDOM_SIGMA * 0.1)
    assert 1.2 < chance < thresholds.MOST_CHANCE
    limit = thresholds.RANDOM_GAP[0] / chance if low else thresholds.RANDOM_GAP[1] * chance
    assert Model.is_random.fget(judged(limit * side, duration)) is ((side > 1.0) is low)  # type: ignore[attr-defined]


@pytest.mark.parametrize(("share", "random"), [(1.0, False), (0.5, True)])
def test_fewer_seconds_that_are_judged_leave_more_to_chance(share: float, random: bool) -> None:
    limit = thresholds.RANDOM_GAP[1] * exp(thresholds.RANDOM_SIGMA * 0.12)
    assert Model.is_random.fget(judged(limit, 0.25, share)) is random  # type: ignore[attr-defined]


@pytest.mark.parametrize(("side", "random"), [(0.999, True), (1.001, False)])
def test_bumps_now_and_then_are_random_beside_a_calm_torque(side: float, random: bool) -> None:
    limit = thresholds.RANDOM_GAP[1] * exp(thresholds.RANDOM_SIGMA * 0.1)
    bumps = judged(9.0, 0.25, calm=limit * side)
    assert Model.is_random.fget(bumps) is random  # type: ignore[attr-defined]
