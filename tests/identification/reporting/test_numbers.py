"""Numbers as people read them: the digits that the standard error leaves, the unit, what is consistent with zero."""

from math import inf, nan

import pytest

from motor_identification.reporting.numbers import (
    describe_absence,
    describe_change,
    format_change,
    format_error,
    format_odds,
    format_quantity,
    format_ratio,
    format_value,
)


@pytest.mark.parametrize(
    ("value", "error", "shown"),
    [
        (0.3548277, 0.00032, "0.35483"),
        (0.35, 0.00032, "0.35000"),  # the digits are known, and are zeros
        (-0.3548277, 0.0316, "-0.355"),
        (0.35483, 0.000996, "0.3548"),  # 0.0010
        (0.39999986, 2.8e-07, "0.39999986"),
        (0.123456789123, 1e-12, "0.12345679"),  # 8 digits at most
        (3.527749e-22, 6.2e-07, "0"),
        (1.3e-05, 2.1e-07, "1.300e-05"),
        (12345.6, 321.0, "12350"),
        (12345.6, 3.21, "12345.6"),
        (0.0, 1.0, "0"),
        (1.23456789, nan, "1.235"),
        (1.23456789, inf, "1.235"),
        (1.23456789, 0.0, "1.235"),
    ],
)
def test_a_value_has_the_digits_that_its_error_leaves(value: float, error: float, shown: str) -> None:
    assert format_value(value, error) == shown


def test_an_error_has_two_digits() -> None:
    assert [format_error(error) for error in (0.00032, 4.5e-5, 1.04, 99.4, 99.6, 321.0)] == [
        "0.00032", "4.5e-05", "1", "99", "100", "320",
    ]  # fmt: skip


def test_a_quantity_has_its_unit() -> None:
    assert format_quantity("ks", 0.40001, 0.0021) == "ks = 0.4000 ± 0.0021 V"
    assert format_quantity("delay", 0.1, nan) == "delay = 0.1 s (not identifiable)"
    assert format_quantity("reverse_gain", 0.96, 0.0073) == "reverse_gain = 0.9600 ± 0.0073"
    assert [format_ratio(ratio) for ratio in (0.962, 27.8, 99.4, 148.2)] == ["0.96", "28", "99", "148"]


def test_a_change_has_the_digits_that_show_it() -> None:
    assert format_change(2.3212, 0.0803412) == "2.32 to 0.0803"
    assert format_change(2.98214, 2.97832) == "2.982 to 2.978"
    assert format_change(2.9821436, 2.9821441) == "2.98214 to 2.98214"
    assert describe_change(2.0, 1.0) == "falls from 2 to 1" and describe_change(1.0, 2.0) == "rises from 1 to 2"


def test_an_effect_may_be_consistent_with_none() -> None:
    """Within 1.96 standard errors of no effect; only the size of an effect can be."""
    assert describe_absence("ks", 1.95e-3, 1e-3) == "consistent with zero"
    assert describe_absence("ks", 1.97e-3, 1e-3) == ""
    assert describe_absence("bias_voltage", -1.95e-3, 1e-3) == "consistent with zero"
    assert describe_absence("reverse_gain", 1.01, 0.01) == "consistent with 1"
    assert describe_absence("reverse_gain", 0.01, 0.01) == ""
    assert describe_absence("ks", 0.0, nan) == ""
    assert describe_absence("kv", 0.0, 1.0) == "" and describe_absence("ripple_phase", 0.0, 1.0) == ""
    assert describe_absence("limit_voltage", 5.0, 1.0) == ""  # no limit is infinite


def test_odds_are_a_number_or_a_power_of_ten() -> None:
    odds = [format_odds(log_ratio) for log_ratio in (0.26, 5.0, 6.9, 6.92, 46.05, 2072.3)]
    assert odds == ["1.3", "148", "992", "10³", "10²⁰", "10⁹⁰⁰"]
