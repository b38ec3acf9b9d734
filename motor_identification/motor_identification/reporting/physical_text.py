"""Physical quantities in words: one table, and what limits it."""

from collections.abc import Iterator
from math import isnan

from motor_identification.reporting.numbers import format_error, format_measured, format_value
from motor_model.physical.quantities import PHYSICAL_BY_NAME
from motor_model.physical.result import PhysicalResult
from motor_model.text_table import align_columns

# Multiples of the unit that people say, so that a value has no exponent.
SPOKEN = {"inductance": (1e3, "mH"), "inertia": (1e7, "g·cm²"), "viscous_friction": (1e6, "µN·m·s/rad")}
SPOKEN |= {"torque_constant": (1e3, "mN·m/A")}
SPOKEN |= {f"{name}_torque": (1e3, "mN·m") for name in ("friction", "breakaway", "load", "step", "ripple")}
FIT_LEFT = "The fitted current is within {} RMS of the measured one."
TWO_SIDED = 1.96  # standard errors: within them of zero, a 95 % interval holds none


def format_physical(result: PhysicalResult) -> str:
    """Write the quantities in columns, for a terminal: values to the digits that their errors leave."""
    rows = [("quantity", "value", "± (1 σ)", "unit", "")]
    for name, value in result.values.items():
        scale, unit = SPOKEN.get(name, (1.0, PHYSICAL_BY_NAME[name].unit))
        value, error = scale * value, scale * result.standard_errors[name]
        shown = "–" if isnan(value) else format_value(value, error)
        rows.append((name, shown, "–" if isnan(error) else format_error(error), unit, _describe(result, name)))
    return align_columns(rows)


def list_physical_notes(result: PhysicalResult) -> Iterator[str]:
    """One sentence for everything that limits the physical quantities."""
    yield from result.notes
    for noise in result.current_noise:
        yield FIT_LEFT.format(format_measured(1e3 * noise, float("nan"), "mA"))


def _describe(result: PhysicalResult, name: str) -> str:
    value, error = result.values[name], result.standard_errors[name]
    if name in result.not_identifiable:
        return "not identifiable"
    if isnan(error):
        return "given"
    return "consistent with zero" if abs(value) < TWO_SIDED * error else ""
