"""A model says what it leaves: noise, what lasts, and what no curve predicts of it."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosed import fitted
from stub_models import FLOOR, stub_model

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_fit import validate_model


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
