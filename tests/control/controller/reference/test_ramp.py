"""The rate limit of the reference."""

from math import isnan, nan

import pytest

from motor_control.controller.reference.ramp import approach, round_to_rest


def test_the_rate_limit_lets_through_what_it_lets() -> None:
    assert approach(10.0, 0.0, 0.0, 0.005) == (10.0, 0.0)
    assert approach(10.0, 0.0, 200.0, 0.005) == (1.0, pytest.approx(200.0))
    assert approach(-0.5, 0.0, 200.0, 0.005) == (-0.5, pytest.approx(-100.0))
    assert approach(10.0, 0.0, 200.0, 0.005, gentle=0.06) == (1.0, 0.0)  # a small step is left to the loop
    assert approach(10.0, 0.0, 200.0, 0.0) == (0.0, 0.0)


def test_next_to_0_is_0() -> None:
    assert round_to_rest(1e-6, 0.065) == round_to_rest(-0.0032, 0.065) == 0.0
    assert round_to_rest(0.0033, 0.065) == 0.0033 and round_to_rest(-0.0033, 0.065) == -0.0033
    assert round_to_rest(1e-6, 0.0) == 1e-6 and isnan(round_to_rest(nan, 0.065))
