"""A friction that goes with the angle is told from the torque ripple that stands in for it where a motor turns back."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from plant import record
from stand_ins import is_taken_back, select_beside_friction

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.evidence.angle_evidence import find_angle_friction
from motor_identification.diagnosis.selection.backward_elimination import eliminate_backward
from motor_identification.diagnosis.selection.selection import Selection
from motor_identification.progress import ProgressReporter
from motor_identification.recording import check

SILENT = ProgressReporter(lambda stage: None, lambda: False)
HIDDEN = {
    "friction": {"angle_friction": 0.35},
    "ripple": {"ripple_voltage": 0.35, "ripple_cycles": 1.0, "ripple_phase": 0.4},
}


@cache
def selected(hidden: str) -> Selection:
    """What is found of a motor with a friction beside a random torque: a ripple."""
    motor = {"kv": 0.07, "ka": 0.0055, "ks": 0.4} | HIDDEN[hidden]
    torque = {"random_torque": 0.02, "random_torque_time": 0.05, "random_torque_seed": 3.0}
    levels = np.array([0.0, 4.0, 8.0, 11.0, 0.0, -4.0, -8.0, -11.0, 0.0])  # [V] one way, then back
    time = np.arange(0.0, 9.0, 0.005)
    recording = check(record(motor | torque, time, levels[time.astype(int)], seed=3)[0])
    return select_beside_friction(recording, "torque_ripple")


@pytest.mark.slow
@pytest.mark.parametrize(("hidden", "stands_in"), [("friction", True), ("ripple", False)])
def test_a_ripple_stands_in_for_a_friction_over_the_angle(hidden: str, stands_in: bool) -> None:
    (step,) = selected(hidden).steps
    found = find_angle_friction("torque_ripple", step.before, step.found.model)
    assert (found is not None) is stands_in
    if found is not None:
        assert found.variable == "angle" and found.certain and "tight spot" in found.cause
        assert 0.0 < found.share < 1.0
    assert is_taken_back(eliminate_backward(selected(hidden), SILENT)) is stands_in


def test_it_has_to_gain_more_and_to_be_large_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    (step,) = selected("friction").steps
    found = find_angle_friction("torque_ripple", step.before, step.found.model)
    assert found is not None
    for name, value in (("ANGLE_FRICTION_GAIN", 1.001 * found.significance), ("ANGLE_FRICTION_SIZE", 9.0)):
        with monkeypatch.context() as limited:
            limited.setattr(thresholds, name, value)
            assert find_angle_friction("torque_ripple", step.before, step.found.model) is None
        monkeypatch.setattr(thresholds, name, 0.9 * getattr(thresholds, name))
        assert find_angle_friction("torque_ripple", step.before, step.found.model) is not None


def test_only_ripples_are_judged() -> None:
    (step,) = selected("friction").steps
    assert find_angle_friction("coulomb_friction", step.before, replace(step.found.model)) is None


def test_a_ripple_that_leaves_no_more_than_the_sensor_stands_in_for_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ten waves a turn that a tachogenerator saw, likelier by 1,984, were dropped for a friction."""
    (step,) = selected("friction").steps
    model = step.found.model
    assert model.above_floor and find_angle_friction("torque_ripple", step.before, model) is not None
    monkeypatch.setattr(thresholds, "EXPLAINED_GAP", 1.01 * model.held.gap / model.floor)
    assert find_angle_friction("torque_ripple", step.before, replace(model)) is None
