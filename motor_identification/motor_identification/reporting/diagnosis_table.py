"""A diagnosis as a table for a terminal: the gap effect by effect, parameters, and the evidence for every effect."""

from motor_identification.diagnosis.result import Diagnosis, Finding
from motor_identification.reporting.names import effect_name, join_names
from motor_identification.reporting.numbers import format_quantity
from motor_identification.uncertainty.result import Fit
from motor_model.text_table import align_columns


def format_diagnosis(diagnosis: Diagnosis) -> str:
    """Write the gap effect by effect with parameters, then the evidence for each effect, for a terminal."""
    rows = [("effect", "gap [rad/s]", "× floor", "parameters")]
    rows.append((_format_model(diagnosis.baseline), *_format_gap(diagnosis, diagnosis.gap_before), ""))
    for one in diagnosis.findings:
        also = "".join(f" or {name}" for name in one.ambiguous_with)
        rows.append((f"+ {one.effect}{also}", *_format_gap(diagnosis, one.gap_after), format_parameters(one)))
    rows.append(("noise floor", *_format_gap(diagnosis, diagnosis.noise_floor), ""))
    return "\n".join((align_columns(rows), *map(_describe_evidence, diagnosis.findings)))


def _describe_evidence(finding: Finding) -> str:
    """Say where the model without an effect was wrong."""
    names = [effect_name(effect) for effect in (finding.effect, *finding.ambiguous_with)]
    return f"Evidence for {join_names(names, 'or')}: {finding.where}"


def _format_model(fit: Fit) -> str:
    return "kv, ka" + "".join(f", {name}" for name in fit.parameters.effects)


def _format_gap(diagnosis: Diagnosis, gap: float) -> tuple[str, str]:
    floor = diagnosis.noise_floor
    return f"{gap:.4g}", f"{gap / floor:.3g}" if floor > 0.0 else "–"


def format_parameters(finding: Finding) -> str:
    """Write a finding's parameters with their standard errors."""
    return ", ".join(format_quantity(name, *value) for name, value in finding.parameters.items())
