"""From an opened port to a board that samples as configured."""

from dataclasses import replace

import pytest
from board_frames import HELLO, TELEMETRY

from motor_driver.config import Config
from motor_driver.current_limits import CurrentLimits
from motor_driver.frames.codes import Decay, Pwm, ResetCause
from motor_driver.frames.from_board import Features, Hello, OtherVersion, Protection
from motor_driver.frames.from_host import Configure, Identify, Protect, Setup
from motor_driver.handshake import ASK_EVERY, PATIENCE, Handshake, Phase, reset_cause

LIMITS = CurrentLimits(5.0, 2.0, 1.0)
GUARDING = replace(HELLO, firmware_minor=4)
HELD = Protection(512, 189, 76, (558 - 90) * 31250)  # what LIMITS are on the wire
ANSWER = replace(HELLO, command_timeout=120, latch=HELLO.latch + 1)  # as asked, and switched off by that


def handshake() -> Handshake:
    return Handshake(Config(), "the port", 0)


def configuring() -> Handshake:
    """It has been asked to sample as configured, once."""
    shaken = handshake()
    assert not shaken.hear(HELLO) and isinstance(shaken.asks(0), Configure)
    return shaken


def running() -> Handshake:
    shaken = configuring()
    assert shaken.hear(ANSWER)
    return shaken


def test_it_asks_who_is_there_then_configures_then_is_silent() -> None:
    shaken = handshake()
    assert shaken.asks(0) == Identify() and shaken.asks(1) is None and shaken.asks(ASK_EVERY) == Identify()
    assert not shaken.hear(HELLO) and shaken.phase is Phase.CONFIGURE
    assert shaken.asks(ASK_EVERY) == Configure(10_000, 120, 0)
    assert shaken.hear(ANSWER) and shaken.phase is Phase.RUN and shaken.asks(10 * ASK_EVERY) is None


@pytest.mark.parametrize(
    "answer", [replace(ANSWER, latch=HELLO.latch), replace(ANSWER, sample_period=2_000), replace(ANSWER, decay=1)]
)
def test_an_old_answer_or_another_configuration_is_not_the_end(answer: Hello) -> None:
    shaken = configuring()
    assert not shaken.hear(answer) and shaken.phase is Phase.CONFIGURE
    assert shaken.hear(ANSWER)


def test_a_board_that_is_refused_is_asked_again_and_said_why() -> None:
    shaken = handshake()
    shaken.hear(replace(HELLO, edges_per_revolution=12))
    assert shaken.phase is Phase.IDENTIFY and "an encoder with 12 edges" in shaken.problem(0)
    shaken.hear(HELLO)  # flashed right meanwhile
    assert shaken.phase is Phase.CONFIGURE and shaken.problem(0) == ""


def test_another_protocol_is_a_sentence() -> None:
    shaken = handshake()
    shaken.refuse(OtherVersion(9))
    assert "speaks protocol version 9" in shaken.problem(0)


def test_a_port_on_which_nothing_answers_is_told_after_a_while() -> None:
    shaken = handshake()
    assert shaken.problem(PATIENCE - 1) == "" and "the port" in shaken.problem(PATIENCE)
    assert running().problem(PATIENCE) == ""


def test_a_reset_is_seen_in_the_boots_number_and_begins_anew() -> None:
    shaken = running()
    assert not shaken.reset_in(TELEMETRY) and shaken.reset_in(replace(TELEMETRY, boot=8))
    shaken.begin_again()
    assert shaken.phase is Phase.IDENTIFY and not shaken.reset_in(replace(TELEMETRY, boot=8))


def test_causes_of_a_reset_are_named() -> None:
    assert reset_cause(HELLO) == "power on"
    both = replace(HELLO, reset_cause=ResetCause.BROWN_OUT | ResetCause.WATCHDOG)
    assert reset_cause(both) == "brown out, watchdog"
    assert reset_cause(replace(HELLO, reset_cause=0)) == "unknown cause"


def test_a_board_that_can_count_otherwise_is_told_how_before_it_is_configured() -> None:
    new = replace(HELLO, firmware_minor=2)
    shaken = handshake()
    assert not shaken.hear(new) and shaken.phase is Phase.SETUP and shaken.asks(ASK_EVERY) == Setup(1, 0)
    shaken.hear_features(Features(4, 0, 0))  # an old answer
    assert shaken.phase is Phase.SETUP
    shaken.hear_features(Features(1, 0, 0))
    assert shaken.phase is Phase.CONFIGURE and shaken.asks(2 * ASK_EVERY) == Configure(10_000, 120, 0)


def test_an_old_board_that_cannot_count_both_channels_is_refused() -> None:
    shaken = Handshake(Config(edges_per_revolution=44, single_channel=False, quadrature=4), "the port", 0)
    shaken.hear(replace(HELLO, edges_per_revolution=11, channels=2))
    assert "runs firmware 1.1, and quadrature 4 needs 1.2: flash" in shaken.problem(0)


def limited_until(phase: Phase) -> Handshake:
    """A handshake that sets current limits, and has come as far as `phase`."""
    shaken = Handshake(Config(current_gain=0.185, current_limits=LIMITS), "the port", 0)
    shaken.hear(GUARDING)
    if phase is not Phase.SETUP:
        shaken.hear_features(Features(1, 0, 0))
    if phase is Phase.CONFIGURE:
        shaken.hear_protection(HELD)
    assert shaken.phase is phase
    return shaken


@pytest.mark.parametrize("phase", [Phase.SETUP, Phase.PROTECT, Phase.CONFIGURE])
def test_a_board_that_is_reset_meanwhile_is_told_everything_again(phase: Phase) -> None:
    shaken = limited_until(phase)
    again = replace(GUARDING, boot=8)
    assert not shaken.hear(again) and shaken.phase is Phase.SETUP and shaken.hello == again
    assert isinstance(shaken.asks(10 * ASK_EVERY), Setup)
    assert not shaken.hear(replace(again, command_timeout=120, latch=again.latch + 1))  # it has no limits yet
    shaken.hear_features(Features(1, 0, 0))
    assert isinstance(shaken.asks(11 * ASK_EVERY), Protect)
    shaken.hear_protection(HELD)
    assert isinstance(shaken.asks(12 * ASK_EVERY), Configure)
    assert shaken.hear(replace(again, command_timeout=120, latch=again.latch + 3)) and shaken.phase is Phase.RUN


def test_a_hello_of_the_same_boot_begins_nothing_again() -> None:
    shaken = limited_until(Phase.PROTECT)
    assert not shaken.hear(replace(GUARDING, latch=2)) and shaken.phase is Phase.PROTECT


@pytest.mark.parametrize(
    "held", [replace(HELD, most=190), replace(HELD, rated=77), replace(HELD, budget=1), replace(HELD, zero=0)]
)
def test_other_limits_than_those_asked_for_are_asked_for_again(held: Protection) -> None:
    shaken = limited_until(Phase.PROTECT)
    shaken.hear_protection(held)
    assert shaken.phase is Phase.PROTECT
    assert shaken.asks(ASK_EVERY) == Protect(512, 189, 76, (558 - 90) * 31250)


def test_a_board_that_cannot_watch_the_current_is_refused() -> None:
    shaken = Handshake(Config(current_gain=0.185, current_limits=LIMITS), "the port", 0)
    shaken.hear(replace(HELLO, firmware_minor=3))
    assert "runs firmware 1.3, and current_limit needs 1.4: flash" in shaken.problem(0)
    assert shaken.phase is Phase.IDENTIFY


@pytest.mark.parametrize("change", [{"tick_ns": 0}, {"pwm_top": 0}, {"edges_per_revolution": 12}])
def test_an_answer_that_says_otherwise_than_the_hello_before_is_refused(change: dict[str, int]) -> None:
    shaken = configuring()
    assert not shaken.hear(replace(ANSWER, **change)) and shaken.phase is Phase.CONFIGURE
    assert shaken.problem(0)
    assert shaken.hear(ANSWER) and shaken.problem(0) == ""


def test_at_a_roll_call_a_board_is_asked_who_it_is_and_nothing_else() -> None:
    """It may drive another one's motor, whose driver a configure would switch off."""
    shaken = Handshake(Config(), "the port", 0, roll_call=True)
    assert shaken.asks(0) == Identify()
    assert not shaken.hear(HELLO) and shaken.matches and shaken.phase is Phase.IDENTIFY
    assert shaken.asks(10 * ASK_EVERY) == Identify()


def asked_until_configure() -> Handshake:
    """A handshake that sets current limits, and has asked each of its three frames once."""
    shaken = Handshake(Config(current_gain=0.185, current_limits=LIMITS), "the port", 0)
    shaken.hear(GUARDING)
    assert isinstance(shaken.asks(0), Setup)
    shaken.hear_features(Features(1, 0, 0))
    assert isinstance(shaken.asks(ASK_EVERY), Protect)
    shaken.hear_protection(HELD)
    assert isinstance(shaken.asks(2 * ASK_EVERY), Configure)
    return shaken


@pytest.mark.parametrize(("moved", "runs"), [(2, False), (3, True), (4, False)])
def test_each_frame_that_a_board_was_told_has_moved_its_latch_by_one(moved: int, runs: bool) -> None:
    """Less is an answer to something before, more is somebody else's: a setup or limits of another driver between."""
    shaken = asked_until_configure()
    assert shaken.hear(replace(GUARDING, command_timeout=120, latch=GUARDING.latch + moved)) is runs
    assert shaken.phase is {2: Phase.CONFIGURE, 3: Phase.RUN, 4: Phase.IDENTIFY}[moved]


def test_a_frame_that_was_sent_twice_may_have_acted_once_or_twice() -> None:
    for moved in (3, 4):
        shaken = asked_until_configure()
        assert isinstance(shaken.asks(3 * ASK_EVERY), Configure)
        assert shaken.hear(replace(GUARDING, command_timeout=120, latch=GUARDING.latch + moved)), moved


@pytest.mark.parametrize(
    "other", [Features(2, 0, 0), Features(1, 1, 3), replace(HELD, most=0), replace(HELD, budget=1)]
)
def test_what_somebody_else_tells_a_board_meanwhile_is_told_again(other: Features | Protection) -> None:
    shaken = asked_until_configure()
    shaken.hear_features(other) if isinstance(other, Features) else shaken.hear_protection(other)
    assert shaken.phase is Phase.IDENTIFY


def test_the_steps_of_duty_of_a_reset_board_are_those_of_its_first_pwm() -> None:
    """With silent_pwm they are others once it is configured: its own driver took it for another board."""
    config = Config(pwm=Pwm.SILENT, decay=Decay.COAST)
    new = replace(HELLO, firmware_minor=2)
    ran = replace(new, pwm_top=100, decay=Decay.COAST)
    shaken = Handshake(config, "the port", 0, before=ran)
    assert not shaken.hear(new) and shaken.problem(0) == ""
    shaken.asks(0)
    shaken.hear_features(Features(1, 1, 2))
    shaken.asks(ASK_EVERY)
    odd = replace(new, decay=Decay.COAST, command_timeout=120, latch=new.latch + 2)
    assert not shaken.hear(odd) and "steps of duty 256 instead of 100" in shaken.problem(0)
    assert shaken.hear(replace(odd, pwm_top=100))
