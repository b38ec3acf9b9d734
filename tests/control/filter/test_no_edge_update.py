"""What it tells that no edge comes, which direction a load decides, and the bounds of everything."""

import numpy as np
import pytest
from filter_bench import KV, NOISE, SLOT, TWO_CHANNELS, state, vector

from motor_control.filter.filter_state import Covariance, FilterState
from motor_control.filter.no_edge_update import (
    CERTAINTY,
    PREFERENCE,
    STANDS,
    clamp_state,
    truncate_normal,
    turn_by_load,
    update_without_edge,
)

LOOSE = Covariance((0.1 * SLOT) ** 2, 1e-3, 0.0, 1.0, 0.0, 0.01)


@pytest.mark.parametrize("excess", [-1.0, 0.0, 2.0, 7.9, 8.1, 17.0, 1000.0, 9_079.0, 12_345.6, 1e6, 1e7])
def test_the_truncated_normal_has_scipys_mean_and_variance(excess: float) -> None:
    from scipy.stats import truncnorm

    cut = truncate_normal(excess)
    assert cut.shrink < 1.0  # more than all of the variance would leave a covariance that is none, and soon NaN
    if excess < 20.0:  # further out SciPy loses its digits
        mean, variance = truncnorm.stats(-np.inf, -excess)
        assert cut.shift == pytest.approx(-mean, rel=1e-3)
        assert cut.shrink == pytest.approx(1.0 - variance, abs=3e-3)


def test_within_a_slot_silence_says_nothing() -> None:
    x = state(5.0, 0.9 * SLOT, covariance=LOOSE)
    assert update_without_edge(NOISE, x, 0.005) == x


def test_beyond_a_slot_the_prediction_is_cut_back() -> None:
    x = state(5.0, 1.3 * SLOT, covariance=LOOSE, since=0.02)
    after = update_without_edge(NOISE, x, 0.005)
    assert abs(after.estimate.motor.angle) < SLOT and after.estimate.motor.speed < 5.0
    assert after.history.silence == (0.005, False)


def overdue(time: float) -> FilterState:
    x = state(5.0, 1.01 * SLOT, load=0.3, covariance=LOOSE, since=time)
    for _ in range(round(time / 0.005)):
        x = update_without_edge(NOISE, x, 0.005)
    return x


def test_it_stands_once_an_edge_has_been_overdue_for_long_enough() -> None:
    assert not overdue(STANDS - 0.005).history.silence.stands
    after = overdue(STANDS + 0.01)
    assert after.history.silence.stands and after.estimate.motor.speed == 0.0 and after.estimate.load == 0.3


def test_the_direction_that_needs_the_smaller_load_wins_after_a_while() -> None:
    """ω under 5 V and a load of 8 V is −ω under a load of 2 V."""
    x, p = state(30.0, load=8.0), vector()
    for _ in range(round(CERTAINTY / 0.005)):
        x = turn_by_load(p, NOISE, x, 5.0, 0.005)
        assert x.estimate.motor.speed == 30.0
    after = turn_by_load(p, NOISE, x, 5.0, 0.005).estimate
    assert (after.motor.speed, after.load) == (-30.0, 2.0)
    assert turn_by_load(p, TWO_CHANNELS, x, 5.0, 0.005) == x


@pytest.mark.parametrize(("more", "doubts"), [(0.99, False), (1.01, True)])
def test_a_load_that_is_hardly_smaller_is_no_doubt(more: float, doubts: bool) -> None:
    x = state(30.0, load=5.0 + 0.5 * more * PREFERENCE * 12.0)
    assert (turn_by_load(vector(), NOISE, x, 5.0, 0.005).history.doubt > 0.0) == doubts


def test_nothing_grows_beyond_what_can_be() -> None:
    x = state(1e6, 1e3, 1e4, Covariance(1e6, 1.0, 1.0, 1e9, 1.0, 1e6))
    e = clamp_state(vector(), NOISE, x).estimate
    assert e.motor.speed == pytest.approx(120.0 / KV) and e.load == 36.0
    assert e.covariance.ss <= (120.0 / KV) ** 2 and e.covariance.ll <= 144.0
    inside = state(100.0, 0.01, 1.0)
    assert clamp_state(vector(), NOISE, inside) == inside
