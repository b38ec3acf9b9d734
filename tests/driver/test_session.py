"""What is due on an opened port."""

from dataclasses import replace

from board_frames import HELLO, TELEMETRY, enabled

from motor_driver.config import Config
from motor_driver.exchange import Exchange
from motor_driver.frames.codes import BAUD
from motor_driver.frames.from_host import Command, Configure, Enable, Identify, Ping
from motor_driver.frames.table import Frame
from motor_driver.handshake import Handshake
from motor_driver.protocol import Arrival, Decoder
from motor_driver.session import REPEAT, Session


def opened() -> Session:
    return Session("the port", Handshake(Config(), "the port", 0))


def running() -> Session:
    session = opened()
    session.handshake.hear(HELLO)
    assert session.handshake.hear(replace(HELLO, command_timeout=120, latch=2)) and session.runs
    session.begin(Exchange(BAUD), 0)
    session.latest = TELEMETRY
    return session


def frames(data: bytes) -> list[Frame]:
    """Behind a zero, which the first bytes of a session bring along."""
    return [event.frame for event in Decoder().receive(b"\0" + data) if isinstance(event, Arrival)]


def test_the_first_byte_ends_what_the_board_may_have_heard_before() -> None:
    session = opened()
    first = session.due(0, False, 0)
    assert first[:1] == b"\0" and frames(first) == [Identify()]
    assert session.due(1, False, 0) == b""
    session.handshake.hear(HELLO)
    later = session.due(2, False, 0)
    assert later[:1] != b"\0" and frames(later) == [Configure(10_000, 120, 0)]


def test_a_board_that_is_off_hears_no_commands() -> None:
    assert [type(frame) for frame in frames(running().due(0, False, 100))] == [Ping]


def test_commands_follow_the_switch_at_once_and_are_repeated() -> None:
    session = running()
    assert frames(session.due(0, True, 100)) == [Enable(1, 7, 2), Ping(1), Command(100)]
    session.switch.hear(enabled())
    assert session.due(1, True, 100) == b""
    assert frames(session.due(2, True, 101)) == [Command(101)]
    assert session.due(REPEAT + 1, True, 101) == b"" and frames(session.due(REPEAT + 2, True, 101)) == [Command(101)]


def test_a_reset_board_is_asked_who_it_is() -> None:
    session = running()
    session.due(0, True, 100)
    session.end()
    assert not session.runs and session.exchange is None
    assert frames(session.due(1, True, 100)) == [Identify()]
