"""What a row of the effect table can say: scales in the recording's own size, and names for people."""

import pytest

from motor_model.effect import Effect, ParameterSpec, Scale


@pytest.mark.parametrize(
    ("scale", "size"),
    [
        (Scale.ABSOLUTE, 1.0),
        (Scale.VOLTAGE, 10.0),
        (Scale.SPEED, 200.0),
        (Scale.GAIN, 0.05),
        (Scale.DRAG, 2.5e-4),
        (Scale.DURATION, 30.0),
    ],
)
def test_a_scale_follows_the_recording(scale: Scale, size: float) -> None:
    assert scale.of(10.0, 200.0, 30.0) == pytest.approx(size, rel=1e-14)


def test_every_scale_has_the_unit_of_what_it_scales() -> None:
    """In other units of voltage (×2), angle (×3) and time (×5) a scale changes as its own unit does."""
    for scale in Scale:
        volts, speed, seconds = scale.value
        factor = scale.of(20.0, 200.0 * 3 / 5, 150.0) / scale.of(10.0, 200.0, 30.0)
        assert factor == pytest.approx(2.0**volts * (3 / 5) ** speed * 5.0**seconds)


def test_a_title_is_a_name_as_a_person_writes_it() -> None:
    spec = ParameterSpec("ks", "V", 0.0, 0.0, 1.0)
    assert Effect("coulomb_friction", "", "ramps", "", (spec,)).title == "Coulomb friction"
    assert Effect("load_step", "", "ramps", "", (spec,)).title == "load step"
