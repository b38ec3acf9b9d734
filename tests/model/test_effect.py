"""What a row of the effect table can say: scales in the recording's own size, and names for people."""

import pytest

from motor_model.effect import ABSOLUTE, Effect, ParameterSpec, Scale
from motor_model.effects import SPECS


@pytest.mark.parametrize(
    ("scale", "size"),
    [
        (ABSOLUTE, 1.0),
        (Scale(voltage=1), 10.0),
        (Scale(speed=1), 200.0),
        (Scale(voltage=1, speed=-1), 0.05),
        (Scale(voltage=1, speed=-2), 2.5e-4),
        (Scale(duration=1), 30.0),
    ],
)
def test_a_scale_follows_the_recording(scale: Scale, size: float) -> None:
    assert scale.of(10.0, 200.0, 30.0) == pytest.approx(size, rel=1e-14)


UNITS = {"V": (1.0, 0.0, 0.0), "rad/s": (0.0, 1.0, 0.0), "V·s/rad": (1.0, -1.0, 0.0), "V·s²/rad²": (1.0, -2.0, 0.0)}


def test_every_parameter_scales_as_its_unit_does() -> None:
    for spec in SPECS:
        scale = (spec.scale.voltage, spec.scale.speed, spec.scale.duration)
        if spec.name == "ka":  # kv times a time constant, whose range is the same for every recording
            assert scale == UNITS["V·s/rad"]
        elif spec.unit == "s":
            assert scale in {(0.0, 0.0, 0.0), (0.0, 0.0, 1.0)}
        else:
            assert scale == UNITS.get(spec.unit, (0.0, 0.0, 0.0)), spec.name


def test_a_title_is_a_name_as_a_person_writes_it() -> None:
    spec = ParameterSpec("ks", "V", 0.0, 0.0, 1.0)
    assert Effect("coulomb_friction", "", "ramps", "", (spec,)).title == "Coulomb friction"
    assert Effect("load_step", "", "ramps", "", (spec,)).title == "load step"
