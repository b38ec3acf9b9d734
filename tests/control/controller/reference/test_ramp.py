"""The rate limit of the reference."""

import pytest

from motor_control.controller.reference.ramp import approach


def test_the_rate_limit_lets_through_what_it_lets() -> None:
    assert approach(10.0, 0.0, 0.0, 0.005) == (10.0, 0.0)
    assert approach(10.0, 0.0, 200.0, 0.005) == (1.0, pytest.approx(200.0))
    assert approach(-0.5, 0.0, 200.0, 0.005) == (-0.5, pytest.approx(-100.0))
    assert approach(10.0, 0.0, 200.0, 0.005, gentle=0.06) == (1.0, 0.0)  # a small step is left to the loop
    assert approach(10.0, 0.0, 200.0, 0.0) == (0.0, 0.0)
