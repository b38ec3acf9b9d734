"""The real firmware on the emulated chip counting both channels: every edge, exact stamps, no drift, errors told."""

from collections.abc import Callable

import numpy as np
import pytest
from emulated_board import MS, TICK, Bench
from line_events import counts_of, dither_events, line_events

from motor_board.build import FirmwareConfig
from motor_board.emulation.edges import Edges
from motor_driver.frames.from_board import Features, Telemetry
from motor_driver.frames.from_host import Command, Ping, Setup

MakeBench = Callable[..., Bench]
TWO = FirmwareConfig(channels=2)
UNEVEN = (0.0, 0.17, 0.44, 0.71)  # flanks in a period: A rises, B rises, A falls, B falls (duty cycles 44 % and 54 %)


def run(bench: Bench, fold: int, cycles: np.ndarray, what: np.ndarray) -> list[Telemetry]:
    """Count these events (cycles from the start) at 1 kHz, with commands and pings; all telemetry meanwhile."""
    bench.start(2_000)
    bench.send(Setup(fold, 0))
    bench.run(4)
    assert bench.last(Features).quadrature == fold
    first = bench.chip.cycle + 2 * MS
    bench.emulator._plan = lambda until: bench.emulator.shaft.plan(until)  # type: ignore[method-assign,assignment]
    bench.events.clear()
    for start in range(0, len(cycles), 2_000):
        part = slice(start, start + 2_000)
        bench.chip.set_edges(int(first + cycles[part][0]) - 1, Edges(first + cycles[part], what[part]))
        while bench.chip.cycle < int(first + cycles[part][-1]) - 20:
            bench.send(Command(0), *[Ping(5)] * (len(bench.events) % 20 == 0))
            bench.run(min(1.0, max(int(first + cycles[part][-1]) - 10 - bench.chip.cycle, 1) / MS))
    bench.run(5)
    assert bench.decode.counters.bad == bench.decode.counters.lost == 0
    cycles += np.uint64(first)
    return bench.all(Telemetry)


@pytest.mark.parametrize("wave", [87.0, 88.0, 92.0])
def test_edges_that_come_while_they_are_copied_spoil_no_period(make_bench: MakeBench, wave: float) -> None:
    """Frames of these phases had a period of 2^30 ticks now and then: four edges back was overwritten already."""
    bench = make_bench(config=TWO)
    cycles, what, step = line_events(
        np.arange(0.0, 1_500.0), 5_000.0 * (1.0 + 0.05 * np.sin(np.arange(1_500.0) / wave)), UNEVEN
    )
    frames = run(bench, 4, cycles, what)
    stamps = (cycles[step != 0].astype(np.int64) - bench.chip.clock_zero) // TICK
    moving = [frame for frame in frames if 8 < frame.edge_count < len(stamps) - 4]
    assert len(moving) > 290
    for frame in moving:
        period = (stamps[frame.edge_count - 1] - stamps[frame.edge_count - 5]) / 4.0
        assert frame.edge_period == pytest.approx(period, abs=0.51)


@pytest.mark.parametrize(("chip", "rate"), [("atmega328p", 5_000.0), ("atmega2560", 3_500.0)])
@pytest.mark.parametrize("fold", [2, 4])
def test_every_edge_is_counted_and_what_is_reported_is_exact(make_bench: MakeBench, fold: int, rate: float) -> None:
    """20,000 line edges a second, uneven; count and time of each frame are those of one edge, A's at the tick.

    14,000 on a Mega, whose serial interrupts come before the capture's: B's level is read up to 40 us late.
    """
    bench = make_bench(config=TWO)
    periods = np.arange(0.0, 1_500.0)
    cycles, what, step = line_events(periods, rate * (1.0 + 0.05 * np.sin(periods / 90.0)), UNEVEN)
    frames = run(bench, fold, cycles, what)
    own = step != 0 if fold == 4 else (step != 0) & counts_of(what)
    stamps = (cycles[own].astype(np.int64) - bench.chip.clock_zero) // TICK
    last = frames[-1]
    assert last.edge_count == len(stamps) and last.errors == 0
    moving = [frame for frame in frames if fold < frame.edge_count < len(stamps) - 4]
    assert len(moving) > 200
    for frame in moving:
        assert frame.edge_time == stamps[frame.edge_count - 1]
        assert frame.edge_period == pytest.approx(
            (stamps[frame.edge_count - 1] - stamps[frame.edge_count - 1 - fold]) / fold, abs=0.51
        )
        known = int(np.searchsorted(stamps, frame.time, side="right"))
        assert 0 <= known - frame.edge_count <= (1 if fold == 4 else 0)


@pytest.mark.parametrize("flank", range(4))
def test_a_shaft_that_dithers_about_a_flank_does_not_drift(make_bench: MakeBench, flank: int) -> None:
    """To and fro over one flank, 3 us to 3 ms apart: at the end the count is where it began, or one on."""
    bench = make_bench(config=TWO)
    random = np.random.default_rng(flank)
    turning = np.tile([1, -1], 1_000)
    begin = np.ones(flank, dtype=np.int64)
    _, what = dither_events(np.concatenate([begin, turning, [1]]), 1e-3)
    gaps = np.exp(random.uniform(np.log(3e-6), np.log(3e-3), len(what)))
    gaps[: flank + 1] = 1e-3
    frames = run(bench, 4, (np.cumsum(gaps) * 16e6).astype(np.uint64), what)
    assert {frame.edge_count for frame in frames[flank + 6 :]} == {flank, flank + 1}
    assert frames[-1].edge_count == flank + 1 and frames[-1].errors == 0


def test_lines_whose_order_cannot_be_told_are_an_error_and_no_motion(make_bench: MakeBench) -> None:
    """Flanks 20 cycles apart: B after A is in order, as A's interrupt had begun; A after B is not."""
    bench = make_bench(config=TWO)
    _, what = dither_events(np.ones(8, dtype=np.int64), 1e-3)
    gaps = np.full(8, 16_000)
    gaps[[3, 6]] = 20  # [cycle]: before any interrupt can have run
    frames = run(bench, 4, np.cumsum(gaps).astype(np.uint64), what)
    assert frames[-1].errors == 1 and frames[-1].edge_count == 6 and not frames[-1].edge_period


def test_a_board_flashed_for_one_channel_says_that_it_cannot(bench: Bench) -> None:
    bench.start()
    bench.send(Setup(4, 0))
    bench.run(4)
    assert bench.last(Features) == Features(1, 0, 2)
