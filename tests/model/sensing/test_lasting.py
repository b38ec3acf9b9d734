"""A motor that is driven for long without an edge is stopped, whatever interrupts that for a moment."""

from collections.abc import Callable

import pytest
from motion_samples import sample

from motor_model.sensing.lasting import LONG, Lasting
from motor_model.sensing.motion_check import DRIVEN, LASTING, MotionCheck

STALL, S = 0.4, 1_000_000_000


def stopped_after(share: Callable[[float], float], edges_from: float = 1e9, most: float = 40.0) -> float | None:
    """[s] until a motor of 12 V is stopped that shows no edge before a time [s], and then four a second."""
    check = MotionCheck(12.0, True, STALL)
    for k in range(round(most * 200)):
        time = k / 200
        count = 7 + int(4.0 * max(time - edges_from, 0.0))
        check = check.see(sample(time, count, 0.0, 12.0 * share(time)))
        if check.stop:
            return time
    return None


@pytest.mark.parametrize("low", [0.0, 0.24])
@pytest.mark.parametrize("every", [0.7, 2.0, 6.0])
def test_a_low_sample_now_and_then_lets_no_blocked_motor_cool(low: float, every: float) -> None:
    """It was driven for ever, at a quarter of a stall's heat."""
    stopped = stopped_after(lambda time: low if time % every < 0.004 else 0.49)
    assert stopped is not None and 6.4 <= stopped <= 6.6


@pytest.mark.parametrize(("every", "stops"), [(6.0, True), (1.7, True), (1.5, False), (0.3, False)])
def test_long_pushes_both_ways_are_one_and_short_ones_may_turn_a_motor_within_a_slot(every: float, stops: bool) -> None:
    stopped = stopped_after(lambda time: 0.49 if time % (2.0 * every) < every else -0.49)
    assert (stopped is not None) is stops
    assert stopped is None or 6.39 <= stopped <= 6.6


@pytest.mark.parametrize(("back", "latest"), [(0.01, 6.7), (0.1, 7.5), (0.5, 13.0), (1.4, 25.0), (1.5, None)])
def test_a_short_push_counts_but_for_what_is_driven_back(back: float, latest: float | None) -> None:
    """1.5 s one way and two samples the other let a blocked motor heat for ever. As long either way may turn it."""
    stopped = stopped_after(lambda time: -0.49 if time % (1.5 + back) >= 1.5 else 0.49)
    assert (stopped is None) is (latest is None)
    assert stopped is None or latest is None or 6.4 <= stopped <= latest


@pytest.mark.parametrize(("share", "stops"), [(DRIVEN - 0.001, False), (DRIVEN + 0.001, True)])
def test_what_turns_any_motor_counts_and_less_does_not(share: float, stops: bool) -> None:
    assert (stopped_after(lambda time: share) is not None) is stops


@pytest.mark.parametrize(("driven", "off", "stops"), [(3.0, 3.1, False), (3.0, 1.0, True), (6.0, 7.0, False)])
def test_as_long_as_it_is_not_driven_it_cools(driven: float, off: float, stops: bool) -> None:
    stopped = stopped_after(lambda time: 0.49 if time % (driven + off) < driven else 0.1)
    assert (stopped is not None) is stops


def test_an_edge_ends_it() -> None:
    assert stopped_after(lambda time: 0.49, edges_from=6.0) is None


def test_times_add_up_to_the_nanosecond() -> None:
    lasting = Lasting()
    for direction, took in ((1, 5), (1, 7), (0, 4), (1, 2), (-1, 9), (-1, 3)):
        lasting = lasting.see(direction, took, False, STALL)
    assert lasting == Lasting(-1, 3, 0, 2)  # the push before was short: of its 5, 3 were driven back
    assert lasting.see(1, 9, False, STALL) == Lasting(1, 2, 0, 3) and lasting.time == 5
    assert lasting.see(-1, 4, False, STALL) == Lasting(-1, 7, 0, 0)
    assert lasting.see(0, 4, False, STALL) == Lasting(-1, 0, 0, 1) and lasting.see(0, 5, False, STALL).time == 0
    lasting = Lasting(1, round(LONG * STALL * S), 5).see(-1, 9, False, STALL)
    assert lasting == Lasting(-1, 0, round(LONG * STALL * S) + 5)
    assert lasting.see(0, 7, False, STALL).time == lasting.time - 7
    assert lasting.see(0, round(LASTING * S), False, STALL).time == 0
    assert lasting.see(-1, 9, True, STALL) == Lasting(-1)
