"""A model says what it leaves: noise, what lasts, and what no curve predicts of it."""

from dataclasses import replace
from math import exp
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from diagnosed import fitted
from stub_models import FLOOR, stub_model

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import validate_model
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.noise.error_model import ErrorModel, Lag


@pytest.mark.parametrize(("times", "above"), [(0.999, False), (1.001, True)])
def test_what_a_model_leaves_is_beside_the_floor(times: float, above: bool) -> None:
    model = stub_model(times * thresholds.EXPLAINED_GAP * FLOOR, 0.0)
    assert model.above_floor is above and model.at_floor is not above and model.complete is not above


def test_of_the_gap_is_unpredictable_what_no_curve_predicts_but_never_less_than_the_floor() -> None:
    structured = stub_model(5.0, 0.0)
    assert structured.unpredictable_gap == FLOOR and not structured.complete  # all of it is structure
    random = replace(structured, random=True)
    assert random.unpredictable_gap == random.held.gap == pytest.approx(5.0) and random.complete


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


def judged(ratio: float, duration: float, judged_share: float = 1.0) -> Any:
    """What a model's randomness is told from: 100 intervals of a duration [s] in 25 s, beside a torque of 0.5 s."""
    time = np.linspace(0.0, 25.0, 101)
    data = SimpleNamespace(time=time, duration=np.full(100, duration))
    held = SimpleNamespace(intervals=(data,), scored=(np.arange(100) < 100 * judged_share,), gap=ratio)
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
