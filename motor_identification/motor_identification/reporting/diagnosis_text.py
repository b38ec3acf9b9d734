"""A diagnosis as others see it: a sentence or two, a table."""

from math import inf, isnan, log10

from motor_identification.diagnosis.candidate_model import AT_FLOOR, LASTING
from motor_identification.diagnosis.result import Diagnosis, Finding, Verdict
from motor_identification.discrepancy.missing_torque import shape_in_words
from motor_identification.discrepancy.residual_maps import shape_left, where
from motor_identification.uncertainty.result import Fit
from motor_model.effects import EFFECT_BY_NAME, SPEC_BY_NAME

TOO_SHORT = "The recording is too short to keep any of its motion out of the fits: nothing can be judged by it."
MOST = 6  # effects that are listed by name in a sentence


def named(effect: str) -> str:
    """An effect's name as a person writes it."""
    return EFFECT_BY_NAME[effect].title


def listed(names: tuple[str, ...] | list[str], last: str = "and") -> str:
    """Names as a person lists them."""
    return "".join(names) if len(names) < 2 else ", ".join(names[:-1]) + f" {last} {names[-1]}"


def summary(diagnosis: Diagnosis) -> str:
    """What was missing, what it explains and what is left, in one to three sentences."""
    return " ".join(part for part in (_SUMMARIES[diagnosis.verdict](diagnosis), _next(diagnosis)) if part)


def fell(diagnosis: Diagnosis) -> str:
    """By how much the gap fell, beside the noise floor."""
    before, after = f"{diagnosis.gap_before:.3g}", f"{diagnosis.gap_after:.3g}"
    text = f"the gap on held-out motion falls from {before} to {after} rad/s ({against_floor(diagnosis)})"
    if diagnosis.gap_before > AT_FLOOR * diagnosis.noise_floor:
        return text
    lasting = [f"{held.joined(LASTING).gap:.3g}" for held in (diagnosis.before, diagnosis.after)]
    return f"{text}, in stretches of {LASTING:g} s, where the encoder's steps matter less, from {' to '.join(lasting)}"


def against_floor(diagnosis: Diagnosis) -> str:
    """The final gap as a multiple of the noise floor."""
    floor = diagnosis.noise_floor
    if floor <= 0.0:
        return "the recording says nothing of its own noise"
    return f"{diagnosis.gap_after / floor:.2g} × the noise floor of {floor:.3g}"


def quantity(name: str, value: float, error: float) -> str:
    """A parameter with its unit and standard error."""
    unit = SPEC_BY_NAME[name].unit
    unit = "" if unit == "–" else f" {unit}"
    text = f"{name} = {value:.{digits(value, error)}g}"
    return f"{text}{unit} (not identifiable)" if isnan(error) else f"{text} ± {error:.2g}{unit}"


def digits(value: float, error: float) -> int:
    """How many digits of a value its standard error leaves, with one more; between 3 and 8."""
    if value == 0.0 or not 0.0 < error < inf:
        return 4
    return int(min(max(log10(abs(value) / error) + 2.0, 3.0), 8.0))


def _found(findings: tuple[Finding, ...]) -> str:
    each = [
        f"{named(one.effect)} ({', '.join(quantity(name, *value) for name, value in one.parameters.items())})"
        for one in findings
    ]
    return _capital(listed(each) + (" was missing" if len(each) == 1 else " were missing"))


def _explained(diagnosis: Diagnosis) -> str:
    model = "it" if len(diagnosis.findings) == 1 else "them"
    return f"{_found(diagnosis.findings)}. With {model}, {fell(diagnosis)}."


def _nothing(diagnosis: Diagnosis) -> str:
    gap = f"{diagnosis.gap_after:.3g} rad/s, {against_floor(diagnosis)}"
    return f"Nothing is missing: the gap on held-out motion is {gap}."


def _unexplained(diagnosis: Diagnosis) -> str:
    shape = shape_in_words(shape_left(diagnosis.after))
    worst = f"It is worst {where(diagnosis.after, diagnosis.slot_share)}. {shape}".strip()
    missing = "is missing that no effect of the table explains"
    if diagnosis.findings:
        return f"{_each(diagnosis)} {_capital(fell(diagnosis))}. Something else {missing}. {worst}"
    left = f"the gap on held-out motion is {diagnosis.gap_after:.3g} rad/s, {against_floor(diagnosis)}"
    return f"Something {missing}: {left}. {worst}"


def _each(diagnosis: Diagnosis) -> str:
    """What is missing, and between what this recording cannot tell."""
    clear = tuple(one for one in diagnosis.findings if not one.ambiguous_with)
    parts = [f"{_found(clear)}."] if clear else []
    for one in diagnosis.findings:
        if one.ambiguous_with:
            names = listed([named(name) for name in (one.effect, *one.ambiguous_with)], "or")
            parts.append(f"{_capital(names)} is missing, and this recording cannot tell which.")
    return " ".join(parts)


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _undecided(diagnosis: Diagnosis) -> str:
    if diagnosis.findings:
        parts = [_each(diagnosis), f"{_capital(fell(diagnosis))}."]
    elif not diagnosis.after.counted.any():
        parts = [TOO_SHORT]
    else:
        gap = f"{diagnosis.gap_after:.3g} rad/s, {against_floor(diagnosis)}"
        parts = [f"Nothing is missing that this recording could show: the gap is {gap}."]
    if diagnosis.undetectable and not any(one.ambiguous_with for one in diagnosis.findings):
        parts.append(f"It could not have shown {unseen(diagnosis.undetectable)}.")
    return " ".join(parts)


def unseen(effects: tuple[str, ...]) -> str:
    """Effects by name, not too many of them."""
    names = [named(name) for name in effects]
    return listed(names, "or") if len(names) <= MOST else f"{', '.join(names[:MOST])} and {len(names) - MOST} others"


def _next(diagnosis: Diagnosis) -> str:
    profile = diagnosis.suggested_experiment
    return f"Record the profile '{profile}' and diagnose both recordings together." if profile else ""


_SUMMARIES = {
    Verdict.EXPLAINED: _explained,
    Verdict.NOTHING_MISSING: _nothing,
    Verdict.UNEXPLAINED: _unexplained,
    Verdict.UNDECIDED: _undecided,
}


def as_table(diagnosis: Diagnosis) -> str:
    """The gap effect by effect, what each one's parameters are and where it was seen, for a terminal."""
    rows = [("effect", "gap [rad/s]", "× floor", "parameters")]
    rows.append((_known(diagnosis.baseline), *_gap(diagnosis, diagnosis.gap_before), ""))
    for one in diagnosis.findings:
        values = ", ".join(quantity(name, *value) for name, value in one.parameters.items())
        also = "".join(f" or {name}" for name in one.ambiguous_with)
        rows.append((f"+ {one.effect}{also}", *_gap(diagnosis, one.gap_after), values))
    rows.append(("noise floor", *_gap(diagnosis, diagnosis.noise_floor), ""))
    widths = [max(len(row[i]) for row in rows) for i in range(4)]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    return "\n".join(lines + [f"{one.effect} was seen {one.where}" for one in diagnosis.findings])


def _known(fit: Fit) -> str:
    return "kv, ka" + "".join(f", {name}" for name in fit.parameters.effects)


def _gap(diagnosis: Diagnosis, gap: float) -> tuple[str, str]:
    floor = diagnosis.noise_floor
    return f"{gap:.4g}", f"{gap / floor:.3g}" if floor > 0.0 else "–"
