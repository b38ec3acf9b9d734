"""Counting edges: the speed, its averages, and what the last steady motion was."""

from math import exp, inf, tau

import pytest

from motor_control.controller.motion import FAST, HELD, SLOW, Motion, follow_motion
from motor_model.sample import Sample

SLOT = tau / 96


def follow(rows: list[tuple[float, float]], slot: float = SLOT, rate: float = 200.0) -> list[Motion]:
    """Rows of (speed [rad/s], voltage [V])."""
    motion, angle, seen = Motion(), 0.0, []
    for k, (speed, voltage) in enumerate(rows):
        angle += abs(speed) / rate
        sample = Sample(k * 5_000_000, speed, voltage, int(angle / SLOT))
        motion = follow_motion(motion, sample, slot, 1.0 / rate, 12.0)
        seen.append(motion)
    return seen


@pytest.mark.parametrize("slot", [SLOT, 0.0])
def test_the_averages_follow_the_speed(slot: float) -> None:
    seen = follow([(60.0, 5.0)] * 200, slot)
    assert seen[-1].speed == pytest.approx(60.0, rel=0.02)
    assert seen[9].speed == pytest.approx(60.0 * (1.0 - exp(-0.05 / FAST)), rel=0.1)


@pytest.mark.parametrize(("speed", "voltage"), [(100.0, 7.3), (3.0, 0.6), (-40.0, -3.0)])
def test_a_steady_motion_is_remembered(speed: float, voltage: float) -> None:
    last = follow([(speed, voltage)] * 200 + [(0.0, 12.0)] * 100)[-1]
    assert last.steady_speed == pytest.approx(abs(speed), rel=0.1)
    assert last.steady_voltage == pytest.approx(abs(voltage), rel=0.03)
    assert last.steady_way == (1 if voltage > 0.0 else -1)
    assert last.fastest(12.0) == pytest.approx(12.0 * abs(speed / voltage), rel=0.12)
    assert last.silent == pytest.approx(0.5, abs=0.03)


@pytest.mark.parametrize(("spike", "learns"), [(1.6, True), (2.6, False)])
def test_a_voltage_that_trembles_with_each_edge_is_steady_in_the_mean(spike: float, learns: bool) -> None:
    """Of 500 rad/s and 1,024 edges a turn nothing was learnt: spikes of an eighth of the limit, every fifth sample."""
    last = follow([(100.0, 6.2 + (spike if k % 5 == 4 else 0.0)) for k in range(200)])[-1]
    assert last.steady_speed == (pytest.approx(100.0, rel=0.1) if learns else 0.0)
    assert last.steady_voltage == (pytest.approx(6.2 + spike / 5.0, rel=0.05) if learns else 0.0)


def test_what_a_lost_line_does_first_is_not_taken_for_steady() -> None:
    """The averages are still close to one another while the law already answers with all the voltage."""
    last = follow([(100.0, 6.2)] * 200 + [(90.0 * 0.9**k, 12.0) for k in range(20)])[-1]
    assert last.steady_voltage == pytest.approx(6.2, rel=0.02)


def test_coasting_and_braking_are_no_steady_motion() -> None:
    assert follow([(100.0, 0.0)] * 200)[-1].fastest(12.0) == inf
    assert follow([(100.0, -3.0)] * 200)[-1].steady_speed == 0.0


def test_a_repeated_sample_changes_no_average() -> None:
    motion = follow([(60.0, 5.0)] * 50)[-1]
    assert follow_motion(motion, Sample(0, 1.0, 1.0, motion.edge_count), SLOT, 0.0, 12.0) == motion


@pytest.mark.parametrize(("regular", "learns"), [(True, True), (False, False)])
def test_nothing_is_learnt_from_edges_that_are_not_regular(regular: bool, learns: bool) -> None:
    """Stray edges under a rising voltage were taken for what the motor does with it."""
    motion, angle = Motion(), 0.0
    for k in range(200):
        angle += 60.0 / 200.0
        sample = Sample(k * 5_000_000, 60.0, 5.0, int(angle / SLOT))
        motion = follow_motion(motion, sample, SLOT, 0.005, 12.0, regular)
    assert (motion.steady_speed > 0.0) == learns


def test_edges_slower_than_a_standstill_teach_nothing() -> None:
    assert follow([(0.5, 0.6)] * 400)[-1].steady_speed == 0.0  # 7.6 edges a second
    assert follow([(1.0, 0.6)] * 400)[-1].steady_speed > 0.0


def test_a_slow_motion_under_a_load_does_not_make_the_motor_slow() -> None:
    """4 % of the top speed at 17 % of the voltage: so much back-EMF was expected that nothing could brake."""
    fast, slow = [(100.0, 7.3)] * 200, [(4.0, 2.0)] * 200
    assert follow(slow)[-1].fastest(12.0) == pytest.approx(24.0, rel=0.15)
    assert follow(fast + slow)[-1].fastest(12.0) == pytest.approx(100.0, rel=0.05)
    assert follow(fast)[-1].fastest(12.0) == pytest.approx(164.0, rel=0.05)
    jumped = follow_motion(follow(fast)[-1], Sample(10**9, 100.0, 7.3, 10**6), SLOT, 0.005, 12.0)  # of the count
    assert jumped.fastest(12.0) == pytest.approx(164.0, rel=0.05)


def test_what_holds_a_speed_is_learnt_of_even_voltages_alone() -> None:
    """After 0 V for a moment the average of the last 0.15 s is a sixth too low, and no voltage that holds the speed."""
    dip = [(50.0, 3.85)] * 200 + [(50.0, 0.0)] * 10 + [(50.0, 3.85)] * 100
    seen = follow(dip, slot=0.0)
    assert seen[199].held_voltage == pytest.approx(3.85, rel=0.01)
    assert len({motion.held_speed for motion in seen[199:210]}) == 1
    assert min(motion.held_voltage for motion in seen[199:]) > (1.0 - 1.5 * HELD) * 3.85 > seen[230].slow_voltage
    assert min(motion.steady_voltage for motion in seen[199:]) < 0.92 * 3.85  # good enough to tell faults by


@pytest.mark.parametrize(("share", "learnt"), [(0.9 * HELD, True), (1.5 * HELD, False)])
def test_a_voltage_that_still_moves_holds_no_speed(share: float, learnt: bool) -> None:
    """Of a ramp of the voltage the two averages differ by the slope times the difference of their time constants."""
    slope = share * 4.0 / (SLOW - FAST)
    rows = [(50.0, 4.0)] * 200 + [(50.0, 4.0 + slope * k / 200.0) for k in range(200)]
    last = follow(rows, slot=0.0)[-1]
    assert (last.held_voltage > 4.5) is learnt
