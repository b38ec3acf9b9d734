"""A diagnosis as a table for a terminal: the gap effect by effect, parameters, and the evidence for every effect."""

from itertools import pairwise
from math import nan

from motor_identification.diagnosis.result import Diagnosis, Finding
from motor_identification.reporting.names import effect_name, join_effects, join_names
from motor_identification.reporting.numbers import format_quantity
from motor_identification.uncertainty.result import Fit
from motor_model.text_table import align_columns

RISES = 1.01  # times the gap of the row before: more is no matter of how far a fit had converged
ROWS = "A row's gap is that of the search as it got there, and need not fall: {}. Compare the first with the last."
BESIDE_TORQUE = "from {} on it went on beside a random torque, where the model before left {:.3g} rad/s"
GIVEN_UP = "{} was found beside {}, which the model has no more"
LIKELIER = "what is likelier on unseen motion may leave more"


def format_diagnosis(diagnosis: Diagnosis) -> str:
    """Write the gap effect by effect with parameters, then the evidence for each effect, for a terminal."""
    rows = [("effect", "gap [rad/s]", "× floor", "parameters")]
    rows.append((_format_model(diagnosis.baseline), *_format_gap(diagnosis, diagnosis.gap_before), ""))
    for one in diagnosis.findings:
        also = "".join(f" or {name}" for name in one.ambiguous_with)
        rows.append((f"+ {one.effect}{also}", *_format_gap(diagnosis, one.gap_after), format_parameters(one)))
    rows.append(("noise floor", *_format_gap(diagnosis, diagnosis.noise_floor), ""))
    rises = [said] if (said := describe_rises(diagnosis)) else []
    evidence = map(_describe_evidence, diagnosis.findings)
    return "\n".join((align_columns(rows), *evidence, _describe_motor(diagnosis), *rises))


def describe_rises(diagnosis: Diagnosis) -> str:
    """Say why the gap of a row is above that of the row before; empty where none is."""
    found = diagnosis.findings
    gaps = [diagnosis.gap_before, *(one.gap_after for one in found)]
    if not any(after > RISES * before for before, after in pairwise(gaps)):
        return ""
    beside = [BESIDE_TORQUE.format(effect_name(one.effect), one.gap_before) for one in found if one.beside_torque][:1]
    without = [
        GIVEN_UP.format(effect_name(one.effect), join_effects(one.given_up, "and")) for one in found if one.given_up
    ]
    return ROWS.format("; ".join((*beside, *without)) or LIKELIER)


def _describe_evidence(finding: Finding) -> str:
    """Say where the model without an effect was wrong."""
    names = [effect_name(effect) for effect in (finding.effect, *finding.ambiguous_with)]
    return f"Evidence for {join_names(names, 'or')}: {finding.where}"


def _describe_motor(diagnosis: Diagnosis) -> str:
    """Say kv and ka as the last fit has them, of all motion and beside all that was found."""
    fit = diagnosis.model
    both = (
        format_quantity(name, fit.parameters.value(name), fit.standard_errors.get(name, nan)) for name in ("kv", "ka")
    )
    return f"Motor: {', '.join(both)}{', beside what was found' if diagnosis.findings else ''}."


def _format_model(fit: Fit) -> str:
    return "kv, ka" + "".join(f", {name}" for name in fit.parameters.effects)


def _format_gap(diagnosis: Diagnosis, gap: float) -> tuple[str, str]:
    floor = diagnosis.noise_floor
    return f"{gap:.4g}", f"{gap / floor:.3g}" if floor > 0.0 else "–"


def format_parameters(finding: Finding) -> str:
    """Write a finding's parameters with their standard errors."""
    return ", ".join(format_quantity(name, *value) for name, value in finding.parameters.items())
