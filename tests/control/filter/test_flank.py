"""Which flank passed: where, which way, and after how many that were missed."""

from math import inf

import pytest
from filter_bench import CERTAIN, NOISE, SLOT, TWO_CHANNELS, state, vector

from motor_control.filter.filter_state import Covariance
from motor_control.filter.flank import choose_direction, find_missed_edges, locate_flank, log_normal_cdf

DOUBTFUL = Covariance(1e-5, 1e-3, 0.0, 4.0, 0.0, 0.01)


def test_the_logarithm_of_the_normal_distribution_is_continuous_and_right() -> None:
    from scipy.stats import norm

    for x in (-30.0, -8.001, -7.999, -1.0, 0.0, 3.0):
        assert log_normal_cdf(x) == pytest.approx(norm.logcdf(x), rel=2e-3)


@pytest.mark.parametrize(("speed", "side"), [(1.0, 1.0), (-1.0, -1.0)])
def test_under_an_opposing_voltage_the_likelier_direction_is_chosen(speed: float, side: float) -> None:
    """The latest flank was passed forwards; now the motor is near standstill, in the middle of a slot or at its end."""
    angle = 0.95 * SLOT if side > 0.0 else 0.45 * SLOT
    x = state(1.0, angle, covariance=DOUBTFUL._replace(ss=0.09))
    x = x._replace(estimate=x.estimate._replace(motor=x.estimate.motor._replace(speed=speed)))
    way = choose_direction(vector(), NOISE, x, -6.0, 1.0)
    assert way.is_open and way.side == side and way.margin > 1.0
    driven = choose_direction(vector(), NOISE, x, 6.0, 1.0)
    assert (driven.side, driven.margin, driven.is_open) == (1.0, inf, False)


def test_a_second_channel_says_the_direction() -> None:
    x = state(1.0, covariance=DOUBTFUL)
    assert choose_direction(vector(), TWO_CHANNELS, x, 6.0, -1.0).side == -1.0


def test_after_a_turn_the_flank_is_somewhere_in_the_slot() -> None:
    x = state(1.0, 0.4 * SLOT)
    on, back = locate_flank(NOISE, x, 1.0, 1.0), locate_flank(NOISE, x, -1.0, 1.0)
    assert (on.angle, on.variance) == (SLOT, NOISE.flank**2)
    assert (back.angle, back.variance) == (0.5 * SLOT, NOISE.turn**2)


def test_edges_that_the_motion_should_have_shown_are_missed_ones() -> None:
    x = state(40.0, 1.98 * SLOT, covariance=CERTAIN._replace(aa=(0.02 * SLOT) ** 2)).estimate
    flank = locate_flank(NOISE, state(40.0, 1.98 * SLOT), 1.0, 1.0)
    found = find_missed_edges(NOISE, x, flank, 1.0, 0.0)
    assert (found.angle, found.missed) == (pytest.approx(2.0 * SLOT), 1.0)
    near = x._replace(motor=x.motor._replace(angle=1.02 * SLOT))
    assert find_missed_edges(NOISE, near, flank, 1.0, 0.0) == (flank.angle, 0.0)
