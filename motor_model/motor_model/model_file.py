"""Model files: a motor's parameters as YAML that a person can read and edit.

name: my_motor
max_voltage: 12.0
effects: [coulomb_friction]
parameters:
  kv: {value: 0.0689, standard_error: 1.2e-06, unit: V·s/rad}
  …
physical:  # where a current was measured, or the resistance is known: see `physical/`
  resistance: {value: 2.31, standard_error: 0.004, unit: Ω}
  torque_constant: {value: 0.0662, standard_error: 0.0001, unit: N·m/A}
  …
origin: {bags: [step], created: …}

Of `physical` only resistance and torque_constant are read: the rest follows from them and the parameters.
"""

from collections.abc import Mapping
from contextlib import suppress
from math import nan
from pathlib import Path
from typing import Any

import yaml

from motor_model import yaml_file
from motor_model.effects import SPEC_BY_NAME
from motor_model.errors import ModelError
from motor_model.parameters import Parameters
from motor_model.physical.quantities import CONSTANT, PHYSICAL_BY_NAME, RESISTANCE, physical_values_of
from motor_model.printable import escape
from motor_model.regular_file import Unfit, say_refusal, write_text


def load(path: str | Path) -> Parameters:
    """Read a model file.

    Raises:
        ModelError: there is no such file, it is not YAML of this form, or it does not describe a motor.
    """
    try:
        content = yaml_file.read(path)
    except OSError as error:
        raise ModelError(f"cannot read the model file {path} ({error.strerror}): name one that can be read.") from error
    except Unfit as error:
        raise ModelError(str(error)) from error
    except yaml_file.NotYaml as error:
        raise ModelError(f"{path} {error}; write one with 'identify --output model.yaml'.") from error
    try:
        return _parameters(content, Path(path).stem)
    except ModelError as error:
        raise ModelError(f"{path}: {error}") from error


def load_errors(path: str | Path) -> dict[str, float]:
    """Read the standard errors of a model file's parameters, NaN where the file has none.

    Raises:
        ModelError: as `load`.
    """
    names = load(path).values
    rows = yaml_file.read(path)["parameters"]
    errors = {name: rows[name].get("standard_error") if isinstance(rows[name], Mapping) else None for name in names}
    return {name: nan if error is None else _number(name, error) for name, error in errors.items()}


def load_residual_rms(path: str | Path) -> float:
    """Read how far [rad/s] an identified motor was from the motion it was fitted to; NaN where a file does not say.

    Raises:
        ModelError: as `load`.
    """
    return _number("residual_rms", _load_origin(path, "residual_rms", nan))


def load_speed_filter(path: str | Path) -> str:
    """Read which filter the speeds had passed that a motor was identified from; empty where a file says none.

    Raises:
        ModelError: as `load`.
    """
    return str(_load_origin(path, "speed_filter", ""))


def _load_origin(path: str | Path, name: str, absent: Any) -> Any:
    """Read a value of a model file's origin."""
    load(path)
    origin = yaml_file.read(path).get("origin")
    value = origin.get(name) if isinstance(origin, Mapping) else None
    return absent if value is None else value


def _parameters(content: Any, default_name: str) -> Parameters:
    if not isinstance(content, Mapping) or not isinstance(content.get("parameters"), Mapping):
        raise ModelError("a model file has 'effects' and 'parameters'; write one with 'identify --output model.yaml'.")
    effects = content.get("effects") or []
    if not isinstance(effects, list) or not all(isinstance(effect, str) for effect in effects):
        raise ModelError("'effects' must be a list of names, such as [coulomb_friction].")
    values = {str(name): _number(str(name), entry) for name, entry in content["parameters"].items()}
    parameters = Parameters(
        values,
        tuple(effects),
        _number("max_voltage", content.get("max_voltage", 12.0)),
        escape(str(content.get("name") or default_name)),
        gear_ratio=_number("gear_ratio", content.get("gear_ratio", 1.0)),
        **_physical(content.get("physical")),
    )
    _check_limits(parameters)
    return parameters


def _physical(content: Any) -> dict[str, float]:
    """Read resistance and torque constant; empty where a file has none."""
    if content is None:
        return {}
    if not isinstance(content, Mapping):
        raise ModelError("'physical' must be a table with a resistance.")
    found = {name: _number(name, content[name]) for name in (RESISTANCE.name, CONSTANT.name) if name in content}
    low, high = LIMITS[RESISTANCE.unit]
    if not low <= found.get(RESISTANCE.name, low) <= high:
        raise ModelError(
            f"resistance = {found[RESISTANCE.name]:g} Ω is none that a motor has: it must be {low:g} to {high:g}."
        )
    return found


# What a file may say, by unit: far beyond any motor, but within what a simulation computes in finite time and numbers.
LIMITS = {
    "V": (0.0, 1e5), "V·s/rad": (1e-7, 1e4), "V·s²/rad": (1e-12, 1e6), "V·s²/rad²": (0.0, 1e6), "rad/s": (0.0, 1e7),
    "s": (0.0, 1e7), "rad": (0.0, 1e6), "1/rev": (0.0, 1e5), "–": (0.0, 1e3),
    "Ω": (1e-6, 1e6),
}  # fmt: skip
FASTEST = 1e6  # [rad/s] ten times a dental drill: a simulated encoder counts every edge


def _check_limits(parameters: Parameters) -> None:
    for name, value in parameters.values.items():
        low, high = LIMITS[SPEC_BY_NAME[name].unit]
        if value != 0.0 and not low <= abs(value) <= high:
            unit = SPEC_BY_NAME[name].unit
            raise ModelError(f"{name} = {value:g} {unit} is none that a motor has: it must be {low:g} to {high:g}.")
    low, high = 1e-3, LIMITS["V"][1]
    if not low <= parameters.max_voltage <= high:
        raise ModelError(f"max_voltage = {parameters.max_voltage:g} V must be {low:g} to {high:g} V.")
    fastest = parameters.max_voltage * parameters.gain
    if fastest > FASTEST:
        raise ModelError(f"the motor would reach {fastest:.3g} rad/s, and {FASTEST:g} is the most: kv is too small.")


def _number(name: str, entry: Any) -> float:
    value = entry.get("value") if isinstance(entry, Mapping) else entry
    if isinstance(value, str):  # YAML 1.1 reads 1e-6 as text
        with suppress(ValueError):
            value = float(value)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ModelError(f"'{name}' must have a number as its value, not {value!r}.")
    try:
        return float(value)
    except OverflowError as error:
        raise ModelError(f"'{name}' is a number beyond all bounds; correct it.") from error


def save(
    path: str | Path,
    parameters: Parameters,
    standard_errors: Mapping[str, float] | None = None,
    origin: Mapping[str, Any] | None = None,
    physical_errors: Mapping[str, float] | None = None,
) -> None:
    """Write a model file; `origin` says where the numbers came from, errors are by name.

    Raises:
        ModelError: the file cannot be written.
    """
    errors = standard_errors or {}
    rows = {
        name: {"value": value, "standard_error": errors.get(name), "unit": SPEC_BY_NAME[name].unit}
        for name, value in parameters.values.items()
    }
    content = {
        "name": parameters.name,
        "max_voltage": parameters.max_voltage,
        **({"gear_ratio": parameters.gear_ratio} if parameters.gear_ratio != 1.0 else {}),
        "effects": list(parameters.effects),
        "parameters": rows,
        **_physical_section(parameters, physical_errors or {}),
        "origin": dict(origin or {}),
    }
    try:
        write_text(path, yaml.safe_dump(content, sort_keys=False, allow_unicode=True))
    except OSError as error:
        raise ModelError(f"cannot write the model file {path} {say_refusal(error)}.") from error


def _physical_section(parameters: Parameters, errors: Mapping[str, float]) -> dict[str, Any]:
    rows = {
        name: {"value": value, "standard_error": errors.get(name), "unit": PHYSICAL_BY_NAME[name].unit}
        for name, value in physical_values_of(parameters).items()
    }
    return {"physical": rows} if rows else {}
