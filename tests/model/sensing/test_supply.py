"""A supply that is off is told from one that is low, in the motor's own measure."""

import pytest

from motor_model.sensing.supply import find_least_supply


@pytest.mark.parametrize(("expected", "least"), [(1.2, 0.3), (6.0, 1.5), (12.0, 3.0), (48.0, 3.0)])
def test_a_quarter_of_the_motors_voltage_is_a_supply_and_three_volts_are_one_for_any_motor(
    expected: float, least: float
) -> None:
    assert find_least_supply(expected) == pytest.approx(least)
