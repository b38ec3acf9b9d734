"""Currents that switch the output off: amperes as the board counts them, and what cannot be."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motor_driver.config import Config
from motor_driver.current_limits import MOST_BUDGET, CurrentLimits
from motor_driver.frames.from_host import Protect
from motor_model.errors import MotorError


def limited(gain: float, offset: float, *limits: float) -> Protect:
    """What a board with ticks of 500 ns is asked."""
    config = Config(current_gain=gain, current_offset=offset, current_limits=CurrentLimits(*limits))
    return config.current_limits.protect(config.current_gain, config.current_offset, 500)


def test_amperes_are_steps_of_the_boards_converter() -> None:
    """0.185 V/A are 37.9 steps an ampere; 5 A for a second beside 2 A for ever, at 500 ns a tick."""
    assert limited(0.185, 2.5, 5.0, 2.0, 1.0) == Protect(512, 189, 76, (558 - 90) * 31250)
    assert limited(-0.185, 2.5, 5.0, 2.0, 1.0).most == 189
    assert limited(0.185, 2.5, 5.0) == Protect(512, 189, 189, MOST_BUDGET)
    assert limited(0.185, 2.5) == limited(0.0, 2.5) == Protect(512, 0, 0, 0)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ((0.0, 2.5, 5.0), "needs a sensor on the board's A1: say its current_gain"),
        ((0.185, 2.5, 0.0, 2.0), "continuous_current is set, and current_limit is not: set both"),
        ((0.185, 2.5, 5.0, 5.01), "continuous_current is 5.01 A, and current_limit 5 A: it cannot be more"),
        ((0.185, 2.5, 13.5), "currents up to 13.5 A in both directions: lower current_limit \\(13.5 A\\)"),
        ((0.185, 0.1, 0.5), "currents up to 0.488 A in both directions"),
        ((0.185, 4.9, 0.5), "currents up to 0.488 A in both directions"),
        ((0.185, 0.0, 5.0), "A sensor of 0 V without a current does not show currents in both directions"),
        ((0.185, 0.045, 0.5), "A sensor of 0.045 V without"),
        ((0.185, 2.5, 0.2), "cannot resolve currents below 0.21 A with this sensor"),
        ((0.185, 2.5, 5.0, 0.84), "keeps a continuous_current of 0.84 A or more"),
    ],
)
def test_limits_that_cannot_be(values: tuple[float, ...], words: str) -> None:
    with pytest.raises(MotorError, match=words):
        limited(*values)


@pytest.mark.parametrize(
    "values",
    [(0.185, 2.5, 13.4), (0.185, 0.1, 0.48), (0.185, 0.05, 0.216), (0.185, 2.5, 0.22), (0.185, 2.5, 5.0, 0.85)],
)
def test_limits_that_can(values: tuple[float, ...]) -> None:
    assert limited(*values).most > 0


@given(st.floats(0.01, 10.0), st.floats(0.01, 4.99), st.floats(0.5, 1.1))
def test_what_is_taken_can_be_exceeded_in_both_directions(gain: float, offset: float, share: float) -> None:
    """Converter values of 0 and 1023 are further from no current than the limit: else it never switches off."""
    try:
        asked = limited(gain, offset, share * min(offset, 5.0 - offset) / gain)
    except MotorError:
        return
    assert 0 < asked.most < asked.zero and asked.most < 1023 - asked.zero
