"""The torque that a model lacks, held against the plant's."""

import re

import numpy as np
from diagnosed import held_with_true_gains

from motor_identification.discrepancy.missing_torque import MissingTorque, describe_torque, estimate_missing_torque
from motor_identification.recording import Floats
from motor_identification.validation.held_out import HeldOut

FRICTION = {"ks": 0.4}
STEP = {"step_voltage": 0.5, "step_time": 11.0}


def shape(one: HeldOut, axis: str) -> MissingTorque:
    return next(each for each in estimate_missing_torque(one) if each.axis == axis)


def within(one: MissingTorque, truth: Floats, which: Floats) -> None:
    """Known bins are within 3 % of 0.4 V, or 4 standard errors, of the truth."""
    known = np.isfinite(one.torque) & which.astype(bool)
    assert np.sum(known) >= 10
    off = np.abs(one.torque - truth)[known]
    assert np.all(off < np.maximum(0.012, 4.0 * one.error[known]))
    assert np.median(off) < 0.01


def test_missing_friction_has_the_shape_of_friction() -> None:
    one = shape(held_with_true_gains(**FRICTION), "speed")
    middle = 0.5 * (one.edges[1:] + one.edges[:-1])
    within(one, 0.4 * np.sign(middle), np.abs(middle) > 10.0)
    words = describe_torque(estimate_missing_torque(held_with_true_gains(**FRICTION)))
    found = re.fullmatch(r"Residual torque over the speed: (-[\d.]+) to ([\d.]+) V, largest near .*rad/s\.", words)
    assert found and -0.5 < float(found[1]) < -0.38 and 0.38 < float(found[2]) < 0.5


def test_a_missing_load_step_has_its_size_and_time() -> None:
    one = shape(held_with_true_gains(**STEP), "time")
    before, after = one.edges[1:] < 10.9, one.edges[:-1] > 11.1
    within(one, np.where(after, 0.5, 0.0), before | after)


def test_nothing_is_left_of_a_complete_model() -> None:
    assert describe_torque(estimate_missing_torque(held_with_true_gains())) == ""
