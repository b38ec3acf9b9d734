"""A controller that is not scheduled all the time does not let its motor swing: within 5 %, or 0 V with a reason."""

from dataclasses import replace
from math import exp, inf

import numpy as np
import pytest
from bench_board import DEFAULTS
from held_up import BUSY_1_KHZ, BUSY_200_HZ, REFERENCE, Load, Pause, draw_pauses, run, steady
from hypothesis import given, settings
from hypothesis import strategies as st
from tiers import keep_fast

from motor_control.controller import pi
from motor_control.controller.faults.evidence import Config as FaultConfig
from motor_control.controller.motion import Motion
from motor_control.controller.timing.timekeeping import (
    FORGET,
    KEPT,
    MARGIN,
    MOST_KEPT,
    NEAR,
    RESIGNED,
    Timekeeping,
    count_lapse,
    find_longest_hold,
    keep_time,
    limit_held,
    regain,
)
from motor_control.controller.voltage_range import both_ways, toward
from motor_model.effects import INDEX
from motor_model.parameters import PAPER_KA, PAPER_KV

GAINS = pi.Config(DEFAULTS["kp"], DEFAULTS["ki"], 12.0)
KNOWN = FaultConfig(kv=PAPER_KV, time_constant=PAPER_KA / PAPER_KV)
MOTION = Motion(held_speed=50.0, held_voltage=3.85, steady_way=1)
TIMEOUT = 0.1  # [s] `sample_timeout`
MOTORS = [(1000.0, False, 1.0), (200.0, False, 1.0), (1000.0, True, 1.0), (200.0, True, 4.0), (1000.0, False, 4.0)]


def overshoots(hold: float) -> bool:
    """Whether a motor passes its reference where each voltage of a proportional gain is held for so long [s]."""
    error, kept = 1.0, exp(-hold * PAPER_KV / PAPER_KA)
    return error * kept - GAINS.kp / PAPER_KV * error * (1.0 - kept) < 0.0


def test_an_answer_may_be_held_as_long_as_the_motor_does_not_pass_its_reference() -> None:
    longest = find_longest_hold(GAINS, KNOWN, None, 1.0)
    assert not overshoots(0.999 * longest) and overshoots(1.001 * longest)
    assert longest == pytest.approx(0.0236, abs=1e-4)


def test_a_motor_without_a_model_is_known_by_its_last_steady_motion_and_its_gains() -> None:
    learnt = find_longest_hold(GAINS, FaultConfig(), MOTION, 1.0)
    assert learnt == pytest.approx(find_longest_hold(GAINS, KNOWN, MOTION, 1.0), rel=0.15)
    assert find_longest_hold(GAINS, FaultConfig(), Motion(), 0.02) == 0.02
    assert find_longest_hold(GAINS, FaultConfig(), None, 0.02) == 0.02
    assert find_longest_hold(pi.Config(0.2, 0.0, 12.0), FaultConfig(), MOTION, 0.02) == 0.02
    assert find_longest_hold(pi.Config(0.0, 2.5, 12.0), KNOWN, MOTION, 0.02) == 0.02


@pytest.mark.parametrize("scale", [0.1, 10.0])
def test_the_longest_hold_grows_with_the_motors_time_constant(scale: float) -> None:
    slow = replace(KNOWN, time_constant=scale * KNOWN.time_constant)
    assert find_longest_hold(GAINS, slow, None, 1.0) == pytest.approx(
        scale * find_longest_hold(GAINS, KNOWN, None, 1.0)
    )


def test_time_is_kept_up_to_the_longest_hold_and_with_samples_that_are_in_time() -> None:
    kept = keep_time(Timekeeping(kept=1.0), 0.02, 0.02, TIMEOUT)
    assert (kept.kept, kept.cautious) == (1.02, False)
    for missed in (
        keep_time(kept, 0.0201, 0.02, TIMEOUT),
        keep_time(kept, 0.001, 0.02, TIMEOUT, 0.025),
    ):
        assert (missed.kept, missed.cautious, missed.waiting) == (0.0, True, "")
    assert "held up for 20 ms" in keep_time(kept, 0.0201, 0.02, TIMEOUT).caution
    assert "held up for 25 ms" in keep_time(kept, 0.005, 0.02, TIMEOUT, 0.025).caution


@pytest.mark.parametrize(("more", "cautious"), [(-1e-6, True), (1e-6, False)])
def test_caution_ends_when_time_is_kept_and_the_motor_is_back_or_will_not_be(more: float, cautious: bool) -> None:
    back, away = REFERENCE * (1.0 + 0.99 * MARGIN), REFERENCE * (1.0 + 1.01 * MARGIN)
    timing = Timekeeping(kept=KEPT * TIMEOUT + more, cautious=True)
    assert regain(timing, REFERENCE, back, TIMEOUT).cautious is cautious
    assert regain(timing, REFERENCE, away, TIMEOUT).cautious
    timing = Timekeeping(kept=RESIGNED * TIMEOUT + more - 0.001, cautious=True)
    assert keep_time(timing, 0.001, 0.02, TIMEOUT).cautious is cautious


def lapse(before: Timekeeping, gap: float = 0.03, late: float = 0.025) -> Timekeeping:
    """One sample of a loop that drives the motor, and one in time."""
    after = count_lapse(before, keep_time(before, gap, 0.02, TIMEOUT, late), gap, TIMEOUT)
    return keep_time(after, 0.001, 0.02, TIMEOUT)


def test_after_the_second_lapse_time_has_to_be_kept_for_longer_and_longer() -> None:
    timing, waits = lapse(Timekeeping()), []
    assert timing.waiting == ""  # one is answered as ever
    for _ in range(8):
        timing = lapse(timing)
        waits.append(timing.wait)
        assert "gets 0 V until it has kept its time for" in timing.waiting
        assert lapse(timing).lapses <= timing.lapses  # at 0 V there is none
        almost = keep_time(timing, timing.wait - 0.0011, 1e3, TIMEOUT)
        assert almost.waiting and not keep_time(almost, 0.0002, 1e3, TIMEOUT).waiting
        timing = replace(timing, wait=0.0)
    assert waits[:4] == [KEPT * TIMEOUT * 2.0**k for k in range(4)] and waits[-1] == KEPT * TIMEOUT * MOST_KEPT


@pytest.mark.parametrize(("borne", "stale"), [(0.0, [True, True, True]), (0.02, [False, False, True])])
def test_old_samples_get_what_holds_the_speed_for_as_long_as_one_may_be_old(borne: float, stale: list[bool]) -> None:
    """Where it is known; a pause between two of them counts for no more than an answer may be held."""
    first = keep_time(Timekeeping(), 0.03, 0.019, TIMEOUT, 0.025, borne)
    second = keep_time(first, 0.09, 0.019, TIMEOUT, 0.025, borne)
    third = keep_time(second, 0.001, 0.019, TIMEOUT, 0.025, borne)
    assert [one.stale for one in (first, second, third)] == stale
    fresh = keep_time(third, 0.001, 0.019, TIMEOUT)
    assert (fresh.stale, fresh.old, first.old, third.old) == (False, None, 0.0, pytest.approx(0.02))
    lapses = [count_lapse(*pair, 0.03, TIMEOUT).lapses > 0.0 for pair in ((Timekeeping(), first), (second, third))]
    assert lapses == [stale[0], not stale[1]]  # one 0 V is one lapse


@pytest.mark.parametrize(("seconds", "waits"), [(0.4 * FORGET * TIMEOUT, True), (0.6 * FORGET * TIMEOUT, False)])
def test_a_lapse_is_forgotten(seconds: float, waits: bool) -> None:
    timing = keep_time(lapse(Timekeeping()), seconds, inf, TIMEOUT)
    assert bool(lapse(timing).waiting) is waits


@pytest.mark.parametrize(("gap", "counts"), [(TIMEOUT, False), (1.01 * TIMEOUT, True)])
def test_a_silence_that_ends_a_run_is_a_lapse_as_well(gap: float, counts: bool) -> None:
    assert (lapse(Timekeeping(), gap, late=0.0).lapses > 0.0) is counts


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_what_may_be_held_is_what_held_this_speed(way: float) -> None:
    motion, allowed = replace(MOTION, steady_way=int(way)), toward(way, 0.0, 12.0, 10.0, False)
    slow = limit_held(allowed, motion, way * 50.0, way * 50.0, way * 10.0)
    assert sorted((abs(slow.low), abs(slow.high))) == pytest.approx([3.85 * 0.96, 3.85 * 1.04])
    assert slow.low * way > 0.0 and slow.high * way > 0.0
    fast = limit_held(allowed, motion, way * 50.0, way * 50.0, way * 50.0 * (1.001 + MARGIN))
    assert 0.0 in (fast.low, fast.high)
    assert limit_held(allowed, motion, way * 50.0, way * 50.0, way * 50.0 * (0.999 + MARGIN)) == slow
    ramp = limit_held(allowed, motion, way * 50.0, way * 12.0, way * 10.0)  # its beginning may need less, no more
    assert (ramp.low, ramp.high) == (fast.low, fast.high)


@pytest.mark.parametrize(("share", "known"), [(0.79, False), (0.81, True), (1.24, True), (1.26, False), (-1.0, False)])
def test_of_another_speed_nothing_is_known(share: float, known: bool) -> None:
    assert NEAR == (0.8, 1.25)
    span = limit_held(both_ways(12.0), MOTION, share * 50.0, share * 50.0, 0.0)
    assert (span != both_ways(12.0)) is known
    assert not known or span.high == pytest.approx(1.04 * share * 3.85)


def test_where_nothing_is_known_or_asked_for_nothing_is_limited() -> None:
    assert limit_held(both_ways(12.0), Motion(), 50.0, 50.0, 0.0) == both_ways(12.0)
    assert limit_held(both_ways(12.0), MOTION, 0.0, 0.0, 20.0) == both_ways(12.0)
    braked = toward(50.0, -40.0, 12.0, 10.0, False)
    assert limit_held(braked, MOTION, 50.0, 50.0, -40.0) == braked  # 0 V, whatever held the speed


@pytest.mark.parametrize("load", [BUSY_1_KHZ, BUSY_200_HZ], ids=["busy at 1 kHz", "busy at 200 Hz"])
@pytest.mark.parametrize(("rate", "observed", "quick"), keep_fast(MOTORS, *MOTORS[:3]))
@pytest.mark.parametrize("seed", keep_fast(range(5), 0))
def test_beside_busy_programs_the_speed_is_held_or_the_motor_gets_0_v(
    rate: float, observed: bool, quick: float, load: Load, seed: int
) -> None:
    """It swung from -100 to +160 % of its reference, beside seven endless loops at 1 kHz."""
    seen = run(steady(rate, observed, quick), draw_pauses(load, 2.0, seed), 2.2)
    assert not len(seen.unexplained(rate))
    if load is BUSY_200_HZ:  # no false stop
        assert np.abs(seen.speeds / REFERENCE - 1.0).max() < 0.05 and seen.voltages.min() > 0.0
    else:
        assert seen.voltages[-1] == 0.0 and "give the controller more processor time" in seen.reasons[-1]


times = st.floats(0.001, 0.4)
pauses = st.lists(st.tuples(times, times, st.none() | st.floats(0.0, 1.0), st.booleans()), min_size=1, max_size=12)


@settings(max_examples=25, deadline=None)
@given(pauses, st.sampled_from([(200.0, False, 1.0), (200.0, True, 1.0), (200.0, False, 4.0)]))
def test_whatever_holds_it_up_no_motor_swings(
    drawn: list[tuple[float, float, float | None, bool]], kind: tuple[float, bool, float]
) -> None:
    time, held_up = 0.0, []
    for running, length, old, unpublished in drawn:
        held_up.append(Pause(time + running, time + running + length, old, unpublished))
        time += running + length
    seen = run(steady(*kind), held_up, time + 0.6)
    assert not len(seen.unexplained(kind[0]))


def test_a_loop_that_was_held_up_once_goes_on_as_ever() -> None:
    """Held up twice as long as the plant holds a voltage: 0 V by the plant, and back at its speed by itself."""
    seen = run(steady(1000.0), [Pause(0.1, 0.3)], 1.0)
    assert 5.0 < seen.speeds.min() < 25.0 and seen.speeds.max() < 1.05 * REFERENCE
    assert np.abs(seen.speeds[-400:] / REFERENCE - 1.0).max() < 0.05 and seen.reasons[-1] == ""
    assert any("stays near what held this speed" in reason for reason in seen.reasons)


def test_a_load_that_comes_meanwhile_is_met() -> None:
    """What held the speed before does not hold it any more, which is said until the new motion is known."""
    loop = steady(1000.0)
    held_up = [Pause(0.03 * k + 0.001, 0.03 * k + 0.029) for k in range(20)]
    run(loop, held_up, 0.6)
    loop.board._p[INDEX["bias_voltage"]] = 1.0
    seen = run(loop, held_up, 0.6)
    assert any("stays near what held this speed" in reason for reason in seen.reasons) and seen.reasons[-1] == ""
    assert seen.speeds[-1] == pytest.approx(REFERENCE, rel=0.05) and seen.speeds.max() < 1.05 * REFERENCE
