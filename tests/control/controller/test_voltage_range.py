"""Which voltages a single-channel motor may get."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motor_control.controller import voltage_range as span

FAST, SLOW = 50.0, 5.0


@pytest.mark.parametrize(
    ("reference", "speed", "low", "high"),
    [
        (100.0, FAST, 0.0, 12.0),
        (40.0, 100.0, 0.0, 12.0),  # too fast: no brake
        (-100.0, -FAST, -12.0, 0.0),
        (0.0, FAST, 0.0, 0.0),
        (0.0, -SLOW, 0.0, 0.0),
        (0.0, 0.0, 0.0, 0.0),
        (-60.0, FAST, 0.0, 0.0),  # the other way, but not yet
        (-60.0, SLOW, -12.0, 0.0),
        (60.0, -SLOW, 0.0, 12.0),
        (3.0, 0.0, 0.0, 12.0),
        (-3.0, 0.0, -12.0, 0.0),
    ],
)
def test_rule(reference: float, speed: float, low: float, high: float) -> None:
    allowed = span.toward(reference, speed, 12.0, 10.0, reversing=False)
    assert (allowed.low, allowed.high) == (low, high)
    assert allowed.braking == (reference * speed < 0.0 and abs(speed) == FAST)


def test_a_reversal_goes_on_until_the_sign_has_changed() -> None:
    begun = span.toward(-60.0, 9.0, 12.0, 10.0, reversing=False)
    assert begun.reversing
    faster = span.toward(-60.0, 19.0, 12.0, 10.0, begun.reversing)
    assert faster.low == -12.0 and faster.reversing
    turned = span.toward(-60.0, -19.0, 12.0, 10.0, faster.reversing)
    assert turned.low == -12.0 and not turned.reversing


def test_a_reversal_that_does_not_come_is_given_up() -> None:
    allowed = span.toward(-60.0, 21.0, 12.0, 10.0, reversing=True)
    assert (allowed.low, allowed.high) == (0.0, 0.0)
    assert allowed.braking and not allowed.reversing


def test_two_channels_may_brake() -> None:
    assert span.both_ways(12.0)[:2] == (-12.0, 12.0)


@given(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3), st.floats(0.0, 100.0), st.booleans())
def test_never_away_from_the_reference(reference: float, speed: float, limit: float, reversing: bool) -> None:
    low, high, _, _ = span.toward(reference, speed, limit, 10.0, reversing)
    assert -limit <= low <= 0.0 <= high <= limit
    assert low == 0.0 or reference < 0.0
    assert high == 0.0 or reference > 0.0


@pytest.mark.parametrize(
    ("reference", "speed", "forward", "low", "high"),
    [
        (40.0, 100.0, 3.0, -12.0, 12.0),  # braked, for it is fast enough to be sure of the direction
        (3.0, SLOW, 0.9, 0.0, 12.0),  # not near a standstill
        (3.0, -FAST, 0.9, 0.0, 12.0),
        (0.0, FAST, 0.0, -12.0, 0.0),
        (0.0, -FAST, 0.0, 0.0, 12.0),
        (0.0, SLOW, 0.0, 0.0, 0.0),
        (3.0, SLOW, -1.5, -1.5, 12.0),  # what the ramp of the reference itself needs
        (-3.0, SLOW, 20.0, -12.0, 12.0),
        (-60.0, FAST, -4.5, -12.0, 0.0),  # a reversal is toward the reference
    ],
)
def test_where_an_observer_knows_the_direction(
    reference: float, speed: float, forward: float, low: float, high: float
) -> None:
    allowed = span.known(reference, speed, forward, 12.0, 10.0)
    assert (allowed.low, allowed.high) == (low, high)
    assert not allowed.braking and not allowed.reversing
