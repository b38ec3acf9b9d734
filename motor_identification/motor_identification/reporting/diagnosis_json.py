"""A diagnosis in the JSON form that the interfaces promise."""

from typing import Any

from motor_identification.diagnosis.result import Diagnosis, Finding, Imitated, Nearest
from motor_identification.discrepancy.structure import Structure
from motor_identification.noise.error_model import Disturbance
from motor_identification.reporting.json_values import to_estimate, to_model, to_number

VARIABLES = {"speed_voltage": "drive", "past": "drive"}  # finer than what the interfaces promise


def diagnosis_to_json(diagnosis: Diagnosis) -> dict[str, Any]:
    """Convert a diagnosis to JSON values; null where there is no number."""
    return {
        "bags": list(diagnosis.bags),
        "validation": list(diagnosis.validation),
        "noise_floor": to_number(diagnosis.noise_floor),
        "sensor_floor": to_number(diagnosis.sensor_floor),
        "disturbance": _disturbance_to_json(diagnosis.disturbance),
        "gain_scatter": to_number(diagnosis.gain_scatter) if diagnosis.gain_scatter > 0.0 else None,
        "structure": [_structure_to_json(one) for one in diagnosis.structure],
        "gap_before": to_number(diagnosis.gap_before),
        "gap_after": to_number(diagnosis.gap_after),
        "held_out": not diagnosis.after.seen,
        "verdict": diagnosis.verdict.value,
        "undetectable": list(diagnosis.undetectable),
        "not_testable": list(diagnosis.undetectable),
        "imitated": _imitated_to_json(diagnosis.imitated),
        "undetermined": list(diagnosis.undetermined),
        "nearest": _nearest_to_json(diagnosis.nearest),
        "suggested_experiment": diagnosis.suggested_experiment or None,
        "time_limit": diagnosis.time_limit or None,
        "baseline": to_model(diagnosis.baseline),
        "findings": [_finding_to_json(one) for one in diagnosis.findings],
        "model": to_model(diagnosis.model),
        "notes": list(diagnosis.model.notes),
    }


def _disturbance_to_json(disturbance: Disturbance | None) -> dict[str, Any] | None:
    if disturbance is None:
        return None
    return {
        "rms_voltage": to_estimate(disturbance.rms_voltage, disturbance.rms_error),
        "correlation_time": to_estimate(disturbance.correlation_time, disturbance.time_error),
    }


def _imitated_to_json(imitated: Imitated | None) -> dict[str, Any] | None:
    if imitated is None:
        return None
    return {"effect": imitated.effect, "size": to_number(imitated.size), "kv": to_number(imitated.kv)}


def _nearest_to_json(nearest: Nearest | None) -> dict[str, Any] | None:
    return None if nearest is None else {"effects": list(nearest.effects), "gap": to_number(nearest.gap)}


def _structure_to_json(one: Structure) -> dict[str, Any]:
    variable = VARIABLES.get(one.variable, one.variable)
    return {
        "variable": variable,
        "share": to_number(one.most),
        "significance": to_number(one.significance),
        "cause": one.cause or None,
    }


def _finding_to_json(one: Finding) -> dict[str, Any]:
    return {
        "effect": one.effect,
        "gap_before": to_number(one.gap_before),
        "gap_after": to_number(one.gap_after),
        "where": one.where,
        "parameters": {name: to_estimate(*value) for name, value in one.parameters.items()},
        "alternatives": [
            {"effect": other.effect, "gap_after": to_number(other.gap_after)} for other in one.alternatives
        ],
        "ambiguous_with": list(one.ambiguous_with),
        "sensor_may_lag": one.sensor_may_lag,
        "suggested_experiment": one.suggested_experiment or None,
    }
