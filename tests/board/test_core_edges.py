"""The firmware's edge timer, on this computer: a 32-bit clock from a 16-bit counter, interrupts as late as may be."""

from ctypes import byref
from dataclasses import dataclass, field

import firmware_core as core
import pytest
from hypothesis import given
from hypothesis import strategies as st

TURN = 1 << 16
WRAP = 1 << 32
Steps = list[tuple[int, int, int, bool]]  # gap, how late overflow and edge are served [tick]; backward
LATEST = 0x3FFF  # [tick] that an interrupt may be late


@dataclass
class Hardware:
    """Counter, capture unit and overflow flag, served late; `time` is the true tick count."""

    start: int
    timer: core.EdgeTimer = field(default_factory=core.EdgeTimer)

    def __post_init__(self) -> None:
        self.served = self.start // TURN  # overflows that the firmware knows of
        self.timer.overflows = self.served % TURN

    def serve_overflows(self, until: int) -> None:
        while self.served < until // TURN:
            core.load().edge_timer_overflow(byref(self.timer))
            self.served += 1

    def edge(self, time: int, overflow_late: int, late: int, reverse: bool = False, two: bool = False) -> None:
        """An edge at `time` whose interrupt runs `late` ticks after; overflows before it were served a little late."""
        self.serve_overflows(time - overflow_late)
        pending = (time + late) // TURN > self.served
        if two:
            core.load().edge_timer_rise(byref(self.timer), time % TURN, pending, reverse)
        else:
            core.load().edge_timer_capture(byref(self.timer), time % TURN, pending)

    def fall(self, time: int, b_high: bool) -> None:
        """A falls at `time`, and is seen at once."""
        self.serve_overflows(time)
        core.load().edge_timer_fall(byref(self.timer), time % TURN, False, b_high)

    def at(self, now: int, two: bool = False) -> core.Edge:
        core.load().edge_timer_forget(byref(self.timer), now % WRAP)
        return core.load().edge_timer_at(byref(self.timer), now % WRAP, two)


late = st.integers(0, LATEST) | st.sampled_from([0, 1, LATEST])
gaps = st.integers(1, 200_000) | st.integers(1, 70) | st.sampled_from([TURN - 1, TURN, TURN + 1])
edges = st.lists(st.tuples(gaps, late, late, st.booleans()), min_size=1, max_size=30)
starts = st.integers(0, 2**33) | st.sampled_from([WRAP - 5, WRAP - TURN, TURN - 1])


@given(starts, edges)
def test_every_edge_has_its_time_whatever_overflows_meanwhile(start: int, steps: Steps) -> None:
    hardware, time, before = Hardware(start), start, None
    for count, (gap, overflow_late, late_by, _) in enumerate(steps, 1):
        time += gap
        hardware.edge(time, overflow_late, late_by)
        edge = hardware.at(time)
        assert (edge.count, edge.time, edge.valid) == (count, time % WRAP, True)
        assert edge.period == (0 if before is None else time - before)
        before = time


@given(starts, edges, st.integers(0, 2), st.integers(0, 10**6))
def test_edges_after_the_sample_belong_to_the_next(start: int, steps: Steps, later: int, since: int) -> None:
    """Two channels: the count goes down for every edge passed backward."""
    times, count, counts = [start], 0, [0]
    hardware = Hardware(start)
    for gap, overflow_late, late_by, reverse in steps:
        times.append(times[-1] + gap)
        hardware.edge(times[-1], overflow_late, late_by, reverse, True)
        core.load().edge_timer_fall(byref(hardware.timer), 0, False, not reverse)  # out on the other side
        count += -1 if reverse else 1
        counts.append(count)
    later = min(later, len(steps))
    seen = len(steps) - later
    now = times[seen] + (min(since, times[seen + 1] - times[seen] - 1) if later else since)
    edge = hardware.at(now, True)
    assert edge.count == counts[seen] % WRAP
    kept = min(core.KEPT - later, seen)  # of those up to the sample
    assert edge.valid == (kept > 0)
    if kept > 0:
        assert edge.time == times[seen] % WRAP and edge.reverse == steps[seen - 1][3]
    assert edge.period == (times[seen] - times[seen - 1] if kept > 1 else 0)


def test_two_edges_with_one_capture_both_count_and_give_no_period_of_their_own() -> None:
    hardware = Hardware(0)
    for time in (1_000, 1_500, 2_100, 2_100):
        hardware.edge(time, 0, 0)
    edge = hardware.at(2_200)
    assert (edge.count, edge.time, edge.period) == (4, 2_100, 600)


def test_an_edge_longer_ago_than_times_can_tell_is_forgotten() -> None:
    hardware = Hardware(0)
    hardware.edge(5_000, 0, 0)
    hardware.edge(6_000, 0, 0)
    half = 1 << 31
    young, old = hardware.at(6_000 + half - 1), hardware.at(6_000 + half)
    assert (young.valid, young.count, young.period) == (True, 2, 1_000)
    assert (old.valid, old.count, old.period) == (False, 2, 0)
    again = 6_000 + WRAP + 300
    assert not hardware.at(again).valid  # its time would look 300 ticks old
    hardware.edge(again, 0, 0)
    edge = hardware.at(again + 10)
    assert (edge.count, edge.time, edge.period, edge.valid) == (3, again % WRAP, 0, True)


@given(st.integers(0, 2**40), late)
def test_now_is_right_whenever_the_overflow_comes(time: int, since: int) -> None:
    """The counter is read, then the flag: an overflow in between must not count."""
    overflows = (time - since) // TURN if time >= since else 0
    for flag_read in (time, time + 1):
        pending = flag_read // TURN > overflows
        assert core.load().edge_timer_extend(overflows % TURN, time % TURN, pending) == time % WRAP


class Disc:
    """Channel A is high over the first half of each slot, B over the half that begins a quarter of a slot later."""

    def __init__(self) -> None:
        self.hardware, self.position, self.time = Hardware(0), 0.75, 0  # [slot], [tick]; between two holes

    def go(self, position: float, missed: bool = False) -> None:
        """Turn to a position [slot]; `missed`: falling edges come together with the next rising one."""
        step = 1 if position > self.position else -1
        first, last = sorted((self.position, position))
        flanks = [n / 2 for n in range(-200, 201) if first < n / 2 < last]
        for place in flanks[::step]:
            self.time += 1_000
            b_high = place % 1.0 == 0.5
            rises = (place % 1.0 == 0.0) == (step > 0)
            if rises:
                self.hardware.edge(self.time, 0, 0, b_high, True)
            elif not missed:
                self.hardware.fall(self.time, b_high)
        self.position = position

    @property
    def count(self) -> int:
        edge = self.hardware.at(self.time, True).count
        return edge - WRAP if edge >= WRAP // 2 else edge


places = st.floats(-20.0, 20.0).filter(lambda x: abs(x * 2 - round(x * 2)) > 1e-6)


@given(st.lists(places, max_size=30))
def test_two_channels_count_what_the_shaft_has_turned_whatever_it_did(positions: list[float]) -> None:
    """Never off by more than the slot of a single edge, however often it turns round."""
    disc = Disc()
    for position in positions:
        disc.go(position)
        assert abs(disc.count - (position - 0.75)) <= 1.0


@pytest.mark.parametrize("flank", [0.0, 0.5, 1.0, 1.5])
@pytest.mark.parametrize("missed", [False, True])
def test_a_shaft_that_dithers_over_one_flank_counts_to_and_fro(flank: float, missed: bool) -> None:
    disc = Disc()
    for _ in range(200):
        disc.go(flank + 0.1, missed)
        disc.go(flank - 0.1, missed)
        assert abs(disc.count - (disc.position - 0.75)) <= 1.0
        assert disc.hardware.at(disc.time, True).period in (0, 1_000, 2_000)
    edge = disc.hardware.at(disc.time, True)
    assert edge.period == 0  # one flank twice is no travel


def test_a_pulse_whose_end_is_served_before_its_beginning_counts_nothing() -> None:
    """Both interrupts wait, that of the falling edge has its turn first; the other one then sees that A is low."""
    disc = Disc()
    for _ in range(50):
        disc.hardware.fall(disc.time, False)
        disc.hardware.edge(disc.time + 10, 0, 0, False, True)
        disc.hardware.fall(disc.time + 20, False)
        disc.time += 1_000
    assert disc.count == 0
