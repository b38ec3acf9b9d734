"""Too few edges for the voltage."""

from dataclasses import replace
from math import exp, inf

import pytest
from fault_bench import ENCODER, KNOWN, LOST, SLOT, feed, turning

from motor_control.controller.faults.evidence import Config


@pytest.mark.parametrize("config", [ENCODER, KNOWN], ids=["learnt", "model"])
def test_edges_that_are_too_few_for_the_voltage(config: Config) -> None:
    """The line is lost at 100 rad/s, and the law answers with 12 V."""
    reason, when = feed(LOST + [(0.0, 12.0, 0.0)] * 200, replace(config, time_constant=0.02))
    assert "Edges do not fit the voltage: 12 V" in reason and 1.0 < when < 1.2
    reason, when = feed(LOST + [(4.0, 12.0, 60.0)] * 200, config)
    assert "Edges do not fit" in reason and 1.0 < when < 1.7
    assert feed(LOST + [turning(60.0, 12.0)] * 400, config)[0] == ""  # a heavy load
    assert feed(LOST + [turning(5.0, 7.5)] * 400, config, reference=5.0)[0] == ""  # heavier, but it does as told
    assert feed(LOST + [(0.0, 0.0, 0.0)] * 200, config)[0] == ""


@pytest.mark.parametrize(("volts", "stops"), [(5.5, True), (-5.5, False), (-11.0, True)])
def test_the_other_way_a_load_may_take_twice_as_much(volts: float, stops: bool) -> None:
    """A load of 0.22 of the voltage had helped the last motion, and with a breakaway of 0.15 it took 0.37 (950182)."""
    reason, when = feed([turning(10.0, 1.3)] * 200 + [(0.0, volts, 0.0)] * 400, ENCODER)
    assert ("Edges do not fit the voltage" in reason) == stops and (not stops or 1.0 < when < 2.5)


def test_a_heavy_disc_from_rest_is_no_fault() -> None:
    """Time constants of up to 2 s, where the model knows one of 80 ms."""
    for time_constant in (0.08, 0.5, 2.0):
        rows = [turning(174.0 * (1.0 - exp(-k * 0.005 / time_constant)), 12.0) for k in range(400)]
        assert feed(rows, KNOWN, 150.0)[0] == "" == feed(LOST + rows, ENCODER, 150.0)[0]


def test_a_motor_that_does_as_told_under_all_the_voltage_is_braked_by_more_than_a_load_where_a_model_says_so() -> None:
    """Hum on a lost line makes 6.5 rad/s whatever the voltage: it was full speed for ever."""
    for volts, told in ((7.8, False), (9.0, True), (12.0, True)):  # friction 0.5 V, back-EMF 0.3 V, 0.6 of 12 V
        reason, when = feed(LOST + [turning(5.0, volts)] * 600, KNOWN, reference=5.0)
        assert ("Edges do not fit the voltage" in reason) == told and (not told or 1.3 < when < 3.5)


def test_a_load_of_a_steady_motion_is_not_learnt_to_be_any_load() -> None:
    """Edges of hum from the start, steady under full voltage."""
    reason, when = feed([turning(6.5, 12.0)] * 1000, replace(KNOWN, fastest=60.0, kv=0.2, two_channels=True), 9.0)
    assert "Edges do not fit the voltage" in reason and 0.5 < when < 4.0


def test_a_voltage_that_comes_and_goes_is_judged_as_one_that_stays() -> None:
    """Every other sample came too late, and 0 V was sent: half of the voltage for ever."""
    rows = [(0.0, 12.0 if k % 2 else 0.0, 0.0) for k in range(400)]
    reason, when = feed(LOST + rows, replace(KNOWN, time_constant=0.02))  # it may have stopped within a slot
    assert "Edges do not fit the voltage" in reason and 1.0 < when < 1.4


@pytest.mark.parametrize(("off", "least", "most"), [(0, 1.5, 1.7), (2, 1.6, 1.8), (20, 3.0, inf)])
def test_a_voltage_that_is_taken_back_for_a_moment_does_not_stop_the_motor(off: int, least: float, most: float) -> None:
    """Stray edges close together: what was expected began from 0 again each time, and 12 V were on for 1.8 s."""
    rows = [(0.0, 0.0 if k % 40 >= 40 - off else 12.0, 0.0) for k in range(400)]
    strays = [(speed, volts, 15.0) for speed, volts, _ in rows]
    reason, when = feed(LOST + strays, ENCODER)
    assert least < when <= most and (reason == "") == (when == inf)


@pytest.mark.parametrize("volts", [4.2, 4.7, 6.0])
def test_a_load_that_is_turned_round_shows_no_edge_for_a_while(volts: float) -> None:
    """A load of 0.24 of the voltage drove the motor backward; its model knows of none, and foresees many slots."""
    config = replace(KNOWN, fastest=20.0, kv=0.6, time_constant=1.0, friction=0.1, two_channels=True)
    load, speed, rows, angle, edges, latest = 2.9, -2.7, [], 0.0, 0, 0.0
    for k in range(1200):
        voltage = 1.3 if k < 400 else volts
        speed += 0.005 * (voltage - load - 0.6 * speed) / 0.6
        angle += 0.005 * speed
        passed = int(angle // SLOT) != edges
        edges, latest = int(angle // SLOT), k * 0.005 if passed else latest
        shown = speed if k * 0.005 - latest < 0.1 else 0.0  # a standstill, to a plant
        rows.append((shown, voltage, abs(speed) / SLOT if passed or shown else 0.0))
    assert feed_edges(rows, config) == ""


@pytest.mark.parametrize("turns", [True, False])
def test_a_motor_that_crawled_has_not_been_pushed_for_as_long_as_it_shows_no_edge(turns: bool) -> None:
    """No edge for 0.7 s under 4 V, most of it held by a load; 7 V bring the next one after 0.12 s, or never."""
    config = replace(KNOWN, fastest=11.2, kv=1.07, time_constant=0.79, friction=0.9, two_channels=True)
    rows = [turning(1.0, 1.35)] * 200 + [(0.0, 4.0, 0.0)] * 140 + [(0.0, 7.0, 0.0)] * 24
    rows += [(0.5, 7.0, 10.0)] * 100 if turns else [(0.0, 7.0, 0.0)] * 100
    reason, when = feed(rows, config, 1.5)
    if turns:
        assert reason == ""
    else:
        assert "Edges do not fit the voltage" in reason and 1.83 < when < 2.0


def feed_edges(rows: list[tuple[float, float, float]], config: Config) -> str:
    """What is said of a motor whose edges come where its speed is not 0."""
    return feed(rows, config, reference=5.0)[0]
