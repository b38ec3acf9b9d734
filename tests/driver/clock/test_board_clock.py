"""The board's 32-bit counter becomes nanoseconds that never step, whatever was lost, wrapped or reset."""

from hypothesis import given
from hypothesis import strategies as st

from motor_driver.clock.board_clock import POWER_UP, WRAP, BoardClock

TICK = 500
HOST = 10**15
SECOND = 10**9
MINUTE = 60 * SECOND
gaps = st.integers(1, 200 * MINUTE // TICK)  # [tick] up to six wraps between two samples
delays = st.integers(0, SECOND // 2)  # [ns]


@given(st.integers(0, WRAP - 1), st.lists(st.tuples(gaps, delays), min_size=1, max_size=30), st.floats(-0.005, 0.005))
def test_exact_through_gaps_wraps_delays_and_a_poor_crystal(
    first: int, steps: list[tuple[int, int]], error: float
) -> None:
    clock, ticks, host = BoardClock(TICK), first, HOST
    assert clock.hear(first, HOST)
    assert clock.newest == POWER_UP + first * TICK
    for gap, delay in steps:
        ticks += gap
        host = max(host, HOST + round((ticks - first) * TICK * (1 + error)) + delay)
        assert clock.hear(ticks % WRAP, host)
        assert clock.newest == POWER_UP + ticks * TICK
        assert clock.before((ticks - gap % WRAP) % WRAP) == POWER_UP + (ticks - gap % WRAP) * TICK
        assert clock.near((ticks - 5) % WRAP) == POWER_UP + (ticks - 5) * TICK
        assert clock.near((ticks + 5) % WRAP) == POWER_UP + (ticks + 5) * TICK


@given(st.integers(10 * SECOND // TICK, WRAP // 2), st.integers(0, 9 * SECOND // TICK))
def test_a_time_that_steps_back_is_not_taken(first: int, back: int) -> None:
    clock = BoardClock(TICK)
    clock.hear(first, HOST)
    assert not clock.hear((first - back) % WRAP, HOST + SECOND)
    assert not clock.hear(back, HOST + SECOND)
    assert clock.newest == POWER_UP + first * TICK
    assert clock.hear((first + SECOND // TICK) % WRAP, HOST + SECOND)


def test_late_bytes_are_believed_but_not_the_first_of_a_new_port() -> None:
    """After 20 s without power a board that counts from 0 is past where it was, and yet found out."""
    clock = BoardClock(TICK)
    clock.hear(10_000, HOST)
    assert not clock.hear(2 * SECOND // TICK, HOST + 20 * SECOND, resumed=True)
    assert clock.hear(2 * SECOND // TICK, HOST + 20 * SECOND)  # the reader was held up
    assert clock.hear(22 * SECOND // TICK, HOST + 22 * SECOND, resumed=True)


@given(st.integers(0, WRAP - 1), st.integers(0, WRAP - 1), st.integers(0, 100 * MINUTE), st.sampled_from([500, 4000]))
def test_a_restart_goes_on_by_the_hosts_clock(first: int, again: int, elapsed: int, tick: int) -> None:
    clock = BoardClock(TICK)
    clock.hear(first, HOST)
    before = clock.newest
    clock.restart(again, HOST + elapsed, tick)
    assert max(1, elapsed - tick) <= clock.newest - before <= max(tick, elapsed)
    there = clock.newest
    assert clock.hear((again + 7) % WRAP, HOST + elapsed + SECOND)
    assert clock.newest - there == 7 * tick
