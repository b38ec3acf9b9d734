"""Which quantity a name's words tell, and where its unit knows better."""

import pytest

from motor_identification.logs.columns.names.quantity import (
    is_pulse,
    may_number_rows,
    tell_quantity,
)
from motor_identification.logs.columns.vocabulary import Quantity


@pytest.mark.parametrize(
    ("words", "unit", "quantity"),
    [
        ("speed", "", Quantity.SPEED),
        ("speed", "rev/s", Quantity.SPEED),
        ("target speed", "", Quantity.REFERENCE),
        ("speed command", "rad/s", Quantity.REFERENCE),  # what it should be
        ("battery voltage", "V", Quantity.SUPPLY),
        ("theta dot", "", Quantity.SPEED),
        ("velocity encoder", "", Quantity.SPEED),
        ("output speed", "", Quantity.SPEED),
        ("output", "", Quantity.DUTY),
        ("pwm", "count", Quantity.DUTY),
        ("pwm", "rev", Quantity.DUTY),  # of the other way
        ("input duty cycle", "", Quantity.DUTY),
        ("u pwm", "", Quantity.DUTY),
        ("pwm voltage", "", Quantity.VOLTAGE),
        ("input power", "", Quantity.VOLTAGE),  # which may be one of volts as well as a share
        ("input command", "", Quantity.VOLTAGE),
        ("r speed", "", Quantity.SPEED),  # the right one
        ("time", "m", Quantity.TIME),  # of a model: `time_m`
        ("yaw", "", Quantity.OTHER),
        ("yaw velocity", "", Quantity.SPEED),  # a joint
        ("foo", "", None),
    ],
)
def test_words_and_unit_tell_a_quantity(words: str, unit: str, quantity: Quantity | None) -> None:
    assert tell_quantity(tuple(words.split()), unit) is quantity


@pytest.mark.parametrize(
    ("words", "unit", "pulse"),
    [
        ("esc signal", "", True),
        ("esc 1 pwm", "", True),
        ("esc current", "", False),
        ("pwm", "us", False),
        ("servo 3", "us", True),
        ("servo 3", "", False),
        ("servo position", "us", False),
    ],
)
def test_pulses_to_a_controller_of_brushless_motors_are_told_from_what_it_measures(
    words: str, unit: str, pulse: bool
) -> None:
    assert is_pulse(tuple(words.split()), unit) is pulse


@pytest.mark.parametrize(
    ("words", "may"), [("sample", True), ("sample no", True), ("no", False), ("sample speed", False), ("n", False)]
)
def test_a_name_may_number_rows(words: str, may: bool) -> None:
    assert may_number_rows(tuple(words.split())) is may
