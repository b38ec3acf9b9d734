"""Currents that switch the output off: amperes as the board counts them, and what cannot be."""

import pytest

from motor_driver.current_limits import MOST_BUDGET, CurrentLimits
from motor_driver.frames import Protect
from motor_model.errors import MotorError


def test_amperes_are_steps_of_the_boards_converter() -> None:
    """0.185 V/A are 37.9 steps an ampere; 5 A for a second beside 2 A for ever, at 500 ns a tick."""
    assert CurrentLimits(0.185, 2.5, 5.0, 2.0, 1.0).protect(500) == Protect(512, 189, 76, (558 - 90) * 31250)
    assert CurrentLimits(-0.185, 2.5, 5.0, 2.0, 1.0).protect(500).most == 189
    assert CurrentLimits(0.185, 2.5, 5.0).protect(500) == Protect(512, 189, 189, MOST_BUDGET)
    assert CurrentLimits(0.185, 2.5).protect(500) == Protect(512, 0, 0, 0) == CurrentLimits().protect(500)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ((0.0, 2.5, 5.0), "needs a sensor on the board's A1: say its current_gain"),
        ((0.185, 2.5, 5.0, 5.01), "continuous_current is 5.01 A, and current_limit 5 A: it cannot be more"),
        ((0.185, 2.5, 13.5), "shows currents up to 13.5 A: lower current_limit \\(13.5 A\\)"),
        ((0.185, 0.1, 1.0), "shows currents up to 0.541 A"),
        ((0.185, 2.5, 0.2), "tells currents from 0.21 A on"),
        ((0.185, 2.5, 5.0, 0.2), "tells currents from 0.21 A on"),
    ],
)
def test_limits_that_cannot_be(values: tuple[float, ...], words: str) -> None:
    with pytest.raises(MotorError, match=words):
        CurrentLimits(*values)


@pytest.mark.parametrize("values", [(0.185, 2.5, 13.4), (0.185, 0.1, 0.53), (0.185, 2.5, 0.22), (0.185, 2.5, 5.0, 5.0)])
def test_limits_that_can(values: tuple[float, ...]) -> None:
    assert CurrentLimits(*values).protect(500).most > 0
