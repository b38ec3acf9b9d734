"""A diagnosis in the JSON form that the interfaces promise."""

from typing import Any

from motor_identification.diagnosis.result import Diagnosis, Finding
from motor_identification.reporting.json_values import to_estimate, to_model, to_number


def diagnosis_to_json(diagnosis: Diagnosis) -> dict[str, Any]:
    """Convert a diagnosis to JSON values; null where there is no number."""
    return {
        "bags": list(diagnosis.bags),
        "validation": list(diagnosis.validation),
        "noise_floor": to_number(diagnosis.noise_floor),
        "gap_before": to_number(diagnosis.gap_before),
        "gap_after": to_number(diagnosis.gap_after),
        "verdict": diagnosis.verdict.value,
        "undetectable": list(diagnosis.undetectable),
        "suggested_experiment": diagnosis.suggested_experiment or None,
        "baseline": to_model(diagnosis.baseline),
        "findings": [_finding_to_json(one) for one in diagnosis.findings],
        "model": to_model(diagnosis.model),
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
        "suggested_experiment": one.suggested_experiment or None,
    }
