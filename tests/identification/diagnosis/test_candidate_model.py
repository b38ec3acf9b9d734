"""What a candidate model leaves, and whether what an effect takes away matters."""

import numpy as np
import pytest
from diagnosed import fitted
from stub_models import FLOOR, LASTING_FLOOR, stub_held, stub_model, stub_test

from motor_identification.diagnosis.candidate_model import share_explained, validate_model


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


def test_a_models_noise_is_that_of_its_training_data() -> None:
    """The disc of 0.3 % is seen by the right motor; a wrong one's error passes for drift, and it is less likely."""
    estimate, hold_out = fitted()
    complete = validate_model(hold_out, estimate)
    assert 0.002 < complete.noise.share < 0.004 and complete.noise.drift < 1e-6
    assert complete.at_floor and not complete.above_floor
    lacking, other = fitted(ks=0.4)
    wrong = validate_model(other, lacking)
    assert wrong.noise.drift > 1e-4 and wrong.above_floor and not wrong.at_floor and not wrong.quiet
    assert wrong.likelihood < complete.likelihood - 1000.0
    assert np.isfinite(wrong.likelihood)
