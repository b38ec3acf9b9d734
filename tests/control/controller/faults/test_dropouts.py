"""Edges that stop and go on as if nothing had been."""

from math import inf

import pytest
from fault_bench import LIMIT, SLOT

from motor_control.controller.faults import dropouts
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion
from motor_model.sample import Sample

MODEL = Config(slot=SLOT, fastest=174.0, kv=0.069, time_constant=0.08)
LEARNT = Motion(steady_speed=87.0, steady_voltage=6.0, most=87.0)


def told(
    speed: float, on: int, off: int, config: Config = MODEL, motion: Motion = LEARNT, spin: int = 0, gap: float = 6.0
) -> tuple[float, str]:
    """When [s] edges that come for `on` samples and are missing for `off` are told.

    spin: samples to full speed; gap: [V] at its samples, but for the last one.
    """
    state, rest = dropouts.State(), 0.0
    for k in range(800):
        phase = k % (on + off)
        now = speed * min((phase + 1) / spin, 1.0) if spin else speed
        rest += now / SLOT * 0.005 if phase < on else 0.0
        edges, rest = int(rest), rest - int(rest)
        period = SLOT / now
        seen_motion = Motion(edges=edges, steady_speed=motion.steady_speed, steady_voltage=motion.steady_voltage)
        look = Seen(
            Sample(k * 5_000_000, now, gap if on <= phase < on + off - 1 else 6.0, edge_period=period),
            now,
            seen_motion,
            87.0,
            0.005,
            LIMIT,
        )
        reason, state = dropouts.check(config, state, look)
        if reason:
            return k * 0.005, reason
    return inf, ""


@pytest.mark.parametrize("config", [MODEL, Config(slot=SLOT)])
@pytest.mark.parametrize(("on", "off"), [(10, 10), (4, 16), (20, 20)])
def test_a_loose_contact_is_told_at_the_third_gap(config: Config, on: int, off: int) -> None:
    when, reason = told(87.0, on, off, config)
    assert when == pytest.approx(3 * (on + off) * 0.005, abs=0.011)
    assert reason.startswith(f"Edges stop for {off * 0.005:.2g} s and go on at 87 rad/s as if nothing had been")


@pytest.mark.parametrize(("gap", "stops"), [(0.0, False), (1.0, False), (2.0, True), (6.0, True)])
def test_only_a_motor_that_is_driven_through_the_gap_is_one(gap: float, stops: bool) -> None:
    """A light motor that gets 6 V for 0.1 s and none for 0.2 s is at full speed before two edges are in."""
    assert (told(87.0, 20, 40, Config(slot=SLOT), gap=gap)[0] < inf) == stops


def test_gaps_that_come_seldom_are_none() -> None:
    assert told(87.0, 190, 10) == (inf, "")  # one in a second: 1.6 of them are never forgotten


def test_a_motor_that_spins_up_again_is_none() -> None:
    """Something stops the shaft five times a second; within four samples it is at full speed."""
    assert told(87.0, 20, 20, spin=12) == (inf, "")


def test_a_gap_of_less_than_five_periods_is_none() -> None:
    assert told(8.0, 40, 4) == (inf, "")  # 8 ms a period


def test_a_slow_motor_may_stop_and_go_on() -> None:
    assert told(20.0, 20, 20) == (inf, "")  # full voltage may have done it


def test_where_nothing_is_known_of_the_motor_it_is_none() -> None:
    assert told(87.0, 10, 10, Config(slot=SLOT), Motion()) == (inf, "")
    assert told(87.0, 10, 10, Config(slot=SLOT, stall_time=0.0)) == (inf, "")
    assert told(87.0, 10, 10, Config()) == (inf, "")
