"""The table of effects: the names of the interface, rows that can be searched, added and said."""

from math import inf

import pytest

from motor_model.effect import Extent
from motor_model.effects import EFFECT_BY_NAME, EFFECTS, SPECS, VECTOR_NAMES, normalised, specs_of
from motor_model.errors import ModelError
from motor_model.excitation import PROFILES

# The table of interfaces.md: what users, files and messages call things.
TABLE = {
    "coulomb_friction": {"ks": "V"},
    "static_friction": {"breakaway_voltage": "V", "stribeck_speed": "rad/s"},
    "quadratic_drag": {"drag": "V·s²/rad²"},
    "load_bias": {"bias_voltage": "V"},
    "load_step": {"step_voltage": "V", "step_time": "s"},
    "dead_zone": {"dead_zone_voltage": "V"},
    "voltage_limit": {"limit_voltage": "V"},
    "direction_asymmetry": {"reverse_gain": "–"},
    "coast_drive": {"coast_share": "–"},
    "supply_sag": {"sag": "–"},
    "armature_inductance": {"electrical_time_constant": "s"},
    "transport_delay": {"delay": "s"},
    "torque_ripple": {"ripple_voltage": "V", "ripple_cycles": "1/rev", "ripple_phase": "rad"},
    "encoder_eccentricity": {"eccentricity": "rad", "eccentricity_phase": "rad"},
    "backlash": {"backlash_angle": "rad", "load_fraction": "–"},
    "warm_up": {"resistance_rise": "–", "warm_up_time": "s"},
    "missed_edges": {"miss_rate": "–"},
}


def test_the_table_is_that_of_the_interface() -> None:
    assert {effect.name: {spec.name: spec.unit for spec in effect.parameters} for effect in EFFECTS} == TABLE
    assert [(spec.name, spec.unit) for spec in specs_of(())] == [("kv", "V·s/rad"), ("ka", "V·s²/rad")]
    assert len(VECTOR_NAMES) == len(set(VECTOR_NAMES)) == len(SPECS) + 8


def test_every_row_of_the_table_can_be_searched() -> None:
    for spec in SPECS:
        assert spec.low < spec.high and spec.minimum < spec.maximum
        assert spec.high <= spec.maximum or spec.maximum == inf
        assert spec.minimum <= spec.low
        assert not spec.logarithmic or spec.low > 0.0
    assert {effect.shown_by for effect in EFFECTS} <= set(PROFILES)


def test_every_row_of_the_table_can_be_added_to_a_fitted_model() -> None:
    for effect in EFFECTS:
        assert effect.implies is None or effect.implies in EFFECT_BY_NAME
        if effect.constant is not None:  # of the same size, and of nothing else
            (spec,) = EFFECT_BY_NAME[effect.constant].parameters
            assert (spec.unit, spec.scale) == (effect.parameters[0].unit, effect.parameters[0].scale)
        for spec in effect.parameters:
            started = effect.fitted and not effect.periodic  # what is periodic starts from its spectrum
            assert bool(spec.starts) == started, f"{spec.name} needs starts"
            assert all(spec.low <= start <= spec.high and start != spec.off for start in spec.starts), spec.name
            if spec.at_least is not None:
                implied = EFFECT_BY_NAME[str(effect.implies)].parameters
                assert spec.at_least in {other.name for other in implied}


def test_every_row_of_the_table_says_what_to_call_it() -> None:
    assert EFFECT_BY_NAME["coulomb_friction"].title == "Coulomb friction"
    assert EFFECT_BY_NAME["load_bias"].title == "load bias"
    for effect in EFFECTS:
        first = effect.parameters[0].name
        assert effect.phrase.endswith((f" ({effect.name})", f" ({first})")) and effect.summary


def test_effects_come_once_in_the_order_of_the_table_with_what_they_imply() -> None:
    assert normalised(()) == ()
    assert normalised(("transport_delay", "coulomb_friction", "transport_delay")) == (
        "coulomb_friction",
        "transport_delay",
    )
    assert normalised(("static_friction",)) == ("coulomb_friction", "static_friction")
    assert normalised(tuple(reversed(EFFECT_BY_NAME))) == tuple(EFFECT_BY_NAME)
    with pytest.raises(ModelError, match="'friction' is not an effect; the effects are coulomb_friction, "):
        normalised(("friction",))


@pytest.mark.parametrize(("share", "searched"), [(0.25, True), (0.5, True), (0.69, True), (0.71, False), (0.9, False)])
def test_a_drag_leaves_a_motor_some_of_its_voltage(share: float, searched: bool) -> None:
    """At the largest speed, by the largest voltage: a coasting bridge bends the static curve as much more would."""
    low, high = EFFECT_BY_NAME["quadratic_drag"].parameters[0].box(Extent(12.0, 130.0, 20.0))
    assert (low <= share * 12.0 / 130.0**2 <= high) == searched


@pytest.mark.parametrize(
    ("effect", "most"),
    [
        ("static_friction", 12.0),  # a motor that ever started did so below the largest voltage
        ("torque_ripple", 36.0),  # an arm that the motor only swings
        ("dead_zone", 9.6),  # a gearmotor that moved from 95 of 255 on, told by three levels above that
    ],
)
def test_what_holds_a_motor_is_searched_up_to_what_it_may_be(effect: str, most: float) -> None:
    spec = EFFECT_BY_NAME[effect].parameters[0]
    assert spec.box(Extent(12.0, 130.0, 20.0)) == pytest.approx((0.0, most))
