"""The firmware's output and its whole device, on this computer, over hours that no emulator could run."""

from ctypes import byref
from dataclasses import dataclass

import firmware_core as core
import pytest
from core_board import LEAD, WRAP, CoreBoard
from hypothesis import given
from hypothesis import strategies as st

from motor_driver.frames.codes import Flag
from motor_driver.frames.from_board import Hello, Pong, Sensed, Telemetry
from motor_driver.frames.from_host import Command, Configure, Enable, Identify, Ping, Protect, Setup
from motor_driver.frames.table import Frame

TIMEOUT = 200  # [tick] of the output under test
AHEAD = 2048  # numbers that count as newer

steps = st.lists(
    st.tuples(
        st.sampled_from(["off", "enable", "stale enable", "command", "old command", "far command", "check", "latch"]),
        st.integers(-400, 400),  # duty
        st.integers(0, 150),  # [tick] that pass before
    ),
    max_size=60,
)


@dataclass
class Model:
    """What the rules of wire.yaml say, in Python."""

    on: bool = False
    latch: int = 0
    newest: int = 0
    number: int = 0  # of the newest frame that acted
    heard: int = 0

    def off(self) -> None:
        self.on, self.newest, self.latch = False, 0, (self.latch + 1) % 256


@given(steps, st.integers(0, 2**33), st.integers(0, 255))
def test_the_output_keeps_the_rules(script: list[tuple[str, int, int]], start: int, latch: int) -> None:
    lib, output, model = core.load(), core.Output(top=256, timeout=TIMEOUT, boot=7, latch=latch), Model(latch=latch)
    now = start
    for number, (what, duty, wait) in enumerate(script, start):
        now += wait
        number -= 1 + duty % 40 if what == "old command" else 0  # sent before
        number += AHEAD - 200 + duty if what == "far command" else 0  # of another day
        if what == "off":
            lib.output_off(byref(output))
            model.off()
        elif "enable" in what:
            named = (model.latch + (what != "enable")) % 256
            lib.output_enable(byref(output), byref(core.WireEnable(1, 7, named)), number % 65536, now % WRAP)
            if what == "enable" and not model.on:
                model.on, model.newest, model.number, model.heard = True, 0, number, now
        elif "command" in what:
            lib.output_command(byref(output), byref(core.WireCommand(duty)), number % 65536, now % WRAP)
            if not model.on or 0 < number - model.number <= AHEAD:
                model.number, model.heard = number, now
                model.newest = max(-256, min(256, duty)) if model.on else 0
        elif what == "check":
            lib.output_check(byref(output), now % WRAP)
            if model.on and now - model.heard > TIMEOUT:
                model.off()
                assert output.timed_out
        else:
            lib.output_latch(byref(output))
            assert output.duty == (model.newest if model.on else 0)
        assert (output.on, output.latch, output.newest) == (model.on, model.latch, model.newest)


@pytest.mark.slow
def test_samples_stay_on_their_grid_for_an_hour_while_the_clock_wraps() -> None:
    """Two wraps of the 32-bit clock: 72 min at the longest period, every tick exactly one period after the last."""
    board = CoreBoard()
    board.step()
    board.send(Configure(2**24, 1_000, 0))
    board.step()
    first = board.now
    board.hear()
    times = []
    while board.now < 2.2 * WRAP:
        board.step()
        times += [frame.time for frame in board.hear() if isinstance(frame, Telemetry)]
    assert len(times) == (board.now - first) // 2**24 > 500
    assert times == [(first + LEAD + (k + 1) * 2**24) % WRAP for k in range(len(times))]


def test_a_tick_that_could_not_be_sent_is_left_out_and_counted() -> None:
    board = CoreBoard()
    for _ in range(4):
        board.step()
    board.send(Ping(9))
    pong, telemetry, _ = board.hear()
    assert isinstance(pong, Pong) and pong.dropped_samples == 3 and pong.token == 9
    assert isinstance(telemetry, Telemetry) and telemetry.time == 40_000 + LEAD


def test_a_pong_waits_for_quiet_and_then_goes_first() -> None:
    board = CoreBoard()
    board.step()
    board.send(Ping(1))
    assert board.hear(quiet=False) == []
    assert [type(frame) for frame in board.hear()] == [Pong, Telemetry, Hello]


def test_frames_that_are_not_for_a_board_have_no_effect() -> None:
    board = CoreBoard()
    board.hear()
    assert not board.send(Pong(1, 2, 3, 4, 5)) and board.hear() == []
    assert not board.send(Enable(1, 5, 0), version=2)
    assert isinstance(board.hear()[0], Hello)  # so that the other side learns which version is spoken here
    board.step()
    (telemetry,) = board.hear()
    assert isinstance(telemetry, Telemetry) and not telemetry.enabled


def test_a_command_acts_at_the_next_tick_and_no_longer_than_the_time_out() -> None:
    board = CoreBoard()
    board.send(Enable(1, 5, 0))
    board.send(Command(99))
    assert board.device.output.duty == 0
    duties = []
    for _ in range(25):
        board.step()
        duties.append(board.device.output.duty)
    assert duties == [99] * 20 + [0] * 5  # 100 ms are 20 samples
    board.send(Command(99))
    board.step()
    assert board.device.output.duty == 0 and board.device.output.latch == 1
    last = board.hear()[0]
    assert isinstance(last, Telemetry) and last.flags & (Flag.ENABLED | Flag.TIMED_OUT) == Flag.TIMED_OUT


def test_a_new_period_does_not_wait_for_the_end_of_a_long_one() -> None:
    board = CoreBoard()
    board.send(Configure(2**24, 1_000, 0))
    for _ in range(3):
        board.step()
    board.hear()
    board.send(Configure(2_000, 1_000, 0))
    begun = board.now
    times = []
    for _ in range(3):
        board.step()
        times += [frame.time for frame in board.hear() if isinstance(frame, Telemetry)]
    assert 0 < times[0] - LEAD - begun <= 0x8000 and times[1] - times[0] == times[2] - times[1] == 2_000


@pytest.mark.parametrize("period", [0x2801, 0x8001, 32_787, 0xFFFF, 0x10001, 65_574, 98_361, 2**24])
def test_no_compare_interrupt_follows_another_at_once(period: int) -> None:
    """The counter would have passed it before it is set to it, and would go round once more."""
    board, steps = CoreBoard(), []
    board.send(Configure(period, 1_000, 0))
    board.step()
    for _ in range(2 + 2 * (period // 0x1400)):
        before = board.now
        board.step()
        steps.append(board.now - before)
    assert min(steps) >= 0x1400 and max(steps) <= 0x2800


@pytest.mark.parametrize(("period", "late"), [(2_000, 2_400), (2_000, 9_000), (10_000, 9_700), (40_000, 30_000)])
def test_a_compare_interrupt_that_is_held_up_is_followed_by_one_that_is_ahead(period: int, late: int) -> None:
    """The counter would have passed it, and would go round once more: all of the board's times were 33 ms late."""
    board = CoreBoard()
    board.send(Configure(period, 1_000, 0))
    for _ in range(6):
        board.step()
    board.hear()
    board.step(late)
    assert 100 <= (board.compare - board.now) % 65536 <= 0x8000
    for _ in range(6):
        board.step()
    times = [frame.time for frame in board.hear() if isinstance(frame, Telemetry)]
    assert 0 <= board.now + LEAD - times[-1] < period and len({time % period for time in times}) == 1


def test_a_command_that_came_after_the_tick_is_not_late() -> None:
    """The interrupt may wait for the main loop, which takes a command meanwhile."""
    output, lib = core.Output(on=True, top=256, timeout=TIMEOUT), core.load()
    lib.output_command(byref(output), byref(core.WireCommand(5)), 1, 1_010)
    lib.output_check(byref(output), 1_000)
    assert output.on
    lib.output_check(byref(output), 1_010 + TIMEOUT)
    assert output.on
    lib.output_check(byref(output), 1_011 + TIMEOUT)
    assert not output.on and output.timed_out


def test_identify_gives_a_hello_and_changes_nothing() -> None:
    board = CoreBoard()
    (first,) = board.hear()
    board.send(Identify())
    assert board.hear() == [first]


SENSING = core.DeviceConfig(1, 0, 96, 1, 500, 256, 2_000, 2_000, 10_000, LEAD, 100, 0, True)
TRIPPED = Flag.OVERCURRENT | Flag.CURRENT_UNKNOWN


def protected(most: int) -> CoreBoard:
    """A board that senses the current, watches it, and is on."""
    board = CoreBoard(SENSING)
    assert board.send(Protect(512, most, most, 2**30 - 1)) and board.send(Enable(1, 5, 1))
    return board


def tick(board: CoreBoard, current: int | None) -> Sensed:
    """The next sample, after a conversion of the current or without one."""
    if current is not None:
        board.device.current = current
    board.send(Command(100))
    board.step()
    frame = board.hear()[0]
    assert isinstance(frame, Sensed)
    return frame


@pytest.mark.parametrize(("current", "samples", "flag"), [(720, 2, Flag.OVERCURRENT), (None, 10, Flag.CURRENT_UNKNOWN)])
def test_too_much_current_or_none_converted_is_off_and_says_which(
    current: int | None, samples: int, flag: Flag
) -> None:
    board = protected(200)
    for _ in range(samples - 1):
        frame = tick(board, current)
        assert frame.enabled and not frame.flags & TRIPPED
    frame = tick(board, current)
    assert not frame.enabled and frame.flags & TRIPPED == flag
    assert tick(board, 512).flags & TRIPPED == flag and board.device.output.duty == 0


def test_without_a_limit_no_current_need_be_converted() -> None:
    board = protected(0)
    assert all(tick(board, None).enabled for _ in range(30))


@pytest.mark.parametrize(
    "frame", [Enable(0), Configure(10_000, 100, 0), Setup(1, 0), Protect(512, 200, 200, 2**30 - 1)]
)
def test_a_later_way_off_was_not_the_current(frame: Frame) -> None:
    board = protected(200)
    for _ in range(2):
        latest = tick(board, 720)
    assert latest.flags & Flag.OVERCURRENT
    assert board.send(Enable(1, 5, latest.latch - 1))  # a stale one changes nothing
    assert tick(board, 512).flags & Flag.OVERCURRENT
    assert board.send(frame)
    assert not tick(board, 512).flags & TRIPPED
