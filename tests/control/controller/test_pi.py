"""The PI law: its formula, its limits, its anti-windup."""

from math import isfinite

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from motor_control.controller import pi
from motor_model.errors import MotorError

GAINS = pi.Config(kp=0.2, ki=2.5, limit=12.0)
LARGEST = 1.7e308


def finite(low: float = -LARGEST, high: float = LARGEST) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False, allow_infinity=False)


def test_terms_are_the_formula() -> None:
    terms, state = pi.update(GAINS, pi.State(1.0), error=4.0, feedforward=0.5, dt=0.01, low=-12.0, high=12.0)
    assert terms.error == 4.0
    assert terms.proportional == pytest.approx(0.8)
    assert terms.integral == state.integral == pytest.approx(1.0 + 2.5 * 4.0 * 0.01)
    assert terms.feedforward == 0.5
    assert terms.voltage == pytest.approx(0.8 + 1.1 + 0.5)
    assert not terms.saturated


def test_feedforward_is_inside_limit_and_anti_windup() -> None:
    terms, state = pi.update(GAINS, pi.State(5.0), error=4.0, feedforward=8.0, dt=0.01, low=-12.0, high=12.0)
    assert terms.voltage == 12.0 and terms.saturated
    assert state.integral == 5.0  # the sum was above the limit already


def test_integral_stops_where_the_sum_meets_the_limit() -> None:
    terms, state = pi.update(GAINS, pi.State(11.0), error=1.0, feedforward=0.0, dt=1.0, low=-12.0, high=12.0)
    assert state.integral == pytest.approx(12.0 - 0.2)
    assert terms.voltage == pytest.approx(12.0)


def test_saturated_integral_still_moves_away_from_the_limit() -> None:
    _, state = pi.update(GAINS, pi.State(12.0), error=-4.0, feedforward=20.0, dt=0.01, low=-12.0, high=12.0)
    assert state.integral == pytest.approx(12.0 - 0.1)


def test_no_windup_against_a_blocked_motor() -> None:
    state = pi.State()
    for _ in range(2000):  # 10 s
        _, state = pi.update(GAINS, state, error=50.0, feedforward=0.0, dt=0.005, low=-12.0, high=12.0)
    assert state.integral == pytest.approx(12.0 - 10.0)
    terms, _ = pi.update(GAINS, state, error=-10.1, feedforward=0.0, dt=0.005, low=-12.0, high=12.0)
    assert terms.voltage < 0.0  # nothing to unwind first


def test_new_gains_do_not_move_the_voltage_at_rest() -> None:
    state = pi.State(6.9)
    before, _ = pi.update(GAINS, state, error=0.0, feedforward=0.0, dt=0.005, low=-12.0, high=12.0)
    after, _ = pi.update(pi.Config(1.0, 40.0, 12.0), state, error=0.0, feedforward=0.0, dt=0.005, low=-12.0, high=12.0)
    assert before.voltage == after.voltage == 6.9


@pytest.mark.parametrize("values", [(-0.1, 1, 12), (0.1, float("nan"), 12), (0.1, 1, float("inf"))])
def test_settings_that_do_not_work_are_refused(values: tuple[float, float, float]) -> None:
    with pytest.raises(MotorError, match="finite number of at least 0"):
        pi.Config(*values)


@given(
    kp=finite(0.0, 1000.0),
    ki=finite(0.0, 10_000.0),
    limit=finite(0.0, 100.0),
    integral=finite(-100.0, 100.0),
    error=finite(),
    feedforward=finite(-100.0, 100.0),
    dt=finite(0.0, 10.0),
    ends=st.tuples(finite(-100.0, 100.0), finite(-100.0, 100.0)),
)
@example(kp=0.0, ki=0.0, limit=0.0, integral=0.0, error=9e307, feedforward=0.0, dt=2.0, ends=(0.0, 0.0))
def test_voltage_and_integral_stay_within_limits(
    kp: float,
    ki: float,
    limit: float,
    integral: float,
    error: float,
    feedforward: float,
    dt: float,
    ends: tuple[float, float],
) -> None:
    low, high = min(ends), max(ends)
    terms, state = pi.update(pi.Config(kp, ki, limit), pi.State(integral), error, feedforward, dt, low, high)
    assert low <= terms.voltage <= high
    assert isfinite(state.integral) and abs(state.integral) <= limit
    total = terms.proportional + terms.integral + terms.feedforward
    assert terms.saturated == (not low <= total <= high)
    moved = state.integral - min(max(integral, -limit), limit)
    assert moved * error >= 0.0  # never against the error
