"""A motor in numbers, the table it comes from, the file it is kept in: what is accepted, what is refused and how."""

import re
from math import inf, nan
from pathlib import Path

import numpy as np
import pytest
import yaml

from motor_model.effects import EFFECT_BY_NAME, EFFECTS, INDEX, SPECS, VECTOR_NAMES, normalised, specs_of
from motor_model.errors import ModelError
from motor_model.excitation import PROFILES
from motor_model.model_file import load, save
from motor_model.parameters import Parameters, paper_motor

BASE = {"kv": 0.07, "ka": 0.005}
FRICTION = BASE | {"ks": 0.5}
STATIC = FRICTION | {"breakaway_voltage": 0.9, "stribeck_speed": 5.0}

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
    assert len(VECTOR_NAMES) == len(set(VECTOR_NAMES)) == len(SPECS) + 2


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


def test_a_motor_knows_its_gain_and_time_constant() -> None:
    motor = paper_motor()
    assert motor.gain == pytest.approx(174.097 / 12.0, rel=1e-12)
    assert 0.0797 < motor.time_constant < 0.0799
    assert (motor.effects, motor.max_voltage) == ((), 12.0)


def test_an_effect_that_is_absent_is_off() -> None:
    motor = Parameters(FRICTION, ("coulomb_friction",), 24.0)
    assert (motor.value("ks"), motor.value("drag"), motor.value("reverse_gain")) == (0.5, 0.0, 1.0)
    assert motor.value("limit_voltage") == inf
    vector = motor.vector()
    assert vector.shape == (len(VECTOR_NAMES),) and vector.dtype == np.float64
    assert (vector[INDEX["kv"]], vector[INDEX["ks"]], vector[INDEX["max_voltage"]]) == (0.07, 0.5, 24.0)
    off = np.array([spec.off for spec in SPECS] + [24.0, 1.0])
    assert list(np.flatnonzero(vector != off)) == [INDEX["kv"], INDEX["ka"], INDEX["ks"]]


REFUSED = [
    (BASE, ("coulomb_friction",), 12.0, "the model lacks ks; give"),
    ({"kv": 0.07}, (), 12.0, "the model lacks ka; give"),
    (FRICTION | {"breakaway_voltage": 0.9}, ("static_friction",), 12.0, "the model lacks stribeck_speed"),
    (FRICTION, (), 12.0, "'ks' is given, but its effect is not listed"),
    (BASE | {"Ks": 1.0}, (), 12.0, "'Ks' is not a parameter of any effect; this model's are kv, ka"),
    (BASE | {"ka": -0.005}, (), 12.0, "ka = -0.005 V·s²/rad is not physical: it must be at least 0"),
    (BASE | {"ka": 0.0}, (), 12.0, "kv and ka must be positive"),
    (BASE | {"kv": 0.0}, (), 12.0, "kv and ka must be positive"),
    (BASE | {"kv": nan}, (), 12.0, "kv = nan V·s/rad must be a finite number"),
    (BASE | {"ka": inf}, (), 12.0, "ka = inf V·s²/rad must be a finite number"),
    (BASE | {"bias_voltage": nan}, ("load_bias",), 12.0, "bias_voltage = nan V must be a finite number"),
    (FRICTION | {"ks": -0.1}, ("coulomb_friction",), 12.0, "ks = -0.1 V is not physical"),
    (BASE | {"coast_share": 1.1}, ("coast_drive",), 12.0, "coast_share = 1.1 – is not physical: it must be 0 to 1"),
    (STATIC | {"stribeck_speed": 0.0}, ("static_friction",), 12.0, "stribeck_speed = 0 rad/s is not physical"),
    (BASE, (), 0.0, "max_voltage = 0 V must be positive"),
    (BASE, (), nan, "max_voltage = nan V must be positive"),
    (BASE, ("gravity",), 12.0, "'gravity' is not an effect"),
]


@pytest.mark.parametrize(("values", "effects", "most", "sentence"), REFUSED, ids=[row[3][:40] for row in REFUSED])
def test_what_is_no_motor_is_refused_in_a_sentence(
    values: dict[str, float], effects: tuple[str, ...], most: float, sentence: str
) -> None:
    with pytest.raises(ModelError, match=re.escape(sentence)) as caught:
        Parameters(values, effects, most)
    assert str(caught.value).endswith(".") and "\n" not in str(caught.value)


def test_signed_parameters_may_be_negative() -> None:
    motor = Parameters(BASE | {"bias_voltage": -0.4}, ("load_bias",))
    assert motor.values["bias_voltage"] == -0.4


def test_a_saved_motor_is_the_same_motor(tmp_path: Path) -> None:
    values = STATIC | {"delay": 1.0 / 3.0 * 1e-2, "bias_voltage": -1e-7}
    motor = Parameters(values, ("static_friction", "transport_delay", "load_bias"), 7.4, "left wheel")
    save(tmp_path / "m.yaml", motor, {"kv": 1.2e-6}, {"bags": ["a", "b"], "created": "2026-01-01"})
    again = load(tmp_path / "m.yaml")
    assert again == motor and again.name == "left wheel" and again.values == motor.values
    content = yaml.safe_load((tmp_path / "m.yaml").read_text(encoding="utf-8"))
    assert content["effects"] == ["coulomb_friction", "static_friction", "load_bias", "transport_delay"]
    assert content["parameters"]["kv"] == {"value": 0.07, "standard_error": 1.2e-6, "unit": "V·s/rad"}
    assert content["parameters"]["ks"]["standard_error"] is None
    assert content["origin"] == {"bags": ["a", "b"], "created": "2026-01-01"}


FRICTION_FILE = "effects: [coulomb_friction]\nparameters:\n  kv: {value: 0.07}\n  ka: 5e-3\n  ks: 0.5\n"


def test_a_file_written_by_hand_is_read(tmp_path: Path) -> None:
    path = tmp_path / "my_motor.yaml"
    path.write_text(FRICTION_FILE, encoding="utf-8")
    motor = load(path)
    assert motor == Parameters(FRICTION, ("coulomb_friction",)) and motor.name == "my_motor"
    path.write_text("name:\n" + FRICTION_FILE, encoding="utf-8")
    assert load(str(path)).name == "my_motor"


BAD_FILES = {
    "unknown effect": (FRICTION_FILE.replace("coulomb_friction", "friction"), "'friction' is not an effect"),
    "negative ka": (FRICTION_FILE.replace("5e-3", "-5e-3"), "ka = -0.005 V·s²/rad is not physical"),
    "missing value": (FRICTION_FILE.replace("  ks: 0.5\n", ""), "the model lacks ks"),
    "value left out": (FRICTION_FILE.replace("{value: 0.07}", "{unit: V}"), "'kv' must have a number as its value"),
    "text": (FRICTION_FILE.replace("0.5", "half a volt"), "'ks' must have a number as its value, not 'half a volt'"),
    "truth": (FRICTION_FILE.replace("0.5", "true"), "'ks' must have a number as its value, not True"),
    "no number": (FRICTION_FILE.replace("0.5", ".nan"), "ks = nan V must be a finite number"),
    "no end": (FRICTION_FILE.replace("0.5", "1" + 400 * "0"), "'ks' is a number beyond all bounds"),
    "superfluous parameter": (FRICTION_FILE + "  drag: 1.0\n", "'drag' is given, but its effect is not listed"),
    "unknown parameter": (FRICTION_FILE + "  friction: 1.0\n", "'friction' is not a parameter of any effect"),
    "effects as text": (FRICTION_FILE.replace("[coulomb_friction]", "coulomb_friction"), "'effects' must be a list"),
    "supply": (FRICTION_FILE + "max_voltage: twelve\n", "'max_voltage' must have a number"),
    "no supply": (FRICTION_FILE + "max_voltage: 0\n", "max_voltage = 0 V must be positive"),
    "not YAML": ("effects: [\n", "is not YAML; write one with 'identify --output model.yaml'"),
    "no date": (FRICTION_FILE + "created: 2026-99-99\n", "is not YAML"),
    "endless": (5000 * "[", "is not YAML"),
    "code": ("!!python/object/apply:os.getcwd []", "is not YAML"),
    "empty": ("", "a model file has 'effects' and 'parameters'"),
    "something else": ("- 1\n- 2\n", "a model file has 'effects' and 'parameters'"),
}


@pytest.mark.parametrize("name", BAD_FILES)
def test_a_bad_file_is_refused_in_one_sentence_that_names_it(tmp_path: Path, name: str) -> None:
    content, sentence = BAD_FILES[name]
    path = tmp_path / "model.yaml"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(ModelError, match=re.escape(sentence)) as caught:
        load(path)
    message = str(caught.value)
    assert message.startswith(str(path)) and message.endswith(".") and "\n" not in message


def test_files_that_cannot_be_read_or_written(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match=r"cannot read the model file .*none.yaml: No such file or directory\."):
        load(tmp_path / "none.yaml")
    with pytest.raises(ModelError, match="cannot read the model file"):
        load(tmp_path)
    (tmp_path / "bytes.yaml").write_bytes(b"\xff\xfe\x00\x01")
    with pytest.raises(ModelError, match="is not YAML"):
        load(tmp_path / "bytes.yaml")
    with pytest.raises(ModelError, match="cannot write the model file .*: No such file or directory"):
        save(tmp_path / "no" / "where.yaml", paper_motor())


def test_a_motor_does_not_hold_less_than_it_slides() -> None:
    values = {"kv": 0.07, "ka": 0.005, "ks": 0.5, "breakaway_voltage": 0.4, "stribeck_speed": 3.0}
    with pytest.raises(ModelError, match="breakaway_voltage must be at least ks"):
        Parameters(values, ("static_friction",))
    assert Parameters(values | {"breakaway_voltage": 0.5}, ("static_friction",)).value("breakaway_voltage") == 0.5
