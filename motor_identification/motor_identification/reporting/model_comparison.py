"""Compare identified motors: their parameters side by side, and whether they differ by more than their errors."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import hypot, isfinite

from motor_identification.reporting.numbers import format_error, format_unit, format_value
from motor_model.parameters import Parameters
from motor_model.text_table import align_columns

DIFFERENT = 3.0  # standard errors of a difference: one in 370 equal pairs of parameters shows as much by chance
MANY = 1000.0
SAME = "No parameter of {} differs from that of {} by more than {:g} standard errors."
DIFFER = "{} differs from {} in {}."
LACKS = "{} has no {}: fit both with the same effects to compare them."


@dataclass(frozen=True)
class Identified:
    """A motor with the standard errors of its parameters, NaN where they are not known."""

    name: str
    parameters: Parameters
    errors: Mapping[str, float]

    def text(self, name: str) -> str:
        """Write a parameter's value with its error; "-" where the motor does not have it."""
        value, error = self.parameters.values.get(name), self.errors.get(name, float("nan"))
        if value is None:
            return "-"
        return format_value(value, error) + (f" ± {format_error(error)}" if isfinite(error) else "")


def compare_text(motors: Sequence[Identified]) -> str:
    """Write two or more motors beside each other; each is compared with the first."""
    names = list(dict.fromkeys(name for motor in motors for name in motor.parameters.values))
    head = ("parameter", "unit", *(motor.name for motor in motors), *(f"{motor.name} is" for motor in motors[1:]))
    rows = [
        (
            name,
            format_unit(name),
            *(motor.text(name) for motor in motors),
            *(_difference(motors[0], motor, name) for motor in motors[1:]),
        )
        for name in names
    ]
    said = [sentence for motor in motors[1:] for sentence in _sentences(motors[0], motor)]
    return "\n".join([align_columns([head, *rows]), *said])


def _difference(first: Identified, other: Identified, name: str) -> str:
    """Write how a parameter differs: in per cent of what is more than its error, else by how much, and in errors."""
    if name not in first.parameters.values or name not in other.parameters.values:
        return ""
    one, two = first.parameters.value(name), other.parameters.value(name)
    own = first.errors.get(name, float("nan"))
    if one == 0.0 or abs(one) <= DIFFERENT * own:  # a per cent of nothing says nothing
        share = f"{two - one:+.3g} {format_unit(name)}".rstrip()
    else:
        share = f"{100.0 * (two / one - 1.0):+.3g} %"
    deviations = deviations_of(first, other, name)
    known = f" ({format_deviations(deviations)} σ)" if isfinite(deviations) else ""
    return f"{share}{known}"


def format_deviations(deviations: float) -> str:
    """Write how many standard errors, to two digits; beyond a thousand the number says nothing more."""
    return f"{deviations:.2g}" if deviations < 99.5 else f"{deviations:.0f}" if deviations < MANY else f"> {MANY:g}"


def deviations_of(first: Identified, other: Identified, name: str) -> float:
    """Compute the difference of a parameter in its standard errors; NaN where those are not known."""
    error = hypot(first.errors.get(name, float("nan")), other.errors.get(name, float("nan")))
    if not error > 0.0:
        return float("nan")
    return abs(other.parameters.value(name) - first.parameters.value(name)) / error


def _sentences(first: Identified, other: Identified) -> list[str]:
    mine, theirs = first.parameters.values, other.parameters.values
    said = [LACKS.format(first.name, name) for name in theirs if name not in mine]
    said += [LACKS.format(other.name, name) for name in mine if name not in theirs]
    differing = [name for name in mine if name in theirs and deviations_of(first, other, name) > DIFFERENT]
    if differing:
        return [*said, DIFFER.format(other.name, first.name, ", ".join(differing))]
    return [*said, SAME.format(other.name, first.name, DIFFERENT)]
