"""A fit as others see it: a sentence, a table, JSON, a model file."""

from math import isfinite, isnan
from pathlib import Path
from typing import Any

from motor_identification.uncertainty.result import Fit
from motor_model.effects import EFFECT_BY_NAME, SPEC_BY_NAME
from motor_model.model_file import save

SIGNIFICANT = 1e-3  # chance below which the residual's relation to the voltage is none
VISIBLE = 0.15  # correlation with the voltage: explains 2 % of the residual's power
ABOVE = 1.3  # residual over noise floor, below which there is nothing to explain
FOLLOWS = "The residual still follows the voltage: an effect is missing (diagnose names it)."
REPEATS = 0.5  # correlation between residuals near each other, from which on they are not the encoder's
NO_NOISE = "The residual is not noise: an effect is missing, or something unrecorded moves the motor."


def sentence(fit: Fit) -> str:
    """What was found, and what a user has to know before trusting it."""
    found = ", ".join(_quantity(fit, name) for name in fit.parameters.values)
    parts = [
        f"{found}; residual {fit.residual_rms:.3g} rad/s RMS"
        + (f" (noise floor {fit.noise_floor:.3g})" if fit.noise_floor > 0.0 else "")
        + f", R² {fit.r_squared:.6f}."
    ]
    return " ".join(parts + list(cautions(fit)))


def _quantity(fit: Fit, name: str) -> str:
    unit, value = SPEC_BY_NAME[name].unit, fit.parameters.values[name]
    error = fit.standard_errors[name]
    return f"{name} = {value:.6g} {unit}" + (" (not identifiable)" if isnan(error) else f" ± {error:.2g}")


def cautions(fit: Fit) -> tuple[str, ...]:
    """One sentence for everything that limits the result, then the recording's own notes."""
    said = []
    if fit.not_identifiable:
        several = len(fit.not_identifiable) > 1
        verdict = "cannot be told apart in" if several else "cannot be determined from"
        said.append(f"{_listed(fit.not_identifiable)} {verdict} this recording.")
    for effect, rivals in fit.not_told_apart.items():
        others = " or ".join(EFFECT_BY_NAME[rival].phrase for rival in rivals)
        subject = EFFECT_BY_NAME[effect].phrase
        said.append(f"{subject[0].upper()}{subject[1:]} cannot be told from {others} in this recording.")
    walls = [name for name, hit in fit.on_bound.items() if hit]
    if walls:
        said.append(f"{_listed(walls)} ended on the edge of the search box: do not trust the value.")
    if still_follows(fit):
        said.append(FOLLOWS)
    elif fit.whiteness.p_value < SIGNIFICANT and fit.whiteness.autocorrelation > REPEATS:
        said.append(NO_NOISE)
    if fit.suggested_experiment:
        said.append(f"The profile '{fit.suggested_experiment}' would show it.")
    return (*said, *fit.notes)


def still_follows(fit: Fit) -> bool:
    """Whether what is left depends on the voltage: not by chance, visibly, and well above what the encoder leaves."""
    left = fit.whiteness
    related = left.input_p_value < SIGNIFICANT and abs(left.input_correlation) > VISIBLE
    return related and fit.residual_rms > ABOVE * fit.noise_floor


def _listed(names: tuple[str, ...] | list[str]) -> str:
    return names[0] if len(names) == 1 else ", ".join(names[:-1]) + " and " + names[-1]


def as_table(fit: Fit) -> str:
    """The parameters in columns, for a terminal."""
    rows = [("parameter", "value", "± (1 σ)", "unit", "")]
    for name, value in fit.parameters.values.items():
        error = fit.standard_errors[name]
        mark = "on bound" if fit.on_bound[name] else "not identifiable" if isnan(error) else ""
        rows.append((name, f"{value:.7g}", "–" if isnan(error) else f"{error:.2g}", SPEC_BY_NAME[name].unit, mark))
    widths = [max(len(row[i]) for row in rows) for i in range(5)]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows
    )


def as_json(fit: Fit) -> dict[str, Any]:
    """The form that interfaces promise; null where there is no number."""
    parameters = {
        name: {"value": _number(value), "standard_error": _number(fit.standard_errors[name])}
        for name, value in fit.parameters.values.items()
    }
    return {
        "bags": list(fit.uris),
        "model": {"effects": list(fit.parameters.effects), "parameters": parameters},
        "on_bound": [name for name, hit in fit.on_bound.items() if hit],
        "residual_rms": _number(fit.residual_rms),
        "noise_floor": _number(fit.noise_floor),
        "r_squared": _number(fit.r_squared),
        "correlations": {
            name: {other: _number(value) for other, value in row.items()} for name, row in fit.correlations.items()
        },
        "whiteness": {
            "p_value": _number(fit.whiteness.p_value),
            "autocorrelation": _number(fit.whiteness.autocorrelation),
            "lag": fit.whiteness.lag,
        },
        "input_correlation": {
            "p_value": _number(fit.whiteness.input_p_value),
            "correlation": _number(fit.whiteness.input_correlation),
            "lag": _number(fit.whiteness.input_lag),
        },
        "slot_irregularity": [_number(share) for share in fit.slot_irregularity],
        "not_identifiable": list(fit.not_identifiable),
        "not_told_apart": {effect: list(rivals) for effect, rivals in fit.not_told_apart.items()},
        "suggested_experiment": fit.suggested_experiment or None,
        "duration": fit.duration,
        "evaluations": fit.evaluations,
        "search": {
            "swarms": fit.search.swarms,
            "descents": fit.search.descents,
            "agreeing": fit.search.agreeing,
            "agreed": fit.search.agreed,
        },
        "message": sentence(fit),
    }


def _number(value: float) -> float | None:
    return value if isfinite(value) else None


def save_model(path: str | Path, fit: Fit, created: str) -> None:
    """Write the model file that `motor_sim`, `motor_control` and every command read; `created` is a date and time.

    Raises:
        ModelError: the file cannot be written.
    """
    origin = {
        "bags": list(fit.uris),
        "created": created,
        "residual_rms": fit.residual_rms,
        "noise_floor": fit.noise_floor,
        "not_identifiable": list(fit.not_identifiable),
    }
    errors = {name: error for name, error in fit.standard_errors.items() if isfinite(error)}
    save(path, fit.parameters, errors, origin)
