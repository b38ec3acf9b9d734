"""The tables of the report: the ladder of gaps, parameters before and after, why an alternative lost."""

from dataclasses import dataclass
from math import isfinite, isnan, log

from motor_identification.diagnosis.result import Alternative, Diagnosis, Finding
from motor_identification.reporting.diagnosis_text import digits, listed, named
from motor_model.effects import SPEC_BY_NAME

LARGER = 1.3  # times the finding's gap, from which on an alternative's gap says enough


@dataclass(frozen=True)
class Rung:
    """One line of the ladder: a gap and how long its bar is."""

    name: str
    gap: float
    times: str
    share: float  # of the width, logarithmic
    detail: str


@dataclass(frozen=True)
class Row:
    """One parameter before and after."""

    name: str
    unit: str
    before: str
    after: str
    interval: str  # 95 %
    note: str


def ladder(diagnosis: Diagnosis) -> list[Rung]:
    """The gap before, after every effect, and the noise floor; bars by the logarithm."""
    rows = [("kv, ka" + "".join(f", {named(e)}" for e in diagnosis.baseline.parameters.effects),
             diagnosis.gap_before, "the model before")]  # fmt: skip
    for one in diagnosis.findings:
        also = listed([named(name) for name in one.ambiguous_with], "or")
        rows.append((f"+ {named(one.effect)}" + (f" (or {also})" if also else ""), one.gap_after, ""))
    rows.append(("noise floor", diagnosis.noise_floor, "timer and slots alone"))
    gaps = [gap for _, gap, _ in rows if gap > 0.0 and isfinite(gap)] or [1.0]
    low, span = log(min(gaps)), max(log(max(gaps)) - log(min(gaps)), 1e-9)
    floor = diagnosis.noise_floor
    return [
        Rung(
            name=name,
            gap=gap,
            times=f"{gap / floor:.2g} ×" if floor > 0.0 else "",
            share=8.0 + 92.0 * (log(gap) - low) / span if gap > 0.0 else 0.0,
            detail=detail,
        )
        for name, gap, detail in rows
    ]


def lost(other: Alternative, finding: Finding) -> str:
    """Why an alternative was not taken."""
    if other.effect in finding.ambiguous_with:
        return "explains this recording as well: not told apart"
    behind = finding.evidence - other.evidence
    if not (isfinite(behind) and isfinite(other.gap_after)):
        return "no fit"
    if other.gap_after > LARGER * finding.gap_after:
        return f"leaves {other.gap_after / finding.gap_after:.2g} times the gap"
    if behind <= 0.0:
        return "as likely, but not what the other findings need"
    return f"held-out motion is 10^{behind / log(10.0):.0f} times less likely"


def parameter_rows(diagnosis: Diagnosis) -> list[Row]:
    """Every parameter of the final model with its 95 % interval."""
    rows = []
    fit, before = diagnosis.model, diagnosis.baseline.parameters.values
    for name, value in fit.parameters.values.items():
        error = fit.standard_errors[name]
        on_bound = "on the edge of the search" if fit.on_bound.get(name) else ""
        note = "not identifiable" if isnan(error) else on_bound
        places = digits(value, error)
        low, high = (f"{value + way * 1.96 * error:.{places}g}" for way in (-1.0, 1.0))
        rows.append(
            Row(
                name=name,
                unit="" if SPEC_BY_NAME[name].unit == "–" else SPEC_BY_NAME[name].unit,
                before=f"{before[name]:.5g}" if name in before else "–",
                after=f"{value:.{places}g}",
                interval="–" if isnan(error) else f"{low} … {high}",
                note=note,
            )
        )
    return rows
