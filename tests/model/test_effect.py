"""What a row of the effect table can say: scales in the recording's own size, and names for people."""

import pytest

from motor_model.effect import ABSOLUTE, Effect, Extent, ParameterSpec, Scale
from motor_model.effects import SPEC_BY_NAME, SPECS

EXTENT = Extent(voltage=10.0, speed=200.0, duration=30.0, sample=0.01, cycles=500.0)


@pytest.mark.parametrize(
    ("scale", "size"),
    [
        (ABSOLUTE, 1.0),
        (Scale(voltage=1), 10.0),
        (Scale(speed=1), 200.0),
        (Scale(voltage=1, speed=-1), 0.05),
        (Scale(voltage=1, speed=-2), 2.5e-4),
        (Scale(duration=1), 30.0),
        (Scale(sample=1), 0.01),
        (Scale(speed=1, sample=1), 2.0),
    ],
)
def test_a_scale_follows_the_recording(scale: Scale, size: float) -> None:
    assert scale.of(EXTENT) == pytest.approx(size, rel=1e-14)


UNITS = {
    "V": (1.0, 0.0, 0.0),
    "s": (0.0, 0.0, 1.0),
    "rad": (0.0, 1.0, 1.0),
    "rad/s": (0.0, 1.0, 0.0),
    "V·s/rad": (1.0, -1.0, 0.0),
    "V·s²/rad": (1.0, -1.0, 1.0),
    "V·s²/rad²": (1.0, -2.0, 0.0),
}
ABSOLUTE_ONES = {"ripple_phase", "eccentricity", "eccentricity_phase"}  # angles of a turn


@pytest.mark.parametrize(
    ("name", "sample", "duration", "box"),
    [
        ("delay", 0.005, 28.0, (0.0, 1.0)),  # what is usual
        ("delay", 0.005, 3.0, (0.0, 0.3)),  # a tenth of the recording
        ("delay", 0.1, 700.0, (0.0, 4.0)),  # 40 samples
        ("electrical_time_constant", 0.005, 28.0, (1e-5, 0.1)),
        ("electrical_time_constant", 0.1, 28.0, (1e-5, 0.6)),
        ("warm_up_time", 0.005, 6.0, (0.6, 120.0)),  # not within seconds
        ("warm_up_time", 0.005, 3600.0, (10.0, 72000.0)),
        ("ripple_cycles", 0.005, 28.0, (1.0, 500.0)),  # as fine as the encoder sees
        ("backlash_angle", 0.005, 28.0, (0.0, 30.0)),
        ("backlash_angle", 0.001, 28.0, (0.0, 6.0)),
        ("backlash_angle", 1e-5, 28.0, (0.0, 1.0)),
    ],
)
def test_a_box_spans_what_is_usual_within_the_recording(
    name: str, sample: float, duration: float, box: tuple[float, float]
) -> None:
    assert SPEC_BY_NAME[name].box(Extent(10.0, 200.0, duration, sample, 500.0)) == pytest.approx(box)


def test_no_encoder_sees_less_than_two_cycles() -> None:
    assert SPEC_BY_NAME["ripple_cycles"].box(Extent(10.0, 200.0, 28.0, 0.005, 1.0)) == (1.0, 2.0)


def test_every_parameter_scales_as_its_unit_does() -> None:
    for spec in SPECS:
        scale = (spec.scale.voltage, spec.scale.speed, spec.scale.duration + spec.scale.sample)
        assert scale == UNITS.get(spec.unit, (0.0, 0.0, 0.0)) or spec.name in ABSOLUTE_ONES, spec.name


def test_a_title_is_a_name_as_a_person_writes_it() -> None:
    spec = ParameterSpec("ks", "V", 0.0, 0.0, 1.0)
    assert Effect("coulomb_friction", "", "ramps", "", (spec,)).title == "Coulomb friction"
    assert Effect("load_step", "", "ramps", "", (spec,)).title == "load step"
