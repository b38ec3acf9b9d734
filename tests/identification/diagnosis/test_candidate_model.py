"""A model is judged by what it leaves, in its training data and in held-out motion."""

import numpy as np
from diagnosed import fitted

from motor_identification.diagnosis.candidate_model import validate_model


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
