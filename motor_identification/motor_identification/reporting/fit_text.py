"""A fit in words: one sentence, the table of parameters, and what a user has to know before trusting it."""

from collections.abc import Iterator
from math import isnan

from motor_identification.reporting.names import capitalize, join_names
from motor_identification.reporting.numbers import (
    describe_absence,
    format_error,
    format_quantity,
    format_ratio,
    format_unit,
    format_value,
)
from motor_identification.uncertainty.result import Fit
from motor_model.effects import BASE, EFFECT_BY_NAME, EFFECTS
from motor_model.text_table import align_columns

SIGNIFICANT = 1e-3  # chance below which the residual's relation to the voltage is none
VISIBLE = 0.15  # correlation with the voltage: explains 2 % of the residual's power
ABOVE = 1.3  # residual over noise floor, below which there is nothing to explain
LARGE = 2.0  # residual over noise floor, from which on three quarters of its power are not the encoder's
REPEATS = 0.5  # correlation between residuals near each other, from which on they are not the encoder's
FOLLOWS = (
    "The residual correlates with the voltage (correlation {:.2f}): an effect is missing; run diagnose to name it."
)
NOT_WHITE = (
    "The residual is autocorrelated (correlation {:.2f}): an effect is missing or an unrecorded load acts; run "
    "diagnose to tell."
)
TOO_LARGE = (
    "The residual is {} × the noise floor: an effect is missing or an unrecorded load acts; run diagnose to tell."
)


def summarize_fit(fit: Fit) -> str:
    """Say what was found, how well it fits, and every caution."""
    errors = fit.standard_errors
    absent = {spec.name for effect in _absent(fit) for spec in EFFECT_BY_NAME[effect].parameters}
    there = {name: value for name, value in fit.parameters.values.items() if name not in absent}
    found = ", ".join(format_quantity(name, value, errors[name]) for name, value in there.items())
    return " ".join((f"{found}; {describe_residual(fit)}.", *list_cautions(fit)))


def describe_residual(fit: Fit) -> str:
    """Say how large the residual is beside the noise floor, and R²."""
    floor = f"noise floor {fit.noise_floor:.3g}" if fit.noise_floor > 0.0 else "noise level unknown"
    squared = "" if isnan(fit.r_squared) else f", R² {fit.r_squared:.6f}"
    return f"residual {fit.residual_rms:.3g} rad/s RMS ({floor}){squared}"


def list_cautions(fit: Fit) -> tuple[str, ...]:
    """One sentence for everything that limits the result, then the recording's own notes."""
    return (*_open_questions(fit), *_limits_hit(fit), *_residual_patterns(fit), *_next_experiment(fit), *fit.notes)


def _open_questions(fit: Fit) -> Iterator[str]:
    if fit.absent:
        are, without = ("is", "it") if len(fit.absent) == 1 else ("are", "them")
        named = capitalize(join_names([effect.replace("_", " ") for effect in fit.absent]))
        yield f"{named} {are} absent (consistent with zero): the fit is as good without {without}."
    if fit.not_identifiable:
        apart = " separately" if len(fit.not_identifiable) > 1 else ""
        yield f"This recording does not determine {join_names(fit.not_identifiable)}{apart}."
    for effect, rivals in fit.not_told_apart.items():
        others = join_names([EFFECT_BY_NAME[rival].phrase for rival in rivals], "or")
        yield f"This recording cannot distinguish {EFFECT_BY_NAME[effect].phrase} from {others}."


def _absent(fit: Fit) -> tuple[str, ...]:
    return tuple(effect for effect in fit.absent if effect in fit.parameters.effects)


def _limits_hit(fit: Fit) -> Iterator[str]:
    base = {spec.name for spec in BASE}
    owners = {spec.name: effect.name for effect in EFFECTS for spec in effect.parameters}
    for name, hit in fit.on_bound.items():
        if hit and owners.get(name) not in fit.absent:
            unit = format_unit(name) and f" {format_unit(name)}"
            limit = f"{name} = {fit.parameters.values[name]:.4g}{unit}"
            cure = "check the units of voltage and speed" if name in base else f"fit without {owners[name]}"
            yield f"{limit} is the limit of its search range: do not trust the value; {cure}."


def _residual_patterns(fit: Fit) -> Iterator[str]:
    left = fit.whiteness
    if residual_follows_voltage(fit):
        yield FOLLOWS.format(left.input_correlation)
    elif left.p_value < SIGNIFICANT and left.autocorrelation > REPEATS and _is_above_floor(fit):
        yield NOT_WHITE.format(left.autocorrelation)
    elif 0.0 < LARGE * fit.noise_floor < fit.residual_rms:
        yield TOO_LARGE.format(format_ratio(fit.residual_rms / fit.noise_floor))


def _next_experiment(fit: Fit) -> Iterator[str]:
    if fit.suggested_experiment:
        yield f"Record the profile '{fit.suggested_experiment}' and fit both recordings together."


def residual_follows_voltage(fit: Fit) -> bool:
    """Tell whether residuals depend on the voltage: not by chance, visibly, and well above what the encoder leaves."""
    left = fit.whiteness
    related = left.input_p_value < SIGNIFICANT and abs(left.input_correlation) > VISIBLE
    return related and _is_above_floor(fit)


def _is_above_floor(fit: Fit) -> bool:
    """Whether the encoder does not explain the residual."""
    return fit.residual_rms > ABOVE * fit.noise_floor


def format_fit(fit: Fit) -> str:
    """Write the parameters in columns, for a terminal: values to the digits that their errors leave."""
    rows = [("parameter", "value", "± (1 σ)", "unit", "")]
    for name, value in fit.parameters.values.items():
        error = fit.standard_errors[name]
        shown = "–" if isnan(error) else format_error(error)
        rows.append((name, format_value(value, error), shown, format_unit(name) or "–", describe_parameter(fit, name)))
    return align_columns(rows)


def describe_parameter(fit: Fit, name: str) -> str:
    """Say what limits one parameter; empty where nothing does."""
    error = fit.standard_errors[name]
    if any(spec.name == name for effect in _absent(fit) for spec in EFFECT_BY_NAME[effect].parameters):
        return "absent (consistent with zero)"
    if fit.on_bound.get(name):
        return "at the limit of its range"
    return "not identifiable" if isnan(error) else describe_absence(name, fit.parameters.values[name], error)
