"""The real firmware on the emulated chip, on a clock of the test's own: when edges, samples and frames are."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from emulated_board import MS, TICK, Bench, on_the_larger_chip_slowly
from tiers import keep_fast

from motor_board.build import FirmwareConfig
from motor_board.emulation.edges import FORWARD, Edges, Line
from motor_board.emulation.shaft import EncoderConfig
from motor_driver.frames.codes import Flag
from motor_driver.frames.from_board import Hello, Pong, Telemetry
from motor_driver.frames.from_host import Command, Configure, Ping, Setup
from motor_driver.protocol import Arrival
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.simulate import simulate

MakeBench = Callable[..., Bench]
SLOT = 2 * np.pi / 96


@pytest.mark.parametrize(
    "period", [2_000, 10_000, 32_787, 66_667, 200_000], ids=["1 kHz", "200 Hz", "61 Hz", "30 Hz", "10 Hz"]
)
def test_samples_exactly_at_the_period_it_was_given(bench: Bench, period: int) -> None:
    bench.run(8)
    bench.send(Configure(period, 100, 0))
    bench.run(max(40, 5 * period // 2000))
    assert bench.last(Hello).sample_period == period
    times = [telemetry.time for telemetry in bench.all(Telemetry) if telemetry.latch == 1]
    assert len(times) >= 4 and {b - a for a, b in pairwise(times)} == {period}
    assert bench.decode.counters.bad == bench.decode.counters.lost == 0


@on_the_larger_chip_slowly
def test_every_edge_has_its_exact_time(bench: Bench) -> None:
    """A real motor's edges, through a counter that overflows many times: stamp = ⌊cycle/8⌋, latest up to the tick."""
    edges: list[int] = []
    plan = bench.emulator.shaft.plan

    def spy(until: int):  # type: ignore[no-untyped-def]
        planned = plan(until)
        known = bench.emulator.shaft._cycle
        # One that comes as the plan is made anew is in both plans; the chip sees it once.
        edges[:] = sorted({*(cycle for cycle in edges if cycle <= known), *planned.cycle.tolist()})
        return planned

    bench.emulator.shaft.plan = spy  # type: ignore[method-assign]
    bench.start(2_000)
    for k in range(1_500):
        bench.drive(round(256 * np.sin(2 * np.pi * k / 700)), 1, 1)
    stamps = (np.array(edges) - bench.chip.clock_zero) // TICK
    frames = [telemetry for telemetry in bench.all(Telemetry) if telemetry.edge_count >= 2]
    assert len(frames) > 1_000 and frames[-1].edge_count > 1_900
    for telemetry in frames:
        count = int(np.searchsorted(stamps, telemetry.time, side="right"))
        assert telemetry.edge_count == count
        assert telemetry.edge_time == stamps[count - 1] and telemetry.edge_valid
        assert telemetry.edge_period == stamps[count - 1] - stamps[count - 2]
    assert bench.decode.counters.bad == bench.decode.counters.lost == 0


@pytest.mark.parametrize("rate", keep_fast([16_700, 20_000, 25_000], 20_000))
def test_no_edge_is_lost_up_to_20_000_a_second(bench: Bench, rate: int) -> None:
    """Commands, pings and telemetry at 1 kHz meanwhile; with the spacing sweeping through all phases of the tick."""
    bench.start(2_000)
    first, spacing = bench.chip.cycle + 5 * MS, 16e6 / rate + 0.37
    cycles = (first + spacing * np.arange(8_000)).astype(np.uint64)
    bench.emulator._plan = lambda until: bench.emulator.shaft.plan(until)  # type: ignore[method-assign,assignment]
    bench.chip.set_edges(first - 1, Edges(cycles, np.zeros(len(cycles), dtype=np.uint8)))
    while bench.chip.cycle < cycles[-1] + 3 * MS:
        bench.send(Command(0), *[Ping(5)] * (len(bench.events) % 50 == 0))
        bench.run(1)
    frames = bench.all(Telemetry)
    stamps = (cycles.astype(np.int64) - bench.chip.clock_zero) // TICK
    counts = [int(np.searchsorted(stamps, telemetry.time, side="right")) for telemetry in frames]
    assert [telemetry.edge_count for telemetry in frames] == counts and counts[-1] == len(cycles)
    assert bench.decode.counters.bad == bench.decode.counters.lost == 0


@on_the_larger_chip_slowly
@pytest.mark.parametrize(("period", "burst"), [(2_000, 2), (10_000, 8)], ids=["1 kHz", "200 Hz"])
def test_noise_that_holds_the_samples_up_does_not_make_its_time_late(bench: Bench, period: int, burst: int) -> None:
    """Edges come before all else; each burst of 100,000 a second made the board 33 ms later, its time-out as well."""
    bench.start(period)
    bench.emulator._plan = lambda until: bench.emulator.shaft.plan(until)  # type: ignore[method-assign,assignment]
    for _ in range(8):
        first = bench.chip.cycle + MS
        cycles = np.arange(first, first + burst * MS, 100, dtype=np.uint64)
        bench.chip.set_edges(first - 1, Edges(cycles, np.zeros(len(cycles), dtype=np.uint8)))
        for _ in range(8):
            bench.send(Command(128))
            bench.run(5)
    silent, last = bench.chip.cycle - 5 * MS, bench.last(Telemetry)
    assert last.enabled and bench.chip.resets == 0
    assert bench.chip.cycle - bench.chip.clock_zero - last.time * TICK < 6 * MS
    off = bench.run_until(lambda: bench.chip.pins.share == 0.0, 300)
    assert 100 * MS <= off - silent <= 106 * MS


def start_counting(make_bench: MakeBench, channels: int, fold: int) -> Bench:
    """A board that counts by so many channels and flanks, at 1 kHz."""
    bench = make_bench(config=FirmwareConfig(channels=channels))
    bench.run(8)
    bench.send(Setup(fold, 0))
    bench.run(4)
    bench.send(Configure(2_000, 100, 0))
    bench.run(8)
    return bench


def make_storm(bench: Bench, channels: int, rate: int) -> Callable[[], None]:
    """Edges at random, so many a second for half a second; what is returned sets those of the next 4 ms."""
    bench.emulator._plan = lambda until: bench.emulator.shaft.plan(until)  # type: ignore[method-assign,assignment]
    gaps = np.maximum(np.random.default_rng(1).exponential(16e6 / rate, rate // 2), 8)
    cycles = (bench.chip.cycle + np.cumsum(gaps)).astype(np.uint64)
    falls = np.where(np.arange(len(cycles)) % 2 == 1, Line.A_FALLS if channels == 2 else 0, 0).astype(np.uint8)

    def set_edges() -> None:
        now = np.uint64(bench.chip.cycle)
        near = (cycles > now) & (cycles <= now + np.uint64(4 * MS))
        bench.chip.set_edges(int(now), Edges(cycles[near], falls[near]))

    return set_edges


@on_the_larger_chip_slowly
@pytest.mark.parametrize("rate", keep_fast([100_000, 150_000, 210_000, 260_000], 150_000, 210_000))
@pytest.mark.parametrize(("channels", "fold"), [(1, 1), (2, 1), (2, 4)], ids=["one", "two", "two, fourfold"])
def test_a_storm_of_edges_holds_nothing_up(make_bench: MakeBench, channels: int, fold: int, rate: int) -> None:
    """It had no time-out meanwhile, was reset, or crashed: ticks in ticks left no room on the stack."""
    bench = start_counting(make_bench, channels, fold)
    bench.enable()
    set_edges = make_storm(bench, channels, rate)
    silent = bench.chip.cycle
    for k in range(150):
        if k < 60:
            bench.send(Command(128))
            silent = bench.chip.cycle
        set_edges()
        bench.run(2)
        if k > 60 and bench.chip.pins.share == 0.0:
            break
        assert bench.chip.pins.share == 0.5 or k < 2
    assert 100 * MS <= bench.chip.cycle - silent <= 110 * MS and bench.chip.resets == 0
    assert bench.chip.cycle - bench.chip.clock_zero - bench.last(Telemetry).time * TICK < 5 * MS
    assert bench.last(Telemetry).errors > 20  # what was not heard is told, by one channel as well
    assert_edges_are_heard(bench, channels, fold)


@pytest.mark.parametrize("channels", [1, 2])
def test_zeros_at_the_line_s_full_speed_beside_a_storm_of_edges_hold_nothing_up(
    make_bench: MakeBench, channels: int
) -> None:
    """The main loop has no turn for 60 ms, and the watchdog resets the board, unless edges wait for it meanwhile.

    Ticks come behind one another, which an emulated chip forgot: 0 V was 33 or 66 ms late.
    """
    bench = start_counting(make_bench, channels, 1)
    bench.enable()
    set_edges = make_storm(bench, channels, 60_000)
    silent = bench.chip.cycle
    for k in range(150):
        if k < 20:
            bench.send(Command(128))
            silent = bench.chip.cycle
        else:
            bench.chip.feed(bytes(100))  # in 2 ms: 500,000 baud
        set_edges()
        bench.run(2)
        if k > 20 and bench.chip.pins.share == 0.0:
            break
    assert 100 * MS <= bench.chip.cycle - silent <= 106 * MS and bench.chip.resets == 0


def feed(bench: Bench, cycles: np.ndarray, what: np.ndarray) -> None:
    """Edges on the lines, with commands meanwhile."""
    while bench.chip.cycle < cycles[-1] + MS:
        bench.send(Command(0))
        now = np.uint64(bench.chip.cycle)
        near = (cycles > now) & (cycles <= now + np.uint64(4 * MS))
        bench.chip.set_edges(int(now), Edges(cycles[near], what[near]))
        bench.run(2)


def forward(bench: Bench, count: int, rate: float, channels: int, fold: int) -> tuple[np.ndarray, np.ndarray]:
    """So many flanks, from now on; twofold those of A alone."""
    cycles = (bench.chip.cycle + np.arange(1, count + 1) * (16e6 / rate)).astype(np.uint64)
    phase = 2 * (np.arange(count) % 2) if fold == 2 else np.arange(count) % 4
    return cycles, FORWARD[phase] if channels == 2 else np.zeros(count, np.uint8)


def assert_edges_are_heard(bench: Bench, channels: int, fold: int) -> None:
    bench.chip.set_edges(bench.chip.cycle, Edges(np.zeros(0, np.uint64), np.zeros(0, np.uint8)))
    bench.run(20)
    before = bench.last(Telemetry)
    feed(bench, *forward(bench, 400, 2_000, channels, fold))
    bench.run(5)
    after = bench.last(Telemetry)
    counts = 400 if channels == 1 else 100 * fold if fold != 2 else 400
    assert abs((after.edge_count - before.edge_count) % 2**32 - counts) <= 2  # A's level may be another at first
    assert after.errors == before.errors


@on_the_larger_chip_slowly
@pytest.mark.parametrize("rate", keep_fast([60_000, 100_000, 210_000], 100_000))
@pytest.mark.parametrize(
    ("channels", "fold"), [(1, 1), (2, 1), (2, 2), (2, 4)], ids=["one", "two", "twofold", "fourfold"]
)
def test_edges_are_heard_again_after_a_storm(make_bench: MakeBench, channels: int, fold: int, rate: int) -> None:
    """Twofold and fourfold they were not, ever: the count of what there was time for went below 0."""
    bench = start_counting(make_bench, channels, fold)
    bench.emulator._plan = lambda until: bench.emulator.shaft.plan(until)  # type: ignore[method-assign,assignment]
    gaps = np.maximum(np.random.default_rng(1).exponential(16e6 / rate, rate * 6 // 100), 8)
    falls = np.where(np.arange(len(gaps)) % 2 == 1, Line.A_FALLS if channels == 2 else 0, Line.A_STAYS)
    feed(bench, (bench.chip.cycle + np.cumsum(gaps)).astype(np.uint64), falls.astype(np.uint8))
    assert bench.last(Telemetry).errors > 5 and bench.chip.resets == 0
    assert_edges_are_heard(bench, channels, fold)


@pytest.mark.parametrize(
    ("channels", "fold", "rate", "period"),
    [(1, 1, 36_000, 10_000), (1, 1, 50_000, 10_000), (1, 1, 36_000, 2_000), (1, 1, 45_000, 2_000)]
    + [(2, 1, 44_000, 10_000), (2, 1, 44_000, 2_000), (2, 2, 36_000, 10_000), (2, 4, 36_000, 10_000)]
    + [(2, 4, 30_000, 2_000)],
)
def test_the_fastest_signals_keep_their_period(
    make_bench: MakeBench, channels: int, fold: int, rate: int, period: int
) -> None:
    """All were without one where some of a sample's edges were not heard: a speed of 0 at the highest one."""
    frames = run_fast(make_bench, channels, fold, rate, period)
    turn = 2 if fold == 2 else 4
    each = 2e6 / rate * (1 if channels == 1 else turn / fold)
    periods = np.array([frame.edge_period for frame in frames]) / each
    assert all(frame.edge_valid for frame in frames) and periods.min() > 0.9
    assert periods.max() < 2.2 and (rate > 36_000 or periods.max() < 1.1)  # beside a tick an edge may be lost
    counts = (frames[-1].edge_count - frames[0].edge_count) / ((frames[-1].time - frames[0].time) / each)
    assert abs(counts - 1.0) < 0.03 and frames[-1].errors == frames[0].errors


@pytest.mark.parametrize(
    ("channels", "fold", "rate", "period"), [(1, 1, 60_000, 2_000), (1, 1, 80_000, 10_000), (2, 2, 45_000, 2_000)]
)
def test_a_signal_that_is_too_fast_has_its_speed_and_errors(
    make_bench: MakeBench, channels: int, fold: int, rate: int, period: int
) -> None:
    frames = run_fast(make_bench, channels, fold, rate, period)
    assert all(0 < frame.edge_period < 4.5e6 / rate and frame.edge_valid for frame in frames)
    assert all(frame.time - frame.edge_time < 8e6 / rate for frame in frames)  # the driver's bound of the speed
    assert (frames[-1].errors - frames[0].errors) % 256 > 5


def run_fast(make_bench: MakeBench, channels: int, fold: int, rate: int, period: int) -> list[Telemetry]:
    bench = make_bench(config=FirmwareConfig(channels=channels))
    bench.run(8)
    bench.send(Setup(fold, 0))
    bench.run(4)
    bench.send(Configure(period, 100, 0))
    bench.run(8)
    bench.emulator._plan = lambda until: bench.emulator.shaft.plan(until)  # type: ignore[method-assign,assignment]
    feed(bench, *forward(bench, rate // 10, rate, channels, fold))
    assert bench.chip.resets == 0
    frames = bench.all(Telemetry)[:-5]
    return frames[-len(frames) * 2 // 3 :]


@on_the_larger_chip_slowly
def test_two_channels_count_down_backward(make_bench: MakeBench) -> None:
    bench = make_bench(config=FirmwareConfig(channels=2))
    bench.start()
    bench.drive(128, 400)
    forward = bench.last(Telemetry)
    assert forward.edge_count > 200 and not forward.flags & Flag.REVERSE and forward.flags & Flag.TWO_CHANNELS
    bench.drive(-128, 1_000)
    bench.drive(0, 1_500)
    backward = bench.last(Telemetry)
    assert backward.flags & Flag.REVERSE
    turned = bench.emulator.shaft.angle / SLOT
    signed = backward.edge_count - (backward.edge_count >> 31 << 32)
    assert abs(signed - turned) < 1.6 and turned < -200


def lines(position: np.ndarray, first: int) -> tuple[np.ndarray, np.ndarray]:
    """Cycles and lines of a disc that is at these positions [slot], a millisecond apart, going straight in between."""
    cycles, what = [], []
    for k, (start, stop) in enumerate(pairwise(position)):
        step = 1 if stop > start else -1
        halves = range(int(2 * min(start, stop)) - 2, int(2 * max(start, stop)) + 3)
        for half in halves[::step]:
            if min(start, stop) < half / 2 <= max(start, stop):
                rises, b_high = (half % 2 == 0) == (step > 0), half % 2 == 1
                cycles.append(first + round((k + (half / 2 - start) / (stop - start)) * MS))
                what.append((Line.A_STAYS if rises else Line.A_FALLS) | (Line.B_HIGH if b_high else 0))
    return np.array(cycles, dtype=np.uint64), np.array(what, dtype=np.uint8)


def counted(bench: Bench, position: np.ndarray) -> int:
    """What the firmware counts while the disc goes through these positions, with commands and pings meanwhile."""
    bench.start(2_000)
    first = bench.chip.cycle + 5 * MS
    cycles, what = lines(position, first)
    bench.emulator._plan = lambda until: bench.emulator.shaft.plan(until)  # type: ignore[method-assign,assignment]
    bench.chip.set_edges(first - 1, Edges(cycles, what))
    while bench.chip.cycle < first + (len(position) + 3) * MS:
        bench.send(Command(0), *[Ping(5)] * (len(bench.events) % 50 == 0))
        bench.run(1)
    count = bench.last(Telemetry).edge_count
    return count - (count >> 31 << 32)


@pytest.mark.slow
def test_a_dithering_shaft_does_not_count_one_way(make_bench: MakeBench) -> None:
    """0.14 rad of true travel to and fro over one flank, 400 times: once 400 slots."""
    bench = make_bench(config=FirmwareConfig(channels=2))
    position = 0.75 + 0.3 * np.sin(np.linspace(0.0, 800.0 * np.pi, 4_001))  # over the flank at 1
    assert abs(counted(bench, position) - (position[-1] - 0.75)) <= 1.0
    assert bench.last(Telemetry).edge_period == 0 and bench.last(Telemetry).edge_valid


def test_no_edge_of_two_channels_is_lost_up_to_10_000_a_second(make_bench: MakeBench) -> None:
    bench = make_bench(config=FirmwareConfig(channels=2))
    position = 0.75 + 10.0 * np.concatenate([np.arange(150.0), np.arange(149.0, -50.0, -1.0)])
    assert counted(bench, position) == round(position[-1] - 0.75)
    assert bench.decode.counters.bad == bench.decode.counters.lost == 0


@on_the_larger_chip_slowly
def test_the_encoders_lines_have_pull_ups(bench: Bench) -> None:
    """What nobody drives is high: a cable that came off makes no edges."""
    assert bench.chip.pull_ups == (False, False)
    bench.run(8)
    assert bench.chip.pull_ups == (True, True)
    bench.drive(128, 200)
    bench.drive(-128, 200)
    assert bench.chip.pull_ups == (True, True)


@on_the_larger_chip_slowly
def test_pong_holds_the_times_of_its_first_byte_and_of_the_ping_s_last(bench: Bench) -> None:
    bench.start(2_000)
    bench.chip.drain()
    sent: list[float] = []
    received: list[float] = []
    for token in range(40):
        bench.run(3.37)
        ping = bench.encode.send(Ping(token))
        arrival = bench.chip.cycle + 352 * len(ping)  # the emulated port delivers at 352 cycles a byte
        bench.chip.feed(ping)
        out: list[tuple[int, int]] = []
        while not bench.all(Pong):
            bench.emulator.run(bench.chip.cycle + MS // 4)
            new = bench.chip.drain_with_cycles()
            out += new
            bench.events += bench.decode.receive(bytes(byte for byte, _ in new))
        pong = bench.last(Pong)
        assert pong.token == token
        ends = [i for i, (byte, _) in enumerate(out) if byte == 0]
        start = next(a + 1 for a, b in pairwise([-1, *ends]) if b - a == 26)
        sent.append(out[start][1] - bench.chip.clock_zero - pong.sent * TICK)
        received.append(arrival - bench.chip.clock_zero - pong.received * TICK)
        bench.events.clear()
    assert min(sent) >= -400 and max(sent) <= 400  # [cycle]: 25 us; building the frame takes as long every time
    assert max(sent) - min(sent) < 200
    assert min(received) >= -800 and max(received) <= 16


def test_the_supply_voltage_is_measured_where_there_is_a_divider(make_bench: MakeBench) -> None:
    bench = make_bench(config=FirmwareConfig(supply_full_scale=20_000))
    bench.chip.supply(3.0)
    bench.run(30)
    assert bench.last(Telemetry).supply == 11_992  # 614 of 1,024 steps, and 613 would be 11,972


def test_the_motor_on_the_pins_is_the_model(make_bench: MakeBench) -> None:
    """Edge times that came over the wire, against the model under the duties that came over the wire."""
    parameters = Parameters({"kv": PAPER_KV, "ka": PAPER_KA, "ks": 0.5}, ("coulomb_friction",))
    bench = make_bench(parameters=parameters, encoder=EncoderConfig(seed=8))
    bench.start()
    for duty in (213, 120, 256, 60):
        bench.drive(duty, 400)
    frames = bench.all(Telemetry)
    assert len(frames) > 300
    second = np.array([telemetry.time for telemetry in frames]) * 5e-7
    volts = np.array([telemetry.duty for telemetry in frames]) / 256 * parameters.max_voltage
    moved = [b for a, b in pairwise(frames) if b.edge_count > a.edge_count]
    edge = np.array([telemetry.edge_time for telemetry in moved]) * 5e-7
    count = np.array([telemetry.edge_count for telemetry in moved])
    motion = simulate(parameters, second, volts, np.concatenate([[second[0]], edge]))
    slots = np.diff(motion.angle[1:]) / SLOT - np.diff(count)
    assert 1e-5 < np.sqrt(np.mean(slots**2)) < 2e-3  # a tick is 1.3e-3 of a slot at full speed
    assert abs(motion.angle[-1] - motion.angle[1] - (count[-1] - count[0]) * SLOT) < 0.05 * SLOT


@pytest.mark.slow
def test_every_sample_arrives_at_1_khz(bench: Bench) -> None:
    bench.start(2_000)
    bench.drive(180, 3_000, 1)
    frames = bench.all(Telemetry)
    assert {b.time - a.time for a, b in pairwise(frames)} == {2_000} and len(frames) >= 2_998
    assert all(isinstance(event, Arrival) for event in bench.events)
    load, slept = bench.chip.load()
    assert slept > 0.15 * 3_000 * MS  # the processor has time left
    assert (
        50 < load["capture"].longest < 200 and 100 < load["capture"].waited < 400
    )  # [cycle] an edge waits for its turn
    assert 100 < load["receive"].waited < 900  # the real port has room for three bytes of 320 cycles, the emulated more


@pytest.mark.parametrize("connected", [True, False])
def test_stray_edges_come_at_their_rate(bench: Bench, connected: bool) -> None:
    bench.emulator.encoder_connected, bench.emulator.stray_edges = connected, 500.0
    bench.start()
    bench.drive(128, 1_000)
    turned = bench.emulator.shaft.angle / SLOT if connected else 0.0
    assert 400 < bench.last(Telemetry).edge_count - turned < 600  # Poisson, 22
    assert turned > 500 or not connected


@on_the_larger_chip_slowly
@pytest.mark.parametrize(
    ("sensing", "decay"), keep_fast([(False, 0), (False, 1), (True, 0), (True, 1)], (False, 1), (True, 0))
)
def test_a_sample_is_of_the_instant_at_which_the_pins_change(make_bench: MakeBench, sensing: bool, decay: int) -> None:
    """In ticks of half a microsecond, the interrupt's way to the pins taken off; R and L are identified by it."""
    bench = make_bench(config=FirmwareConfig(current_sense=sensing))
    bench.start(10_000, decay=decay)
    written: list[int] = []
    inner = bench.emulator._drive

    def drive(cycle: int) -> None:
        written.append(cycle)
        inner(cycle)

    bench.emulator._drive = drive  # type: ignore[method-assign]
    for duty in np.random.default_rng(1).integers(40, 250, 60):  # one way: a reversal lets go first
        bench.drive(int(duty), 5)
    times = np.array([frame.time for frame in bench.all(Telemetry)])
    at = (np.array(written) - bench.chip.clock_zero) / TICK
    late = at - times[np.argmin(np.abs(at[:, None] - times[None, :]), axis=1)]
    middle = np.median(late)
    assert len(late) == 60 and abs(middle) < 1.4
    assert np.quantile(np.abs(late - middle), 0.8) < 2.0  # an edge at that moment comes first, and takes some 10 µs
