"""Effects that no fit can have are refused before anything is computed."""

import pytest

from motor_identification.measurement.request_checks import check_effects
from motor_model.errors import ModelError


def test_what_can_be_fitted_passes() -> None:
    check_effects(("coulomb_friction", "encoder_eccentricity"))
    check_effects(())


@pytest.mark.parametrize(
    ("effects", "why"),
    [
        (("missed_edges",), "missed_edges is detected in every fit and cannot be fitted"),
        (("load_bias", "load_bias"), "'load_bias' is given twice"),
    ],
)
def test_what_cannot_is_one_sentence(effects: tuple[str, ...], why: str) -> None:
    with pytest.raises(ModelError, match=why) as refused:
        check_effects(effects)
    assert str(refused.value).count(".") == 1 and str(refused.value).endswith(".")
