"""Read numbers on the command line, within their ranges: types for argparse."""

import argparse
from collections.abc import Callable
from math import inf, nan


def positive(text: str) -> float:
    """Return a number above 0, as an argparse type."""
    number = _number(text)
    if not 0.0 < number < inf:
        raise argparse.ArgumentTypeError(f"{text} is not a number above 0")
    return number


def not_negative(text: str) -> float:
    """Return a number that is 0 or more, as an argparse type."""
    number = _number(text)
    if not 0.0 <= number < inf:
        raise argparse.ArgumentTypeError(f"{text} is not a number from 0 on")
    return number


def between(low: float, high: float) -> Callable[[str], float]:
    """Return an argparse type: a number from `low` to `high`."""

    def take(text: str) -> float:
        number = _number(text)
        if not low <= number <= high:
            raise argparse.ArgumentTypeError(f"{text} is not a number from {low:g} to {high:g}")
        return number

    return take


def whole_between(low: int, high: int) -> Callable[[str], int]:
    """Return an argparse type: a whole number from `low` to `high`."""

    def take(text: str) -> int:
        if not text.removeprefix("-").isdecimal() or not low <= int(text) <= high:
            raise argparse.ArgumentTypeError(f"{text} is not a whole number from {low} to {high}")
        return int(text)

    return take


def _number(text: str) -> float:
    """NaN, which is in no range, where the text is no number."""
    try:
        return float(text)
    except ValueError:
        return nan
