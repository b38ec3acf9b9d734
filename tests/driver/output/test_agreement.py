"""What a board that runs was told: by this driver alone, or it is not switched on."""

from dataclasses import replace

import pytest
from board_frames import HELLO, TELEMETRY, enabled

from motor_driver.config import Config
from motor_driver.current_limits import CurrentLimits
from motor_driver.frames.codes import Flag
from motor_driver.frames.from_board import Features, Hello, Protection
from motor_driver.frames.from_host import Configure, Protect, Setup
from motor_driver.output.agreement import TRIES, Agreement

CONFIG = Config(current_gain=0.185, current_limits=CurrentLimits(5.0, 2.0, 1.0))
RAN = replace(HELLO, firmware_minor=4, command_timeout=120, latch=250)  # its latch wraps soon
HELD = Protection(512, 189, 76, (558 - 90) * 31250)
FEATURES = Features(1, 0, 0)
EVERY = 100_000_000 // TRIES  # [ns]


def of_a_board(spare: int = 0) -> Agreement:
    return Agreement(CONFIG, RAN, spare)


def off(latch: int) -> Agreement:
    """The board is off, in telemetry, with another latch than the one that was agreed on."""
    agreed = of_a_board()
    assert not agreed.hear_telemetry(replace(TELEMETRY, latch=latch))
    assert agreed.latch is None and agreed.named is None
    return agreed


def answered(agreed: Agreement, latch: int) -> Agreement:
    """The board has said that it is as it was told."""
    for frame in (FEATURES, HELD, replace(RAN, latch=latch)):
        assert not agreed.hear(frame)
    return agreed


def test_a_board_that_has_been_told_nothing_since_may_be_switched_on() -> None:
    agreed = of_a_board()
    assert not agreed.hear_telemetry(replace(TELEMETRY, latch=250)) and agreed.named == RAN
    assert not agreed.hear_telemetry(replace(enabled(), latch=250)) and agreed.named == RAN
    assert agreed.asks(0, wish=True) == []


def test_one_that_went_off_is_told_everything_again_before_it_is_switched_on() -> None:
    agreed = off(251)
    assert agreed.asks(0, wish=False) == []
    asked = agreed.asks(0, wish=True)
    assert [type(frame) for frame in asked] == [Setup, Protect, Configure]
    assert agreed.asks(EVERY - 1, wish=True) == [] and agreed.asks(EVERY, wish=True) == asked
    assert answered(agreed, 254).named == replace(RAN, latch=254)
    assert agreed.asks(2 * EVERY, wish=True) == []


def test_what_the_latch_moves_before_the_board_is_told_again_is_nobody_else_s() -> None:
    """The switch asks a board off until it says so, and each of those frames adds 1."""
    agreed = off(251)
    for latch in (252, 255):
        assert not agreed.hear_telemetry(replace(TELEMETRY, latch=latch))
    agreed.asks(0, wish=True)
    assert not agreed.hear_telemetry(replace(TELEMETRY, latch=0))  # of ours, or not: the answers tell
    assert answered(agreed, 2).latch == 2


def test_a_board_of_old_firmware_is_told_what_it_knows() -> None:
    agreed = Agreement(Config(), replace(HELLO, latch=2))
    agreed.hear_telemetry(replace(TELEMETRY, latch=3))
    assert [type(frame) for frame in agreed.asks(0, wish=True)] == [Configure]
    assert not agreed.hear(replace(HELLO, latch=4)) and agreed.latch == 4


@pytest.mark.parametrize(("latch", "sure"), [(253, False), (254, True), (255, False), (0, False)])
def test_another_s_frames_between_ours_are_seen_in_the_latch(latch: int, sure: bool) -> None:
    """Fewer than ours is an answer to what was asked before; more is somebody else's, and ours may be undone."""
    agreed = off(251)
    agreed.asks(0, wish=True)
    answered(agreed, latch)
    assert (agreed.latch == latch) is sure
    if latch in (255, 0):  # it begins anew from there
        assert len(agreed.asks(1, wish=True)) == 3
        assert answered(agreed, (latch + 3) % 256).latch == (latch + 3) % 256


@pytest.mark.parametrize("missing", [FEATURES, HELD])
def test_without_one_of_the_answers_nothing_is_sure(missing: Features | Protection) -> None:
    agreed = off(251)
    agreed.asks(0, wish=True)
    for frame in (FEATURES, HELD, replace(RAN, latch=254)):
        assert frame is missing or not agreed.hear(frame)
    assert agreed.latch is None
    agreed.asks(EVERY, wish=True)
    assert answered(agreed, 1).latch == 1


@pytest.mark.parametrize(
    "other",
    [
        replace(RAN, command_timeout=1000, latch=251),
        replace(RAN, decay=1, latch=251),
        replace(RAN, pwm_top=100, latch=251),
        replace(RAN, sample_period=20_000, latch=251),
        Features(2, 0, 0),
        Features(1, 1, 0),
        replace(HELD, most=0),
        replace(HELD, budget=HELD.budget + 1),
    ],
)
def test_what_somebody_else_tells_a_board_is_noticed_and_made_good_at_once(
    other: Hello | Features | Protection,
) -> None:
    agreed = of_a_board()
    assert agreed.hear(other) and agreed.disturbed and agreed.named is None
    assert len(agreed.asks(0, wish=False)) == 3
    latch = other.latch if isinstance(other, Hello) else RAN.latch
    if not isinstance(other, Hello):  # nobody knows where the latch is: it is looked at once more
        answered(agreed, (latch + 4) % 256)
        assert agreed.latch is None
        latch = (latch + 4) % 256
        agreed.asks(1, wish=False)
    answered(agreed, (latch + 3) % 256)
    assert agreed.latch == (latch + 3) % 256 and not agreed.disturbed


def test_an_answer_to_somebody_who_only_asks_who_is_there_changes_nothing() -> None:
    agreed = of_a_board()
    for frame in (RAN, FEATURES, HELD, replace(RAN, latch=3)):
        assert not agreed.hear(frame)
    assert agreed.latch == 250


def test_our_own_frames_that_come_late_move_the_latch_with_them() -> None:
    """On a slow link the board is told again before its answer has come."""
    agreed = off(251)
    for k in range(3):
        agreed.asks(k * EVERY, wish=True)
    assert answered(agreed, 254).latch == 254
    assert not agreed.hear_telemetry(replace(TELEMETRY, latch=255)) and agreed.latch == 255
    assert answered(agreed, 1).latch == 1
    assert not agreed.hear_telemetry(replace(TELEMETRY, latch=4)) and agreed.latch == 4
    assert not agreed.hear_telemetry(replace(TELEMETRY, latch=5)) and agreed.latch is None  # nobody of ours


def test_frames_of_the_handshake_may_come_late_too() -> None:
    agreed = of_a_board(spare=1)
    assert not agreed.hear_telemetry(replace(TELEMETRY, latch=251)) and agreed.latch == 251
    assert not agreed.hear_telemetry(replace(TELEMETRY, latch=252)) and agreed.latch is None


def test_a_board_that_is_on_with_another_latch_was_switched_on_by_somebody_else() -> None:
    """Off and on again between two samples: it may be told anything."""
    agreed = of_a_board(spare=1)
    assert agreed.hear_telemetry(replace(TELEMETRY, latch=251, flags=Flag.ENABLED)) and agreed.latch == 250
    agreed = off(251)
    assert agreed.hear_telemetry(replace(TELEMETRY, latch=251, flags=Flag.ENABLED))
