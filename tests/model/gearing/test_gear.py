"""Gear ratios as text, as a message's number, and what they make of counts."""

from fractions import Fraction
from math import tau

import pytest

from motor_model.errors import MotorError
from motor_model.gearing.gear import angle_of_count, edge_angle, exact_gear, parse_gear_ratio


@pytest.mark.parametrize(
    ("text", "ratio"),
    [
        ("34.014", Fraction(17007, 500)),
        ("9291/273", Fraction(3097, 91)),
        ("(64/14)*(60/12)", Fraction(160, 7)),
        (" 64/14 * 60/12 ", Fraction(160, 7)),
        ("1", Fraction(1)),
        ("", Fraction(1)),
        ("0.5", Fraction(1, 2)),
    ],
)
def test_a_ratio_is_what_it_says_and_comes_back_from_a_message(text: str, ratio: Fraction) -> None:
    assert parse_gear_ratio(text) == ratio and exact_gear(float(ratio)) == ratio


@pytest.mark.parametrize("text", ["34:1", "-3", "3//4", "3/0", "1e3", "nan", "2 3", "*3", "3*", "1/1234567", "20000"])
def test_what_is_no_ratio_is_refused(text: str) -> None:
    with pytest.raises(MotorError, match="gear_ratio"):
        parse_gear_ratio(text)


def test_zero_in_a_message_is_no_gear() -> None:
    assert exact_gear(0.0) == exact_gear(1.0) == exact_gear(float("nan")) == 1


@pytest.mark.parametrize("text", ["34.014", "9291/273", "1"])
def test_the_angle_does_not_drift_however_many_counts(text: str) -> None:
    """At 2^40 counts the angle is the exact one to its last digit; the sum of as many floats is not."""
    gear, count = parse_gear_ratio(text), 2**40 + 12_345
    turns = Fraction(count) / (44 * gear)
    assert angle_of_count(count, 44, gear) == pytest.approx(tau * float(turns), rel=4e-16)
    more = angle_of_count(count + 1, 44, gear) - angle_of_count(count, 44, gear)
    assert more == pytest.approx(edge_angle(44, gear), abs=2.0 * tau * float(turns) * 2.3e-16)
    whole = 44 * gear.numerator  # counts of as many output turns as the ratio has in its denominator
    assert angle_of_count(whole * 1_000_000_000, 44, gear) == tau * (gear.denominator * 1_000_000_000)
