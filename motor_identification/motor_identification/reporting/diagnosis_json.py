"""A diagnosis as programs read it."""

from math import isfinite
from typing import Any

from motor_identification.diagnosis.result import Diagnosis, Finding
from motor_identification.uncertainty.result import Fit


def as_json(diagnosis: Diagnosis) -> dict[str, Any]:
    """The form that interfaces promise; null where there is no number."""
    return {
        "bags": list(diagnosis.bags),
        "validation": list(diagnosis.validation),
        "noise_floor": _number(diagnosis.noise_floor),
        "gap_before": _number(diagnosis.gap_before),
        "gap_after": _number(diagnosis.gap_after),
        "verdict": diagnosis.verdict.value,
        "undetectable": list(diagnosis.undetectable),
        "suggested_experiment": diagnosis.suggested_experiment or None,
        "baseline": _model(diagnosis.baseline),
        "findings": [_finding(one) for one in diagnosis.findings],
        "model": _model(diagnosis.model),
    }


def _finding(one: Finding) -> dict[str, Any]:
    return {
        "effect": one.effect,
        "gap_before": _number(one.gap_before),
        "gap_after": _number(one.gap_after),
        "where": one.where,
        "parameters": {name: _value(*value) for name, value in one.parameters.items()},
        "alternatives": [{"effect": other.effect, "gap_after": _number(other.gap_after)} for other in one.alternatives],
        "ambiguous_with": list(one.ambiguous_with),
        "suggested_experiment": one.suggested_experiment or None,
    }


def _model(fit: Fit) -> dict[str, Any]:
    values = fit.parameters.values
    return {
        "effects": list(fit.parameters.effects),
        "parameters": {name: _value(value, fit.standard_errors[name]) for name, value in values.items()},
    }


def _value(value: float, error: float) -> dict[str, float | None]:
    return {"value": _number(value), "standard_error": _number(error)}


def _number(value: float) -> float | None:
    return float(value) if isfinite(value) else None
