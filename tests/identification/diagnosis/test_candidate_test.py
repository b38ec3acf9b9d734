"""Whether what an effect takes away is likely and matters, on models of made-up gaps and likelihoods."""

from dataclasses import replace

import numpy as np
import pytest
from stub_models import FLOOR, LASTING_FLOOR, stub_held, stub_model, stub_test

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model, Score
from motor_identification.diagnosis.candidate_test import CandidateTest, likelihood_threshold, share_explained
from motor_identification.noise.error_model import ErrorModel


@pytest.mark.parametrize(("gap", "lasting"), [(3.0, 3.0), (3.0, 1.0), (1.0, 0.0)])
def test_the_stubs_are_what_they_say(gap: float, lasting: float) -> None:
    held = stub_held(gap, lasting)
    assert held.gap == pytest.approx(gap) and held.floor(0.0) == pytest.approx(FLOOR)
    assert held.joined(0.1).gap == pytest.approx(lasting, abs=1e-12)
    assert held.joined(0.1).floor(0.0) == pytest.approx(LASTING_FLOOR)


def test_the_share_explained_is_of_squares_above_the_floor() -> None:
    assert share_explained(5.0, 1.0, 1.0) == pytest.approx(1.0)
    assert share_explained(5.0, 5.0, 1.0) == 0.0
    assert share_explained(5.0, 3.0, 1.0) == pytest.approx(16.0 / 24.0)
    assert share_explained(5.0, 6.0, 1.0) < 0.0
    assert share_explained(0.9, 0.8, 1.0) == 1.0  # nothing was there to explain


def test_evidence_is_the_logarithm_of_a_likelihood_ratio() -> None:
    before = stub_model(5.0, likelihood=-100.0)
    test = stub_test("coulomb_friction", before, 1.0, 30.0)
    assert test.evidence == pytest.approx(30.0) and test.explains == pytest.approx(1.0)


def beside_torque(gap: float, held_out: float, evidence: float = 0.0) -> Model:
    """A model beside a random torque, which 2000 intervals of even moments speak for."""
    errors, moments = ErrorModel(0.0, 0.0, 0.1, 0.1), np.full(200, evidence / 200)
    return replace(stub_model(gap), learned=errors, score=Score(0.0, held_out=held_out, scored=2000, moments=moments))


@pytest.mark.parametrize(
    ("effect", "growth", "said", "relevant"),
    [
        ("coulomb_friction", 1.0, 0.1, True),
        ("coulomb_friction", 1.001, 0.1, False),
        ("coulomb_friction", 0.999 * thresholds.GAP_CHANCE, 1.001 * likelihood_threshold(), True),
        ("coulomb_friction", 0.999 * thresholds.GAP_CHANCE, 0.999 * likelihood_threshold(), False),
        ("coulomb_friction", 1.001 * thresholds.GAP_CHANCE, 100.0, False),  # it fits the torque instead of the motion
        ("torque_ripple", 0.999 * thresholds.GAP_CHANCE, 0.1, True),
        ("torque_ripple", 1.0, -0.1, False),
    ],
)
def test_beside_a_torque_a_gap_may_grow_by_chance_where_held_out_motion_speaks_for_an_effect(
    effect: str, growth: float, said: float, relevant: bool
) -> None:
    before, model = beside_torque(2.0, -100.0), beside_torque(2.0 * growth, -100.0 + said, 60.0)
    assert CandidateTest(effect, before, model).relevant is relevant
