"""Full voltage, and no edge."""

from dataclasses import replace

import pytest
from fault_bench import ENCODER, KNOWN, SLOT, feed, turning


def test_a_stall_is_full_voltage_without_an_edge_for_stall_time() -> None:
    reason, when = feed([(0.0, -12.0, 0.0)] * 200, ENCODER)
    assert "blocked" in reason and 0.49 < when < 0.51
    assert feed([(0.0, 11.0, 0.0)] * 200, ENCODER)[0] == ""  # there is more to give
    assert feed([(0.0, 12.0, 0.0)] * 2000, replace(ENCODER, stall_time=0.0))[0] == ""


@pytest.mark.parametrize(("rate", "stalls"), [(2.0, True), (9.0, True), (14.0, False)])
def test_edges_too_slow_to_be_reported_are_no_motion(rate: float, stalls: bool) -> None:
    assert (feed([(0.0, 12.0, rate)] * 400, ENCODER)[0] != "") == stalls


FAST = turning(20.0, 2.0)
SLOW = replace(KNOWN, time_constant=2.0)


def test_edges_that_end_within_a_slot_are_a_line_that_is_lost_whatever_the_voltage() -> None:
    """A cable lost at 15 % of the top speed was told after 2.3 and 3.2 s: the observer took it for a load."""
    reason, when = feed([FAST] * 200 + [(0.0, 1.0, 0.0)] * 200, SLOW, 20.0)
    assert "they came at 19.9 rad/s, and then for 0.1" in reason and 1.09 < when < 1.12
    assert (
        feed([FAST] * 200 + [(0.0, 1.0, 0.0)] * 200, replace(ENCODER), 20.0)[0] == ""
    )  # how heavy it is, nobody knows


def test_edges_that_end_within_a_slot_are_told_under_all_the_voltage_too_and_never_where_stall_time_is_0() -> None:
    """Sooner than a stall is."""
    rows = [FAST] * 200 + [(0.0, 12.0, 0.0)] * 200
    reason, when = feed(rows, SLOW, 20.0)
    assert "they came at 19.9 rad/s" in reason and 1.09 < when < 1.12
    assert feed(rows[:300], replace(SLOW, stall_time=0.0), 20.0)[0] == ""


@pytest.mark.parametrize(("slots", "stops"), [(4.0, False), (6.0, True)])
def test_a_motor_that_needs_less_than_a_few_slots_to_stop_may_have_stopped(slots: float, stops: bool) -> None:
    """By a load, back-EMF and a voltage against it: w² τ/(4 w_top)."""
    lag = slots * SLOT * 4.0 * SLOW.fastest / 20.0**2
    rows = [FAST] * 200 + [(0.0, 1.0, 0.0)] * 60
    assert (feed(rows, replace(SLOW, time_constant=lag), 20.0)[0] != "") == stops


def test_who_is_braked_until_it_stands_and_who_is_caught_under_no_voltage_is_let_run() -> None:
    braked = [turning(20.0 * 0.9**k, -2.0) for k in range(60)]
    assert feed([FAST] * 200 + braked + [(0.0, 1.0, 0.0)] * 60, SLOW, 20.0)[0] == ""
    caught = [(0.0, 0.0, 0.0)] * 40 + [(0.0, 1.0, 0.0)] * 60
    assert feed([FAST] * 200 + caught, SLOW, 20.0)[0] == ""
    pulses = [(0.0, 0.0, 0.0), (0.0, 1.0, 0.0)] * 40
    assert "they came at" in feed([FAST] * 200 + pulses, SLOW, 20.0)[0]


def test_edges_of_a_flank_that_chatters_are_no_speed() -> None:
    rest = [(0.0, 0.5, 0.0)] * 100
    assert feed([*rest, turning(20.0, 0.5), *rest], SLOW, 0.5)[0] == ""
