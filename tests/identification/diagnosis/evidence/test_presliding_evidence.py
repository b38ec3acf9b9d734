"""A friction that builds up after a reversal is told from a backlash by the motion that both were fitted to."""

from dataclasses import replace
from functools import cache

import pytest
from plant import profiles, record
from stand_ins import is_taken_back, select_beside_friction

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model
from motor_identification.diagnosis.evidence.presliding_evidence import _list_rests, _score_refitted, find_presliding
from motor_identification.diagnosis.selection.backward_elimination import eliminate_backward
from motor_identification.diagnosis.selection.selection import Selection
from motor_identification.noise.error_data import log_likelihood
from motor_identification.noise.error_model import ErrorModel
from motor_identification.progress import ProgressReporter
from motor_identification.recording import check

SILENT = ProgressReporter(lambda stage: None, lambda: False)
PRESLIDING = {"ks": 0.4, "presliding_angle": 0.4}
BACKLASH = {"ks": 0.4, "backlash_angle": 0.3, "load_fraction": 0.5}


@cache
def selected(hidden: str) -> Selection:
    """What is found of a motor with a friction beside a random torque: a backlash."""
    values = {"presliding": PRESLIDING, "backlash": BACKLASH}[hidden]
    motor = {"kv": 0.07, "ka": 0.0055, "random_torque": 0.1, "random_torque_time": 0.05, "random_torque_seed": 3.0}
    recording = check(
        record(motor | values, *profiles.random(12.0, 12.0, 3), seed=3, irregularity=0.005, disc_seed=3)[0]
    )
    return select_beside_friction(recording, "backlash")


def fitted(hidden: str) -> tuple[Model, Model]:
    """The models without and with the backlash."""
    (step,) = selected(hidden).steps
    return step.before, step.found.model


@pytest.mark.parametrize(("hidden", "stands_in"), [("presliding", True), ("backlash", False)])
def test_a_backlash_stands_in_for_a_friction_that_builds_up(hidden: str, stands_in: bool) -> None:
    found = find_presliding(*fitted(hidden))
    assert (found is not None) is stands_in
    if found is not None:
        assert (
            found.variable == "past"
            and "after every reversal" in found.cause
            and found.certain
            and 0.5 < found.share < 0.9
            and 100.0 < found.significance < 150.0
        )


@pytest.mark.parametrize(("hidden", "low", "high"), [("presliding", 0.8, 2.0), ("backlash", -0.2, 0.2)])
def test_the_limit_lies_far_from_both(monkeypatch: pytest.MonkeyPatch, hidden: str, low: float, high: float) -> None:
    """What the friction gains, over what the backlash does: the limit of 0.4 is far from either."""
    for limit, stands_in in ((low, True), (high, False)):
        monkeypatch.setattr(thresholds, "PRESLIDING_SHARE", limit)
        assert (find_presliding(*fitted(hidden)) is not None) is stands_in


@pytest.mark.parametrize("hidden", ["presliding", "backlash"])
def test_elimination_takes_a_stand_in_back_and_leaves_it_unexplained(hidden: str) -> None:
    left = eliminate_backward(selected(hidden), SILENT)
    assert is_taken_back(left) is (hidden == "presliding")


def test_both_are_judged_beside_the_torque_that_is_there() -> None:
    without, model = fitted("backlash")
    assert model.beside_torque and without.beside_torque and model.likelihood > without.likelihood + 50.0


def test_a_model_is_judged_by_errors_that_are_learned_of_it() -> None:
    """Those of one at the sensor's floor are the sensor's: by these a backlash was less likely than nothing by 123."""
    without, current = fitted("backlash")
    at_floor = replace(current, learned=ErrorModel(0.0, 0.0, 0.0, 1.0))
    rests = _list_rests(at_floor)
    before = _score_refitted(without, _list_rests(without))
    assert log_likelihood([errors for errors, _ in rests], at_floor.errors, at_floor.lag) < before
    assert _score_refitted(at_floor, rests) > before + 100.0 and find_presliding(without, at_floor) is None
