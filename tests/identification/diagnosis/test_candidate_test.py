"""Whether what an effect takes away is likely and matters, on models of made-up gaps and likelihoods."""

import pytest
from stub_models import FLOOR, LASTING_FLOOR, stub_held, stub_model, stub_test

from motor_identification.diagnosis.candidate_test import share_explained


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
