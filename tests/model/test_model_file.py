"""The file a motor is kept in: what is written is read again; what is no motor is refused in a sentence."""

import re
from pathlib import Path

import pytest
import yaml

from motor_model.errors import ModelError
from motor_model.model_file import load, save
from motor_model.parameters import Parameters, paper_motor

FRICTION = {"kv": 0.07, "ka": 0.005, "ks": 0.5}
STATIC = FRICTION | {"breakaway_voltage": 0.9, "stribeck_speed": 5.0}


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
    "no back-EMF": (FRICTION_FILE.replace("0.07", "1e-300"), "kv = 1e-300 V·s/rad is none that a motor has"),
    "too fast": (FRICTION_FILE.replace("0.07", "1e-6"), "the motor would reach 1.2e+07 rad/s, and 1e+06 is the most"),
    "a supply beyond all": (FRICTION_FILE + "max_voltage: 1e300\n", "max_voltage = 1e+300 V must be 0.001 to 100000 V"),
    "too much friction": (FRICTION_FILE.replace("0.5", "1e300"), "ks = 1e+300 V is none that a motor has"),
    "not YAML": ("effects: [\n", "; write one with 'identify --output model.yaml'"),
    "no date": (FRICTION_FILE + "created: 2026-99-99\n", "is not YAML"),
    "endless": (5000 * "[", "is nested deeper than 50"),
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
    with pytest.raises(
        ModelError,
        match=r"cannot read the model file .*none.yaml .No such file or directory.: name one that can be read\.",
    ):
        load(tmp_path / "none.yaml")
    with pytest.raises(ModelError, match="is no regular file"):
        load(tmp_path)
    (tmp_path / "bytes.yaml").write_bytes(b"\xff\xfe\x00\x01")
    with pytest.raises(ModelError, match="is not YAML"):
        load(tmp_path / "bytes.yaml")
    with pytest.raises(
        ModelError, match="cannot write the model file .* .No such file or directory.: choose a directory"
    ):
        save(tmp_path / "no" / "where.yaml", paper_motor())


def test_motors_at_the_limits_are_taken(tmp_path: Path) -> None:
    for text in (
        FRICTION_FILE.replace("0.07", "1.3e-5"),  # 9e5 rad/s
        FRICTION_FILE.replace("0.07", "1e4"),
        FRICTION_FILE.replace("0.5", "1e5").replace("0.07", "0.11") + "max_voltage: 1e5\n",
    ):
        (tmp_path / "m.yaml").write_text(text, encoding="utf-8")
        assert load(tmp_path / "m.yaml").gain > 0.0
