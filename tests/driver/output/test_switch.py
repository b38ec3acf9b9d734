"""The output's switch: on only by the user's wish and the board's word, off when in doubt."""

import re
from dataclasses import replace

import pytest
from board_frames import TELEMETRY, enabled

from motor_driver.frames.codes import Flag
from motor_driver.frames.from_host import Enable
from motor_driver.output.switch import ASK_EVERY, ASKED, Output, Switch, reason_off


def turned_on() -> Switch:
    switch = Switch()
    assert switch.asks(True, TELEMETRY, 0) == Enable(1, TELEMETRY.boot, TELEMETRY.latch)
    assert not switch.hear(enabled())
    return switch


def test_it_is_off_until_the_board_says_on() -> None:
    switch = Switch()
    assert switch.output is Output.OFF and not switch.listening and switch.asks(False, TELEMETRY, 0) is None
    switch.asks(True, TELEMETRY, 0)
    assert switch.output is Output.TURNING_ON and switch.listening
    assert not switch.hear(enabled(False)) and switch.output is Output.TURNING_ON  # said before it heard
    switch.hear(enabled())
    assert switch.output is Output.ON and switch.asks(True, TELEMETRY, 1) is None


def test_it_asks_again_until_it_is_answered() -> None:
    switch = Switch()
    asked = [switch.asks(True, TELEMETRY, now) is not None for now in (0, ASK_EVERY - 1, ASK_EVERY, 2 * ASK_EVERY)]
    assert asked == [True, False, True, True]


@pytest.mark.parametrize(
    ("asked", "after", "unheard"), [(ASKED, 201, True), (ASKED - 1, 201, False), (ASKED, 200, False)]
)
def test_a_board_that_does_not_switch_on_however_often_it_is_asked_hears_nothing(
    asked: int, after: int, unheard: bool
) -> None:
    """A driver that stood still has asked less often, and what was answered meanwhile is still to be read."""
    switch, ms = Switch(), 1_000_000
    for k in range(asked):
        assert switch.asks(True, TELEMETRY, 1000 * ms + k * ASK_EVERY) is not None
    assert switch.unheard((1000 + after) * ms, 200.0 * ms) is unheard
    switch.hear(enabled())
    assert not switch.unheard(10_000 * ms, 200.0 * ms)
    switch.asks(False, TELEMETRY, 10_000 * ms)
    assert not switch.unheard(20_000 * ms, 200.0 * ms)


def test_before_it_is_sure_what_the_board_was_told_nothing_is_switched_on() -> None:
    switch = Switch()
    assert switch.asks(True, None, 0) is None and switch.output is Output.TURNING_ON
    assert switch.asks(True, TELEMETRY, ASK_EVERY) == Enable(1, TELEMETRY.boot, TELEMETRY.latch)
    assert switch.asks(False, None, 2 * ASK_EVERY) == Enable(0)


@pytest.mark.parametrize("ready", [ASKED - 1, 5])
def test_what_takes_too_long_before_an_enable_is_a_stop_too_and_an_enable_has_its_own_time(ready: int) -> None:
    switch, ms = Switch(), 1_000_000
    for k in range(ASKED):
        assert switch.asks(True, None, k * 30 * ms) is None
        assert switch.unheard(k * 30 * ms, 200.0 * ms) is (k == ASKED - 1)
    switch = Switch()
    for k in range(ready):
        switch.asks(True, None, k * 30 * ms)
    for k in range(ASKED):
        assert switch.asks(True, TELEMETRY, (300 + k * 10) * ms) is not None
    assert not switch.unheard(500 * ms, 200.0 * ms) and switch.unheard(501 * ms, 200.0 * ms)
    switch.asks(True, None, 502 * ms)
    switch.asks(True, TELEMETRY, 512 * ms)  # somebody goes on telling the board otherwise
    assert switch.unheard(512 * ms, 200.0 * ms)


@pytest.mark.parametrize(("at", "late"), [(400, False), (401, True)])
def test_a_board_that_has_to_be_told_first_may_take_longer_for_that(at: int, late: bool) -> None:
    switch, ms = Switch(), 1_000_000
    for k in range(ASKED):
        switch.asks(True, None, k * 30 * ms)
    assert switch.unheard(at * ms, 200.0 * ms, 400.0 * ms) is late
    switch.asks(True, TELEMETRY, 410 * ms)
    for k in range(1, ASKED):
        assert not switch.unheard((410 + k * 20) * ms, 200.0 * ms, 400.0 * ms)
        switch.asks(True, TELEMETRY, (410 + k * 20) * ms)
    assert switch.unheard(611 * ms, 200.0 * ms, 400.0 * ms)


def test_the_users_off_is_asked_for_at_once() -> None:
    switch = turned_on()
    assert switch.asks(False, TELEMETRY, 1) == Enable(0) and not switch.listening
    assert not switch.hear(enabled()) and switch.output is Output.TURNING_OFF
    assert not switch.hear(enabled(False)) and switch.output is Output.OFF


def test_the_users_off_does_not_wait_for_a_board_that_has_not_said_on_yet() -> None:
    switch = Switch()
    assert switch.asks(True, TELEMETRY, 0) == Enable(1, TELEMETRY.boot, TELEMETRY.latch)
    assert switch.asks(False, TELEMETRY, 1) == Enable(0) and not switch.listening
    assert switch.asks(False, TELEMETRY, 1 + ASK_EVERY) == Enable(0)  # again, until it says off
    assert not switch.hear(enabled(False)) and switch.output is Output.OFF
    assert not switch.hear(enabled()) and switch.asks(False, TELEMETRY, 2 * ASK_EVERY) == Enable(0)  # and is on yet


def test_a_board_that_switches_off_by_itself_is_noticed_once() -> None:
    switch = turned_on()
    assert switch.hear(enabled(False)) and switch.output is Output.OFF
    assert not switch.hear(enabled(False))


MS = 1_000_000  # [ns]


@pytest.mark.parametrize(("late", "falls"), [(400, False), (401, True)])
def test_an_off_that_was_still_under_way_when_it_was_switched_on_again_is_no_fall(late: int, falls: bool) -> None:
    """On, off and on within a round trip: the board said that it was on by the first, and was off by the second."""
    switch = Switch()
    assert switch.asks(True, TELEMETRY, 0) and switch.asks(False, TELEMETRY, 100 * MS) == Enable(0)
    assert not switch.hear(enabled(False), 110 * MS, 400.0 * MS)
    assert switch.asks(True, TELEMETRY, 150 * MS) and not switch.hear(enabled(), 200 * MS, 400.0 * MS)
    off = replace(TELEMETRY, latch=TELEMETRY.latch + 1)
    assert switch.hear(off, (100 + late) * MS, 400.0 * MS) is falls and switch.output is Output.OFF
    assert switch.asks(True, off, 900 * MS) == Enable(1, off.boot, off.latch)  # where that is the user's wish


@pytest.mark.parametrize("flag", [Flag.TIMED_OUT, Flag.OVERCURRENT, Flag.CURRENT_UNKNOWN])
def test_what_a_board_says_of_its_own_fall_is_believed_beside_an_off_that_is_under_way(flag: Flag) -> None:
    switch = Switch()
    assert switch.asks(True, TELEMETRY, 0) and switch.asks(False, TELEMETRY, 100 * MS) == Enable(0)
    assert not switch.hear(enabled(False), 110 * MS, 400.0 * MS)
    assert switch.asks(True, TELEMETRY, 150 * MS) and not switch.hear(enabled(), 200 * MS, 400.0 * MS)
    assert switch.hear(replace(TELEMETRY, flags=flag), 300 * MS, 400.0 * MS)


@pytest.mark.parametrize(("doubted", "most"), [(False, 400), (True, 800)])
def test_a_board_that_has_to_be_told_again_meanwhile_may_take_longer(doubted: bool, most: int) -> None:
    """An off that was under way moved its latch after the first enable: it is told anew, and then asked once more."""
    switch = Switch()
    for k in range(most // 10 + 1):
        switch.asks(True, None if doubted and 5 <= k < 50 else TELEMETRY, k * ASK_EVERY)
        assert not switch.unheard(k * ASK_EVERY, 400.0 * MS, 800.0 * MS)
    assert switch.unheard(most * MS + 1, 400.0 * MS, 0.0) and switch.unheard(most * MS + 1, 400.0 * MS, 800.0 * MS)


@pytest.mark.parametrize("flag", [Flag.TIMED_OUT, Flag.OVERCURRENT, Flag.CURRENT_UNKNOWN])
def test_a_board_that_was_on_and_off_again_in_frames_that_are_lost_is_not_asked_again(flag: Flag) -> None:
    switch = Switch()
    switch.asks(True, TELEMETRY, 0)
    assert not switch.hear(replace(TELEMETRY, flags=flag))  # of a fall before: its latch is the one that was named
    assert not switch.hear(replace(TELEMETRY, latch=TELEMETRY.latch + 1))  # an enable(0) that was still under way
    fell = replace(TELEMETRY, latch=TELEMETRY.latch + 1, flags=flag)
    assert switch.hear(fell) and switch.output is Output.OFF
    assert not switch.hear(fell) and switch.asks(True, fell, 1) == Enable(1, fell.boot, fell.latch)  # once it is wished


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (0, "the board switched off"),
        (Flag.TIMED_OUT, "heard no command for too long"),
        (Flag.OVERCURRENT, "above current_limit, .* let the motor cool"),
        (Flag.CURRENT_UNKNOWN, "could not measure the motor's current for ten samples, and current_limit needs it"),
    ],
)
def test_why_a_board_switched_off_is_said(flags: int, words: str) -> None:
    assert re.search(words, reason_off(replace(TELEMETRY, flags=flags)))


def test_an_output_that_is_on_unasked_is_switched_off() -> None:
    switch = Switch()
    assert not switch.hear(enabled()) and switch.output is Output.TURNING_OFF
    assert switch.asks(False, TELEMETRY, 0) == Enable(0)
