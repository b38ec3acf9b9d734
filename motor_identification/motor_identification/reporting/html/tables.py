"""The tables of the reports: gaps effect by effect, alternatives with the reason against each, parameters."""

from dataclasses import dataclass
from math import inf, isfinite, isnan, log

from motor_identification.diagnosis.result import Alternative, Diagnosis, Finding
from motor_identification.reporting.fit_text import describe_parameter
from motor_identification.reporting.names import effect_name, join_names
from motor_identification.reporting.numbers import (
    TWO_SIDED,
    format_error,
    format_odds,
    format_ratio,
    format_unit,
    format_value,
)
from motor_identification.uncertainty.result import Fit
from motor_model.effects import SPEC_BY_NAME

LARGER = 1.3  # times the finding's gap, from which on an alternative's gap says enough
MATTERS = 0.01  # of the improvement that was taken: an alternative with less of it is named, but has no row


@dataclass(frozen=True)
class GapRow:
    """A gap with the length of its bar."""

    name: str
    gap: float  # [rad/s]
    times: str  # the noise floor
    share: float  # of the width, logarithmic


@dataclass(frozen=True)
class ParameterRow:
    """One parameter, before and after a diagnosis."""

    name: str
    unit: str
    before: str
    after: str
    error: str
    interval: str  # 95 %
    note: str


def list_gaps(diagnosis: Diagnosis) -> list[GapRow]:
    """List the gap before, after every effect, and the noise floor; bars by the logarithm."""
    known = "".join(f", {effect_name(effect)}" for effect in diagnosis.baseline.parameters.effects)
    rows = [(f"kv, ka{known}", diagnosis.gap_before)]
    for one in diagnosis.findings:
        also = join_names([effect_name(name) for name in one.ambiguous_with], "or")
        rows.append((f"+ {effect_name(one.effect)}" + (f" (or {also})" if also else ""), one.gap_after))
    rows.append(("noise floor", diagnosis.noise_floor))
    gaps = [gap for _, gap in rows if gap > 0.0 and isfinite(gap)] or [1.0]
    low, span = log(min(gaps)), max(log(max(gaps)) - log(min(gaps)), 1e-9)
    floor = diagnosis.noise_floor
    return [
        GapRow(
            name=name,
            gap=gap,
            times=f"{format_ratio(gap / floor)} ×" if floor > 0.0 else "",
            share=8.0 + 92.0 * (log(gap) - low) / span if gap > 0.0 else 0.0,
        )
        for name, gap in rows
    ]


def rank_alternatives(finding: Finding) -> tuple[list[Alternative], list[Alternative]]:
    """Order alternatives by their gap; return those with 1 % of the improvement that was taken, and the others."""
    ranked = sorted(finding.alternatives, key=lambda one: one.gap_after if isfinite(one.gap_after) else inf)
    enough = finding.gap_before - MATTERS * (finding.gap_before - finding.gap_after)
    matters = [one.effect in finding.ambiguous_with or one.gap_after <= enough for one in ranked]
    pairs = list(zip(ranked, matters, strict=True))
    return [one for one, much in pairs if much], [one for one, much in pairs if not much]


def explain_rejection(other: Alternative, finding: Finding) -> str:
    """Say why an alternative was not taken."""
    if other.effect in finding.ambiguous_with:
        return "explains this recording as well: cannot be distinguished"
    behind = finding.evidence - other.evidence
    if not (isfinite(behind) and isfinite(other.gap_after)):
        return "the fit failed"
    if other.gap_after > LARGER * finding.gap_after:
        return f"gap {format_ratio(other.gap_after / finding.gap_after)} times as large"
    if behind <= 0.0:
        return "explains as much alone, but not together with the other effects"
    return f"{format_odds(behind)} times less likely"


def list_parameters(fit: Fit, baseline: Fit | None = None) -> list[ParameterRow]:
    """Every parameter of a model with its 95 % interval, and its value in the baseline."""
    before = baseline.parameters.values if baseline else {}
    errors = baseline.standard_errors if baseline else {}
    rows = []
    for name, value in fit.parameters.values.items():
        error = fit.standard_errors[name]
        low, high = (format_value(bound, error) for bound in _interval(name, value, error))
        rows.append(
            ParameterRow(
                name=name,
                unit=format_unit(name),
                before=format_value(before[name], errors[name]) if name in before else "–",
                after=format_value(value, error),
                error="–" if isnan(error) else format_error(error),
                interval="–" if isnan(error) else f"{low} … {high}",
                note=describe_parameter(fit, name),
            )
        )
    return rows


def _interval(name: str, value: float, error: float) -> tuple[float, float]:
    """The 95 % interval, as far as physics allows the parameter."""
    spec = SPEC_BY_NAME[name]
    return max(value - TWO_SIDED * error, spec.minimum), min(value + TWO_SIDED * error, spec.maximum)
