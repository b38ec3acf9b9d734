"""The gear between encoder and output, as an exact ratio: counts become angles of the output without drift.

A ratio is encoder turns per output turn. Text such as "34.014", "9291/273" or "(64/14)*(60/12)" is taken as what it
says; 34.014 is not 34. A message carries it as a float64, from which the ratio is had back exactly: two ratios whose
denominators are at most MOST_TEETH differ by more than a float64 of their size rounds.
"""

import re
from fractions import Fraction
from math import isfinite, tau

from motor_model.errors import MotorError

MOST_TEETH = 1_000_000  # denominator and numerator of what a ratio is reduced to
LEAST, MOST = Fraction(1, 1000), Fraction(10_000)
_FACTOR = re.compile(r"\s*(\*|/|)\s*(\d+(?:\.\d+)?)\s*")


def parse_gear_ratio(text: str) -> Fraction:
    """Read a ratio: a decimal, a ratio of teeth, or a product of such; empty is 1.

    Raises:
        MotorError: it is none, or none that a gear has.
    """
    rest = text.strip().replace("(", " ").replace(")", " ")
    ratio, at = Fraction(1), 0
    while at < len(rest):
        factor = _FACTOR.match(rest, at)
        if factor is None or (factor[1] == "") != (at == 0) or (factor[1] == "/" and not float(factor[2])):
            raise MotorError(
                f"gear_ratio '{text}' is no ratio: give encoder turns per turn of the output, such as 34.014, 9291/273 "
                "or (64/14)*(60/12)."
            )
        ratio = ratio / Fraction(factor[2]) if factor[1] == "/" else ratio * Fraction(factor[2])
        at = factor.end()
    if not LEAST <= ratio <= MOST or max(ratio.numerator, ratio.denominator) > MOST_TEETH:
        raise MotorError(
            f"gear_ratio '{text}' must be from {float(LEAST):g} to {float(MOST):g}, and a ratio of whole numbers up to "
            f"{MOST_TEETH:,}."
        )
    return ratio


def exact_gear(ratio: float) -> Fraction:
    """Return the ratio that a message's number stands for; 0 (not said) is 1."""
    if not isfinite(ratio) or ratio <= 0.0:
        return Fraction(1)
    return Fraction(ratio).limit_denominator(MOST_TEETH)


def edge_angle(edges_per_revolution: int, gear: Fraction) -> float:
    """[rad] by which the output turns from one counted edge to the next."""
    return tau * gear.denominator / (edges_per_revolution * gear.numerator)


def angle_of_count(count: int, edges_per_revolution: int, gear: Fraction) -> float:
    """[rad] that the output has turned after so many counts: one rounding, however many there are."""
    return tau * (count * gear.denominator / (edges_per_revolution * gear.numerator))
