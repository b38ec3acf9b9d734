"""A motor that is told 0 V and does not slow down, and those that do, however slowly."""

from collections.abc import Callable
from dataclasses import replace
from math import exp, inf

import pytest
from fault_bench import ENCODER, KNOWN, LIMIT, SLOT, feed, turning

from motor_control.controller.faults.direction import unslowed
from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import Motion
from motor_model.sample import Sample

Course = Callable[[float], float]
PERIOD = 0.005  # [s]
FELT = Motion(steady_speed=50.0, steady_voltage=3.5)  # 171 rad/s of all the voltage
END = unslowed.SETTLED + unslowed.MOST * unslowed.WINDOW


def follow(
    course: Course, seconds: float = 10.0, config: Config = ENCODER, reference: float = 50.0, volts: float = 0.0
) -> tuple[float, float]:
    """When [s] a motor of such a speed [rad/s] by time is warned of, and stopped; infinite: never."""
    state, travel, warned = unslowed.State(), 0.0, inf
    for k in range(round(seconds / PERIOD)):
        now, speed = (k + 1) * PERIOD, course(k * PERIOD)
        before, travel = int(travel / SLOT), travel + speed * PERIOD
        motion = replace(FELT, slow_speed=speed, edges=int(travel / SLOT) - before)
        seen = Seen(Sample(0, speed, volts), speed, motion, reference, PERIOD, LIMIT, asked=volts)
        reason, state = unslowed.check(config, state, seen)
        warned = min(warned, now if state.warning else inf)
        if reason:
            assert "The motor is told 0 V, and for" in reason and "without slowing down" in reason
            return warned, now
    return warned, inf


def test_a_bridge_that_stays_on_is_said_and_then_stops_the_motor() -> None:
    """At all the voltage for ever, the controller asked for 0 V, and said nothing."""
    warned, stopped = follow(lambda t: 174.0 - 120.0 * exp(-t / 0.05))
    assert warned == pytest.approx(unslowed.SETTLED + 2.0 * unslowed.WINDOW, abs=0.02)
    assert stopped == pytest.approx(END, abs=0.05)
    assert follow(lambda _: 174.0, reference=0.0)[1] == pytest.approx(END, abs=0.05)
    assert follow(lambda _: 174.0, config=KNOWN)[1] == pytest.approx(0.3 + 6.0 * unslowed.SHORTEST, abs=0.05)
    assert feed([turning(174.0, 0.0)] * 1000, ENCODER, 50.0)[0] == ""  # nobody knows that 0 V were asked for


@pytest.mark.parametrize("tau", [0.05, 1.0, 5.0, 20.0, 60.0, 100.0])  # [s]
@pytest.mark.parametrize("config", [ENCODER, replace(KNOWN, time_constant=5.0)])
def test_no_disc_that_coasts_is_stopped_however_heavy(tau: float, config: Config) -> None:
    assert follow(lambda t: 174.0 * exp(-t / tau), 30.0, config, 0.0)[1] == inf


def test_a_disc_that_coasts_for_half_a_minute_is_not_even_warned_of() -> None:
    assert follow(lambda t: 174.0 * exp(-t / 20.0), 30.0, ENCODER, 0.0) == (inf, inf)


def test_two_channels_may_be_turned_by_a_load_which_is_said() -> None:
    warned, stopped = follow(lambda _: 100.0, config=replace(ENCODER, two_channels=True))
    assert warned < END and stopped == inf


def test_the_warning_does_not_change_for_ever() -> None:
    """Each other one is a line of the log."""
    config, said, state = replace(ENCODER, two_channels=True), set(), unslowed.State()
    motion = Motion(slow_speed=100.0, edges=8)
    for _ in range(4000):
        seen = Seen(Sample(0, 100.0, 0.0), 100.0, motion, 50.0, PERIOD, LIMIT, asked=0.0)
        _, state = unslowed.check(config, state, seen)
        said.add(state.warning)
    assert len(said) == 1 + unslowed.MOST - unslowed.SAID + 1 and state.warning


def test_what_is_driven_or_not_too_fast_or_not_counted_is_no_case() -> None:
    assert follow(lambda _: 174.0, volts=1.0) == (inf, inf)
    assert follow(lambda _: 59.0) == (inf, inf)
    assert follow(lambda _: 174.0, reference=float("nan")) == (inf, inf)  # a voltage of 0 V is somebody's wish
    assert follow(lambda _: 174.0, config=replace(ENCODER, slot=0.0)) == (inf, inf)
    assert follow(lambda _: 174.0, config=replace(ENCODER, stall_time=0.0)) == (inf, inf)
    assert follow(lambda _: 0.0, reference=0.0) == (inf, inf)


def test_of_few_edges_the_windows_are_longer() -> None:
    few = replace(ENCODER, spare=0.01)
    course = 50.0 * SLOT / unslowed.WINDOW
    assert follow(lambda _: course, 20.0, few, reference=0.0)[1] == pytest.approx(12.3, abs=0.2)


@pytest.mark.parametrize("config", [ENCODER, KNOWN])
def test_what_a_load_may_turn_is_said_and_not_stopped(config: Config) -> None:
    """Of 60 random motors one crept on at 0.59 rad/s, under a load as large as its friction."""
    most = unslowed.LOADS * config.spare * (174.0 if config is KNOWN else 171.4)
    warned, stopped = follow(lambda _: 0.95 * most, config=config, reference=0.0)
    assert warned < inf and stopped == inf
    assert follow(lambda _: 1.05 * most, config=config, reference=0.0)[1] < inf


def test_a_motor_of_which_nothing_is_known_is_not_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(globals(), "FELT", Motion())
    warned, stopped = follow(lambda _: 174.0)
    assert warned < inf and stopped == inf


def test_a_window_that_is_slower_begins_anew() -> None:
    """A hand that catches the shaft and lets go of it."""
    assert follow(lambda t: 174.0 if t < 2.5 else 150.0, 2.5 + END - 0.1)[1] == inf
    assert follow(lambda t: 174.0 if t < 2.5 else 150.0, 2.5 + END + unslowed.WINDOW)[1] < inf
