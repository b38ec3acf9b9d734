"""Periods that jump back and forth."""

import re
from math import tau

import numpy as np
import pytest

from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.faults.irregular_edges import IRREGULAR, State, check, follow_period
from motor_control.controller.motion import Motion, follow_motion
from motor_model.sample import Sample

SLOT = tau / 96


def mean_jump(periods: np.ndarray) -> float:
    """The largest mean jump in a row of periods [s]."""
    state, largest = State(), 0.0
    for period in periods:
        state = follow_period(state, float(period))
        largest = max(largest, state.jump)
    return largest


def test_random_edges_jump_and_motors_do_not() -> None:
    rng = np.random.default_rng(3)
    assert mean_jump(0.02 * rng.exponential(size=60)) > IRREGULAR
    assert mean_jump(0.02 * (1.0 + 0.05 * rng.standard_normal(2000))) < 0.1  # slots
    assert mean_jump(0.005 * np.exp(0.5 * np.arange(8))) == 0.0  # a motor that is braked hard
    assert mean_jump(np.tile([0.02, 0.022], 50)) < 0.1


def test_mean_jump_of_random_edges_is_as_the_page_says() -> None:
    rng, state, jumps = np.random.default_rng(1), State(), []
    for period in 0.01 * rng.exponential(size=20_000):
        state = follow_period(state, float(period))
        jumps.append(state.jump)
    assert np.mean(jumps) == pytest.approx(0.45, abs=0.01)


@pytest.mark.parametrize(("mean", "tick", "stops"), [(7e-6, 4e-6, False), (7e-6, 0.0, True), (0.01, 4e-6, True)])
def test_steps_of_the_timer_are_no_jumps(mean: float, tick: float, stops: bool) -> None:
    """A motor of 600 rad/s with 2,880 edges a turn, 4 or 8 us a period, was stopped; noise on a slow line still is."""
    rng, state = np.random.default_rng(4), State()
    for count in range(0, 4000, 5):  # a sample sees the latest of some edges
        end = float(rng.uniform(0.0, 1.0))
        begin = end - (mean if mean < 1e-3 else float(rng.exponential(mean)))
        stamped = (round(end / 4e-6) - round(begin / 4e-6)) * 4e-6
        state = follow_period(state, stamped, count=count, tick=tick)
        if state.irregular:
            break
    assert state.irregular == stops


@pytest.mark.parametrize("seen_every", [1, 3, 4, 7])
def test_flanks_as_uneven_as_a_sensors_are_a_motors(seen_every: int) -> None:
    """Four flanks of 0.6 to 1.4 slots, of which a sample sees the latest only; seed 30173 of no_false_stops stopped."""
    rng, state, largest = np.random.default_rng(2), State(), 0.0
    for count in range(0, 4000, seen_every):
        period = 0.01 * (0.6, 1.4, 0.75, 1.25)[count % 4] * (1.0 + 0.03 * rng.standard_normal())
        state = follow_period(state, period, count=count)
        largest = max(largest, state.jump)
        assert not state.irregular
    assert state.regular and (largest > IRREGULAR or seen_every == 4)
    for count in range(4000, 4000 + 20 * seen_every, seen_every):  # and then the line is lost
        state = follow_period(state, 0.01 * float(rng.exponential()), count=count)
    assert state.irregular


def test_a_period_that_is_not_known_is_no_jump() -> None:
    """Two channels: an edge that was taken back."""
    state = follow_period(follow_period(State(), 0.02), 0.0)
    assert state == State() and follow_period(state, 0.05) == State(0.05)


def test_a_standstill_and_a_turn_begin_anew() -> None:
    state = State(0.02, -0.1, 0.2)
    assert follow_period(state, 0.099).jump > 0.18 and follow_period(state, 0.1) == State()
    assert follow_period(state, 0.02, backward=True) == State(backward=True)


def noisy(rate: float, voltage: float = 6.0, stall_time: float = 0.5) -> float | None:
    """When [s] random edges at a rate [1/s] stop the motor, by the median of fifteen; None: not within 2 s."""
    config, found = Config(stall_time, slot=SLOT), []
    for seed in range(15):
        rng, state, motion = np.random.default_rng(seed), State(), Motion()
        count, at, period, when = 0, 0.0, 0.0, np.inf
        following = float(rng.exponential(1.0 / rate))
        for k in range(400):
            while at + following <= 0.005 * k:
                at, period, count = at + following, following, count + 1
                following = float(rng.exponential(1.0 / rate))
            sample = Sample(k * 5_000_000, 3.0, voltage, count, edge_period=period)
            motion = follow_motion(motion, sample, SLOT, 0.005, 12.0)
            reason, state = check(config, state, Seen(sample, 3.0, motion, 3.0, 0.005, 12.0))
            if reason:
                assert 1.3 < float(re.findall(r"by a factor of ([\d.]+) on average", reason)[0]) < 2.2
                when = 0.005 * k
                break
        found.append(when)
    median = float(np.median(found))
    return median if median < np.inf else None


@pytest.mark.parametrize(("rate", "most"), [(50.0, 0.4), (100.0, 0.2), (300.0, 0.1)])
def test_random_edges_stop_the_motor_whatever_its_speed_and_voltage(rate: float, most: float) -> None:
    for voltage in (0.5, 12.0):
        when = noisy(rate, voltage)
        assert when is not None and 0.02 < when < most


def test_what_is_no_fault() -> None:
    assert noisy(8.0) is None  # an ordinary loop may make a slow motor swing
    assert noisy(100.0, voltage=0.1) is None  # nothing is driven
    assert noisy(100.0, stall_time=0.0) is None


@pytest.mark.parametrize(
    ("time_constant", "voltage", "stops"), [(0.02, 2.5, False), (0.02, 4.5, True), (0.12, 2.5, True)]
)
def test_a_motor_that_crawls_starts_and_stops_between_its_edges(
    time_constant: float, voltage: float, stops: bool
) -> None:
    """Of seven random motors that held 0 rad/s with 4000 edges a turn one was stopped (seeds 97006, 97028, 98018).

    100 edges a second of the 5,000 at its top speed; a quarter of the stall torque does that in 6 ms, or in 14.
    """
    config, state = Config(slot=SLOT, fastest=5000.0 * SLOT, time_constant=time_constant, kv=0.01), State()
    rng, reasons = np.random.default_rng(5), []
    for count in range(60):
        sample = Sample(0, 0.3, voltage, count, edge_period=0.01 * float(rng.exponential()))
        motion = Motion(edges=1, slow_speed=100.0 * SLOT, slow_voltage=voltage)
        reason, state = check(config, state, Seen(sample, 0.3, motion, 0.0, 0.005, 12.0))
        reasons.append(reason)
    assert any(reasons) == stops


@pytest.mark.parametrize(
    ("time_constant", "voltage", "stops"), [(0.02, 3.0, False), (0.02, 4.5, True), (0.2, 3.0, True)]
)
def test_a_quick_motor_swings_from_sample_to_sample_and_one_period_of_each_is_told(
    time_constant: float, voltage: float, stops: bool
) -> None:
    """A load held at 0 rad/s by a loop at 200 Hz, 500 to 1,300 of 37,500 edges a second (seed 1100424)."""
    config, state = Config(slot=SLOT, fastest=37_500.0 * SLOT, time_constant=time_constant, kv=0.001), State()
    rng, reasons = np.random.default_rng(5), []
    for count in range(0, 600, 10):
        sample = Sample(0, 0.3, voltage, count, edge_period=0.0008 * float(rng.exponential()))
        motion = Motion(edges=10, slow_speed=1300.0 * SLOT, slow_voltage=voltage)
        reason, state = check(config, state, Seen(sample, 0.3, motion, 0.0, 0.005, 12.0))
        reasons.append(reason)
    assert any(reasons) == stops


def test_what_a_crawl_was_like_is_not_held_against_the_motion_that_follows() -> None:
    """Half a second after 0 rad/s a motor of 36,000 edges a second at its top speed was stopped (seed 300271)."""
    config, state = Config(slot=SLOT, fastest=36_000.0 * SLOT, time_constant=0.03, kv=0.01), State()
    crawl = np.random.default_rng(16).choice([0.0018, 0.0145], 40)
    for count, period in enumerate([*crawl, *[0.0003] * 10]):
        sample = Sample(0, 0.3, 1.2, count, edge_period=float(period))
        motion = Motion(edges=1, slow_speed=200.0 * SLOT, slow_voltage=1.2)
        reason, state = check(config, state, Seen(sample, 0.3, motion, 0.0, 0.005, 12.0))
        assert reason == ""


@pytest.mark.parametrize(("faster", "stops"), [(1.0, False), (4.0, True)])
def test_the_rate_is_that_of_the_edges_that_jump(faster: float, stops: bool) -> None:
    """A fast motor is braked into the swing of a slow one: its counted edges still told of its speed (seed 91142)."""
    state, reasons = State(), []
    swing = [0.052, 0.092, 0.023, 0.013, 0.030, 0.012, 0.089, 0.046, 0.02, 0.08, 0.03, 0.09, 0.02, 0.07]
    for count, period in enumerate([0.001] * 20 + [one / faster for one in swing]):
        sample = Sample(0, 3.0, 6.0, count, edge_period=period)
        motion = Motion(edges=1, slow_speed=200.0 * SLOT, slow_voltage=6.0)
        reason, state = check(Config(slot=SLOT), state, Seen(sample, 3.0, motion, 3.0, 0.005, 12.0))
        reasons.append(reason)
    assert state.irregular and any(reasons) == stops
