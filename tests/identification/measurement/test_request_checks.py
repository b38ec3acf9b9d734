"""Effects that no fit of these recordings can have are refused before anything is computed."""

import pytest
from handmade import turning
from recorded import as_speed

from motor_identification.measurement.request_checks import check_effects
from motor_model.errors import ModelError

STAMPED = turning(lambda time: 700.0 * time, 0.2)
SPEEDS = as_speed(STAMPED)


def test_what_can_be_fitted_passes() -> None:
    check_effects([STAMPED, STAMPED], ("coulomb_friction", "encoder_eccentricity"))
    check_effects([SPEEDS], ("coulomb_friction", "torque_ripple"))
    check_effects([STAMPED], ())


@pytest.mark.parametrize(
    ("recordings", "effects", "why"),
    [
        ([STAMPED], ("missed_edges",), "missed_edges is detected in every fit and cannot be fitted"),
        ([STAMPED], ("load_bias", "load_bias"), "'load_bias' is given twice"),
        ([STAMPED, SPEEDS], ("encoder_eccentricity",), "encoder_eccentricity needs a recording with encoder counts"),
    ],
)
def test_what_cannot_is_one_sentence(recordings: list, effects: tuple[str, ...], why: str) -> None:  # type: ignore[type-arg]
    with pytest.raises(ModelError, match=why) as refused:
        check_effects(recordings, effects)
    assert str(refused.value).count(".") == 1 and str(refused.value).endswith(".")
