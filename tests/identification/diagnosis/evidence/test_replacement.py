"""What is tried in the place of an effect: when it is better, which of several, and what it loses."""

from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from stub_models import rescored, stub_model, stub_test

from motor_identification.diagnosis import candidate_test, thresholds
from motor_identification.diagnosis.candidate_model import Model, Score
from motor_identification.diagnosis.candidate_test import CandidateTest
from motor_identification.diagnosis.evidence import replacement as module
from motor_identification.diagnosis.evidence.replacement import choose_better, find_loss, is_better
from motor_identification.recording import Floats

BELOW, ABOVE = 0.999, 1.001


def test_of_what_is_as_much_better_the_most_common_replaces_a_finding() -> None:
    current = stub_model(1.0, 0.0, likelihood=-500.0)
    before = stub_model(2.0, 0.0, likelihood=-600.0)

    def better(name: str, evidence: float) -> CandidateTest:
        return CandidateTest(name, before, stub_model(1.1, 0.0, likelihood=-600.0 + evidence))  # another motion

    zone, friction = better("dead_zone", 110.0), better("coulomb_friction", 110.0 - 0.9 * thresholds.TIE_LIKELIHOOD)
    assert choose_better([zone, friction], "load_step", current) is friction
    behind = better("coulomb_friction", 110.0 - 1.1 * thresholds.TIE_LIKELIHOOD)
    assert choose_better([zone, behind], "load_step", current) is zone
    assert choose_better([better("dead_zone", 1.0)], "load_step", current) is None


@pytest.mark.parametrize(
    ("instead", "effect", "margin"),
    [
        ("load_bias", "dead_zone", thresholds.RIVAL_MARGIN),  # as many parameters: it has to be the better one
        ("load_step", "dead_zone", thresholds.RIVAL_MARGIN),
        ("dead_zone", "load_step", -thresholds.RIVAL_MARGIN),  # fewer: it may be a little less likely
    ],
)
def test_what_replaces_a_finding(instead: str, effect: str, margin: float) -> None:
    current = stub_model(1.0, 0.0, likelihood=-500.0)
    for shift, better in ((-0.01, False), (0.01, True)):
        model = stub_model(1.1, 0.0, likelihood=-500.0 + margin + shift)  # another motion
        assert is_better(CandidateTest(instead, current, model), effect, current) is better


@pytest.mark.parametrize(("times", "better"), [(BELOW, True), (ABOVE, False)])
def test_a_load_from_the_first_instant_on_is_a_constant_one(times: float, better: bool) -> None:
    step = stub_model(2.0, likelihood=170.0)
    (angle,) = step.held.angles
    (data,) = step.held.intervals
    apart = times * thresholds.SAME_MOTION * step.floor * np.append(0.0, np.cumsum(data.duration))
    test = stub_test("load_bias", stub_model(9.0), 2.0, 100.0)
    moved = replace(step, held=replace(step.held, angles=(angle + apart,)))
    alike = replace(test, model=rescored(moved, likelihood=0.0))
    assert is_better(alike, "load_step", step) is better
    assert not is_better(alike, "coulomb_friction", step)  # no simpler than it is


@pytest.mark.parametrize(("times", "few"), [(BELOW, True), (ABOVE, False)])
def test_a_few_moments_count_where_what_replaces_predicts_worse(times: float, few: bool) -> None:
    """A slow torque does in one moment what a load step does, but does not predict it."""
    moments = np.zeros(60)
    moments[7] = 100.0

    def model(gap: float, likelihood: float, moments: Floats) -> Model:
        held, score = SimpleNamespace(gap=gap), Score(likelihood, moments=moments)
        return cast(Model, SimpleNamespace(likelihood=likelihood, held=held, score=score, beside_torque=True))

    current = model(1.0, 100.0, moments)
    test = CandidateTest("load_bias", current, model(times * thresholds.WORSE_GAP, 0.0, np.zeros(60)))
    assert find_loss(test, current, "quadratic_drag") == (0.0 if few else 100.0)


def make_few_moments() -> tuple[Model, Model]:
    """A model that is likelier by 90 in three moments, and the other one, both beside a torque."""
    moments = np.zeros(60)
    moments[[7, 20, 41]] = 30.0

    def model(likelihood: float, moments: Floats) -> Model:
        score = Score(likelihood, moments=moments)
        one = SimpleNamespace(likelihood=likelihood, held=SimpleNamespace(gap=1.0), score=score, beside_torque=True)
        return cast(Model, one)

    return model(90.0, moments), model(0.0, np.zeros(60))


@pytest.mark.parametrize(
    ("effect", "held", "loss"),
    [
        ("static_friction", True, 60.0),  # but for the best of the three in which it speaks
        ("static_friction", False, 0.0),  # the motor never stood under a voltage
        ("quadratic_drag", True, 0.0),
        ("transport_delay", False, 60.0),  # which speaks where the command changes
    ],
)
def test_what_holds_a_motor_speaks_in_few_moments(
    monkeypatch: pytest.MonkeyPatch, effect: str, held: bool, loss: float
) -> None:
    """A breakaway beside a coasting bridge, likelier by 82 in six of 120 moments, gave way to a load of 3 mV."""
    current, load = make_few_moments()
    monkeypatch.setattr(candidate_test, "was_held", lambda one: held and one is current)
    test = CandidateTest("load_bias", current, load)
    assert find_loss(test, current, effect) == loss


@pytest.mark.parametrize(("effect", "better"), [("static_friction", False), ("backlash", True)])
def test_a_load_is_no_better_than_what_holds_a_motor_in_few_moments(
    monkeypatch: pytest.MonkeyPatch, effect: str, better: bool
) -> None:
    current, load = make_few_moments()
    monkeypatch.setattr(candidate_test, "was_held", lambda one: True)
    monkeypatch.setattr(module, "is_same_motion", lambda one, other: False)
    assert is_better(CandidateTest("load_bias", current, load), effect, current) is better
