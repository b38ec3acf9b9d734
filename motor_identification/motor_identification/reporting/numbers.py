"""Format numbers for people: a value to the digits that its standard error leaves, with its unit."""

from math import exp, floor, inf, isfinite, isnan, log, log10

from motor_model.effects import EFFECTS, SPEC_BY_NAME

MOST_DIGITS = 8  # of a value, however small its error: more than any encoder and clock are good for
FEW_DIGITS = 4  # of a value whose error is not known
PLAIN = (1e-4, 1e6)  # sizes that are written without an exponent
ODDS_IN_FULL = 1000.0  # beyond, odds are written as a power of ten
SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
TWO_SIDED = 1.96  # standard errors: within them of no effect, a 95 % interval holds "no effect"
# The parameter that says how large an effect is, and its value where there is none.
SIZES = {effect.parameters[0].name: effect.parameters[0].off for effect in EFFECTS if effect.parameters}


def format_value(value: float, error: float) -> str:
    """Round a value to the second significant digit of its standard error, at most 8 digits; 4 without an error."""
    if value == 0.0 or not isfinite(value) or not 0.0 < error < inf:
        return f"{value:.{FEW_DIGITS}g}"
    place = max(_exponent(error) - 1, floor(log10(abs(value))) - MOST_DIGITS + 1)
    rounded = round(value, -place)
    if rounded == 0.0:
        return "0"
    if PLAIN[0] <= abs(rounded) < PLAIN[1]:
        return f"{rounded:.{max(-place, 0)}f}"
    return f"{rounded:.{max(floor(log10(abs(rounded))) - place, 0)}e}"


def _exponent(error: float) -> int:
    """The decimal exponent of an error that is rounded to two digits: 0.000996 is 0.0010."""
    return int(f"{error:.1e}".partition("e")[2])


def format_error(error: float) -> str:
    """Round a standard error to two significant digits."""
    return f"{error:.2g}" if not 99.5 <= error < PLAIN[1] else f"{float(f'{error:.1e}'):.0f}"


def format_unit(name: str) -> str:
    """Return the unit of a parameter, empty for a pure number."""
    unit = SPEC_BY_NAME[name].unit
    return "" if unit == "–" else unit


def format_quantity(name: str, value: float, error: float) -> str:
    """Write a parameter with its standard error and unit: `ks = 0.4000 ± 0.0021 V`."""
    unit = format_unit(name) and f" {format_unit(name)}"
    if isnan(error):
        return f"{name} = {format_value(value, error)}{unit} (not identifiable)"
    return f"{name} = {format_value(value, error)} ± {format_error(error)}{unit}"


def format_measured(value: float, error: float, unit: str) -> str:
    """Write a measured value with its standard error and unit: `0.150 ± 0.004 V`."""
    known = f" ± {format_error(error)}" if isfinite(error) else ""
    return f"{format_value(value, error)}{known} {unit}"


def format_ratio(value: float) -> str:
    """Write how many times larger something is, to two digits: 1.3, 28, 148."""
    return f"{value:.2g}" if value < 99.5 else f"{value:.0f}"


def format_odds(log_ratio: float) -> str:
    """Write a likelihood ratio of its logarithm: 1.3, 150, then as a power of ten: 10²⁰."""
    if log_ratio < log(ODDS_IN_FULL):
        return format_ratio(exp(log_ratio))
    return "10" + f"{log_ratio / log(10.0):.0f}".translate(SUPERSCRIPTS)


def format_change(before: float, after: float) -> str:
    """Write from where to where a number changes, with the digits that show it: 3, or as many as it takes, up to 6."""
    pairs = ((f"{before:.{digits}g}", f"{after:.{digits}g}") for digits in (3, 4, 5))
    shown = next((pair for pair in pairs if pair[0] != pair[1]), (f"{before:.6g}", f"{after:.6g}"))
    return " to ".join(shown)


def describe_change(before: float, after: float) -> str:
    """Say from where to where a number falls, or rises."""
    return f"{'rises' if after > before else 'falls'} from {format_change(before, after)}"


def describe_absence(name: str, value: float, error: float) -> str:
    """Say that an effect's size is consistent with no effect (95 %); empty where it is not, or where nobody knows."""
    off = SIZES.get(name, inf)
    if not isfinite(off) or isnan(error) or abs(value - off) > TWO_SIDED * error:
        return ""
    return f"consistent with {'zero' if off == 0.0 else f'{off:g}'}"
