"""Write numbers and models in the JSON form that the interfaces promise; null where there is no number."""

import json
from math import isfinite
from pathlib import Path
from typing import Any

from motor_identification.uncertainty.result import Fit
from motor_model.errors import MotorError
from motor_model.regular_file import say_refusal, write_text


def to_number(value: float) -> float | None:
    """Return a finite number, or None."""
    return float(value) if isfinite(value) else None


def to_estimate(value: float, error: float) -> dict[str, float | None]:
    """Return a value with its standard error."""
    return {"value": to_number(value), "standard_error": to_number(error)}


def to_model(fit: Fit) -> dict[str, Any]:
    """Return the effects and parameters of a fitted motor."""
    values = fit.parameters.values
    return {
        "effects": list(fit.parameters.effects),
        "parameters": {name: to_estimate(value, fit.standard_errors[name]) for name, value in values.items()},
    }


def write_json(path: Path, content: dict[str, Any]) -> None:
    """Write a JSON file that a person can read too.

    Raises:
        MotorError: the file cannot be written.
    """
    try:
        write_text(path, json.dumps(content, indent=1, ensure_ascii=False) + "\n")
    except OSError as error:
        raise MotorError(f"cannot write {path} {say_refusal(error)}.") from error
