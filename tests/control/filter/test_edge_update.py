"""What an edge tells: angle, speed, a start from rest, and that something has happened."""

from math import inf, log

import numpy as np
import pytest
from filter_bench import CERTAIN, NOISE, SLOT, TWO_CHANNELS, state, vector

from motor_control.filter.edge_update import (
    ALARM,
    raise_alarm,
    start_motion,
    update_at_edge,
)
from motor_control.filter.filter_state import Consistency, Covariance, FilterState
from motor_control.filter.load_jump import no_jumps

DOUBTFUL = Covariance(1e-5, 1e-3, 0.0, 4.0, 0.0, 0.01)


def test_turning_on_a_flank_is_one_slot_on() -> None:
    x = state(10.0, 0.9 * SLOT, covariance=DOUBTFUL, since=0.006)
    after = update_at_edge(vector(), NOISE, x, no_jumps(), 3.0, 1.0, False)
    assert after.state.history.edge.innovation == pytest.approx(0.1 * SLOT)
    assert abs(after.state.estimate.motor.angle) < 0.05 * SLOT
    assert after.state.estimate.motor.speed > 10.5 and after.margin == inf
    assert after.state.estimate.covariance.aa < 2.0 * NOISE.flank**2


@pytest.mark.parametrize(("voltage", "side"), [(3.0, 1.0), (-3.0, -1.0)])
def test_from_rest_it_starts_as_fast_as_the_voltage_makes_it_over_a_slot(voltage: float, side: float) -> None:
    after = start_motion(vector(("coulomb_friction",), ks=0.4), NOISE, state(0.0), voltage, 1.0).estimate
    push = 2.6 / 0.0055
    assert after.motor.speed == pytest.approx(side * np.sqrt(push * SLOT), rel=0.05)
    assert after.covariance.ss == pytest.approx(0.25 * after.motor.speed**2)


def drifting(drift: float) -> FilterState:
    x = state(40.0, since=0.002)
    return x._replace(history=x.history._replace(consistency=Consistency(drift, 0.01, 1.0)))


def test_an_alarm_is_raised_beyond_its_bound_only() -> None:
    quiet = raise_alarm(vector(), drifting(0.0), 1e-5, 1e-6, 0.99 * ALARM, 0.01)
    loud = raise_alarm(vector(), drifting(0.0), 1e-5, 1e-6, 1.01 * ALARM, 0.01)
    assert not quiet.raised and quiet.covariance == CERTAIN and quiet.drift == 0.99 * ALARM
    assert loud.raised and loud.drift == 0.0 and loud.covariance.ll > 0.2
    sigma = np.sqrt(CERTAIN.aa + 1e-6)
    assert not raise_alarm(vector(), drifting(0.0), 5.9 * sigma, 1e-6, 0.0, 0.01).raised
    assert raise_alarm(vector(), drifting(0.0), 6.1 * sigma, 1e-6, 0.0, 0.01).raised


def test_the_log_likelihood_is_that_of_the_innovation() -> None:
    x = state(10.0, 0.98 * SLOT, covariance=DOUBTFUL, since=0.006)
    after = update_at_edge(vector(), NOISE, x, no_jumps()[:0], 3.0, 1.0, False)
    total = DOUBTFUL.aa + NOISE.flank**2
    assert after.log_likelihood == pytest.approx(-0.5 * ((0.02 * SLOT) ** 2 / total + log(total)))


def test_two_channels_take_an_edge_back_at_the_flank_where_it_was() -> None:
    """The shaft turned round inside the hole, and comes out where it went in; the next flank is half a slot on."""
    x = state(0.3, 0.25 * SLOT, covariance=DOUBTFUL)
    back = update_at_edge(vector(), TWO_CHANNELS, x, no_jumps(), -3.0, -1.0, True).state
    assert back.history.edge.innovation == pytest.approx(-0.25 * SLOT) and back.history.edge.side == -1.0
    assert back.estimate.motor.angle == 0.0 and back.estimate.motor.speed < 0.0
    moved = back._replace(
        estimate=back.estimate._replace(motor=back.estimate.motor._replace(angle=-0.4 * SLOT, speed=-3.0))
    )
    on = update_at_edge(vector(), TWO_CHANNELS, moved, no_jumps(), -3.0, -1.0, True).state
    assert on.history.edge.innovation == pytest.approx(-0.1 * SLOT)
