"""The real firmware on the emulated chip, on a clock of the test's own: what the pins do, and what is said about it."""

from collections.abc import Callable

import numpy as np
import pytest
from emulated_board import MS, TICK, Bench, on_each_chip

from motor_board.build import FirmwareConfig
from motor_board.emulation.chip import Hang, Pins
from motor_driver.frames.codes import Board, Flag, ResetCause
from motor_driver.frames.from_board import Hello, Pong, Telemetry
from motor_driver.frames.from_host import Command, Configure, Enable, Identify, Ping
from motor_driver.protocol import pack

MakeBench = Callable[..., Bench]
SLOT = 2 * np.pi / 96


@on_each_chip
def test_says_hello_by_itself_at_power_up(bench: Bench, chip: str) -> None:
    bench.run(4)
    hello = bench.last(Hello)
    kind = Board[chip.upper()]
    assert hello == Hello(1, 4, 6, kind, 0, 0, 1, 500, 256, 0, 10_000, 2_000, 100, ResetCause.POWER_ON, hello.boot, 0)
    assert bench.events[0].seq == 0 and bench.chip.pins.share == 0.0


def test_hello_tells_how_it_was_flashed(make_bench: MakeBench) -> None:
    config = FirmwareConfig("tb6612", board_id=513, edges_per_revolution=500, channels=2, supply_full_scale=20_000)
    bench = make_bench(config=config)
    bench.run(4)
    hello = bench.last(Hello)
    assert (hello.board_id, hello.edges_per_revolution, hello.channels) == (513, 500, 2)


def test_limits_what_it_cannot_do_and_says_so(bench: Bench) -> None:
    bench.run(4)
    bench.send(Configure(100, 60_000, 7))
    bench.run(4)
    hello = bench.last(Hello)
    assert (hello.sample_period, hello.command_timeout, hello.decay) == (2_000, 1_000, 0)
    bench.send(Configure(2**31, 1, 1))
    bench.run(4)
    hello = bench.last(Hello)
    assert (hello.sample_period, hello.command_timeout, hello.decay) == (2**24, 10, 1)


def test_nothing_moves_the_pins_before_an_enable(bench: Bench) -> None:
    bench.run(8)
    bench.drive(256, 100)
    assert bench.chip.pins.share == 0.0 and bench.emulator.shaft.speed == 0.0
    assert not any(telemetry.flags & Flag.ENABLED or telemetry.duty for telemetry in bench.all(Telemetry))
    assert bench.last(Telemetry).command > 0


@pytest.mark.parametrize("wrong", [(1, 0), (0, 1), (255, 255)], ids=["boot", "latch", "both"])
def test_an_enable_for_another_time_does_nothing(bench: Bench, wrong: tuple[int, int]) -> None:
    bench.run(8)
    now = bench.last(Telemetry)
    bench.send(Enable(1, now.boot + wrong[0] & 0xFF, now.latch + wrong[1] & 0xFF))
    bench.run(12)
    assert not bench.last(Telemetry).enabled
    bench.enable()


@on_each_chip
def test_the_newest_command_is_latched_at_the_tick_and_the_pins_follow(bench: Bench) -> None:
    bench.start()
    bench.run_until(lambda: len(bench.all(Telemetry)) > 0, 6)
    before = bench.last(Telemetry)
    bench.send(Command(10), Command(-64))
    bench.run(1)
    assert bench.chip.pins.share == 0.0  # not before the tick
    bench.run_until(lambda: bench.chip.pins.share != 0.0, 6)
    tick = bench.chip.clock_zero + (before.time + 10_000) * TICK
    assert -128 <= bench.chip.written - tick <= 128  # [cycle]: 8 us
    bench.run(2)
    after = bench.last(Telemetry)
    assert (after.time, after.duty, after.command) == (before.time + 10_000, -64, bench.encode.seq - 1)
    assert bench.chip.pins.share == -0.25


@pytest.mark.parametrize("duty", [256, 255, 128, 1, 0, -1, -128, -256, 300, -32768])
@pytest.mark.parametrize(("bridge", "decay"), [("l298n", 0), ("l298n", 1), ("tb6612", 0), ("tb6612", 1)])
def test_every_duty_in_both_decays_on_both_bridges(make_bench: MakeBench, bridge: str, decay: int, duty: int) -> None:
    """One wiring: what is pulsed decides whether the bridge brakes or coasts in the off part of a period."""
    bench = make_bench(config=FirmwareConfig(bridge))
    bench.start(2_000, decay=decay)
    bench.drive(duty, 4, 1)
    limited = max(-256, min(256, duty))
    pins = bench.chip.pins
    assert pins.share == limited / 256 and bench.last(Telemetry).duty == limited
    pulsed_enable = (bridge, decay) in {("l298n", 1), ("tb6612", 0)}
    rest = 256 if bridge == "tb6612" else 0  # both inputs high is its short brake, as PWM low is
    if pulsed_enable and limited == 0:
        assert (pins.enable, pins.forward, pins.reverse) == (0, rest, rest)
    elif pulsed_enable:
        assert pins.enable == abs(limited) and {pins.forward, pins.reverse} == {0, 256}
    else:
        assert (pins.enable, pins.forward, pins.reverse) == (256, max(limited, 0), max(-limited, 0))


@on_each_chip
@pytest.mark.parametrize("timeout", [20, 100])
def test_without_commands_the_pins_go_to_0_v_and_stay_there(bench: Bench, timeout: int) -> None:
    bench.start(timeout=timeout)
    bench.drive(200, 300)
    latch = bench.last(Telemetry).latch
    silent = bench.chip.cycle - 5 * MS  # the latest command
    off = bench.run_until(lambda: bench.chip.pins.share == 0.0, 150)
    assert timeout * MS <= off - silent <= (timeout + 6) * MS
    bench.run(6)
    last = bench.last(Telemetry)
    assert last.flags & (Flag.ENABLED | Flag.TIMED_OUT) == Flag.TIMED_OUT and last.latch == latch + 1
    bench.drive(200, 50)
    assert bench.chip.pins.share == 0.0 and not bench.last(Telemetry).enabled
    bench.enable()
    assert bench.chip.pins.share == 0.0  # what was commanded before does not come back
    bench.drive(200, 10)
    assert bench.chip.pins.share == 200 / 256


@on_each_chip
@pytest.mark.parametrize("period", [14_355, 32_787, 98_361], ids=["139 Hz", "61 Hz", "20.33 Hz"])
def test_a_missing_command_is_noticed_at_any_sample_rate(bench: Bench, period: int) -> None:
    """Longest steps of the counter and some us: it was set to what it had passed, and its time fell behind."""
    bench.start(period)
    bench.drive(200, 500)
    silent = bench.chip.cycle - 5 * MS  # the latest command
    off = bench.run_until(lambda: bench.chip.pins.share == 0.0, 150)
    assert 100 * MS <= off - silent <= 118 * MS


def test_disable_and_configure_switch_off_within_a_sample(bench: Bench) -> None:
    for frame in (Enable(0), Configure(10_000, 100, 0)):
        bench.run(8)
        bench.enable()
        bench.drive(256, 50)
        bench.send(frame)
        bench.run(6)
        assert bench.chip.pins.share == 0.0
        bench.run(4)
        assert not bench.last(Telemetry).enabled


def test_off_does_not_wait_for_a_slow_sample(bench: Bench) -> None:
    bench.start(period=200_000)
    bench.drive(256, 200)
    bench.send(Enable(0))
    bench.run(17)
    assert bench.chip.pins.share == 0.0


@on_each_chip
@pytest.mark.parametrize("how", Hang, ids=lambda how: how.name.lower())
def test_a_program_that_hangs_is_reset_by_the_watchdog(bench: Bench, how: Hang) -> None:
    bench.start()
    bench.drive(256, 300)
    boot = bench.last(Telemetry).boot
    hung = bench.chip.cycle
    bench.chip.hang(how)
    off = bench.run_until(lambda: bench.chip.resets > 0, 150)
    assert off - hung <= 85 * MS and bench.chip.pins.share == 0.0
    bench.run(10)
    hello = bench.last(Hello)
    assert hello.reset_cause == ResetCause.WATCHDOG and hello.boot == (boot + 1) & 0xFF
    bench.drive(256, 50)
    assert bench.chip.pins.share == 0.0 and bench.chip.resets == 1  # runs on, off


@pytest.mark.parametrize("how", Hang, ids=lambda how: how.name.lower())
def test_commands_that_keep_coming_hold_off_no_watchdog_of_a_program_that_hangs(bench: Bench, how: Hang) -> None:
    """Each wakes the main loop: where that alone goes on, no tick notices that a command is missing."""
    bench.start()
    bench.drive(256, 100)
    hung = bench.chip.cycle
    bench.chip.hang(how)
    while bench.chip.resets == 0:
        assert bench.chip.cycle - hung <= 85 * MS
        bench.drive(256, 2, 1)
    assert bench.chip.pins.share == 0.0
    bench.drive(256, 50)
    assert bench.chip.pins.share == 0.0 and bench.chip.resets == 1


@on_each_chip
@pytest.mark.parametrize("after", [20, 200, 2_000, 20_000, 60_000])  # [cycle]
def test_a_program_that_hangs_while_it_boots_drives_nothing(bench: Bench, after: int) -> None:
    """Pins that nobody drives are held low by the pull-downs of the wiring; the others were never high."""
    bench.start()
    bench.drive(256, 100)
    assert bench.chip.pins.share != 0.0
    bench.emulator.reset()
    bench.chip.run(bench.chip.cycle + after)
    assert bench.chip.pins.share == 0.0
    bench.chip.hang(Hang.HALTED)
    for _ in range(50):
        bench.run(10)
        assert bench.chip.pins.share == 0.0


@on_each_chip
def test_a_board_that_has_booted_brakes_at_once(bench: Bench) -> None:
    """At its first tick, 5 ms later, it did, and till then the motor ran on freely."""
    bench.run(1)
    assert bench.chip.pins == Pins(256, 0, 0)


def test_after_a_reset_the_output_stays_off_until_an_enable_of_this_boot(bench: Bench) -> None:
    bench.start()
    bench.drive(256, 100)
    old = bench.last(Telemetry)
    bench.emulator.reset()
    assert bench.chip.pins.share == 0.0
    bench.run(8)
    assert bench.last(Hello).reset_cause == ResetCause.EXTERNAL
    bench.send(Enable(1, old.boot, old.latch))
    bench.drive(256, 30)
    new = bench.last(Telemetry)
    assert new.boot == (old.boot + 1) & 0xFF and new.latch == 0 and new.edge_count < old.edge_count
    assert bench.chip.pins.share == 0.0 and not new.enabled
    bench.enable()


@on_each_chip
def test_no_start_has_the_number_of_a_recent_one(bench: Bench) -> None:
    """Over power-downs, too: an enable that was recorded before them is of another start."""
    bench.run(8)
    first = bench.last(Hello)
    numbers, latches = [first.boot], [first.latch]
    for k in range(270):
        (bench.emulator.reset if k % 3 else bench.emulator.power_up)()
        bench.run(6)
        assert bench.last(Hello).reset_cause == (ResetCause.EXTERNAL if k % 3 else ResetCause.POWER_ON)
        numbers.append(bench.last(Hello).boot)
        latches.append(bench.last(Hello).latch)
    assert numbers == [(numbers[0] + k) % 256 for k in range(271)]
    turned = numbers.index(128)  # in between, so that no boot comes again with the same latch
    assert set(latches[:turned]) == {0} and set(latches[turned:]) == {159}


def test_another_version_is_answered_with_a_hello_and_has_no_effect(bench: Bench) -> None:
    bench.start()
    bench.chip.feed(pack(Command(256), 9, version=2))
    bench.run(8)
    assert len(bench.all(Hello)) == 1 and bench.last(Telemetry).duty == 0
    bench.send(Ping(1))
    bench.run(4)
    assert bench.last(Pong).bad_frames == 1


def test_a_flood_of_garbage_costs_nothing_but_its_count(bench: Bench) -> None:
    bench.start()
    random = np.random.default_rng(0)
    for _ in range(60):
        bench.chip.feed(random.integers(0, 256, 200, dtype=np.uint8).tobytes())
        bench.send(Command(100))
        bench.chip.feed(b"\0")
        bench.send(Command(100))
        bench.run(6)
    assert bench.last(Telemetry).enabled and bench.last(Telemetry).duty == 100
    bench.send(Identify(), Ping(3))
    bench.run(8)
    assert bench.last(Pong).bad_frames > 20 and bench.last(Hello).firmware_major == 1
    assert bench.decode.counters.bad == bench.decode.counters.lost == 0
