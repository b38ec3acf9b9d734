"""What is due on an opened port."""

from dataclasses import replace

import pytest
from board_frames import HELLO, TELEMETRY, enabled

from motor_driver.config import Config
from motor_driver.exchange import Exchange
from motor_driver.frames.codes import BAUD
from motor_driver.frames.from_host import Command, Configure, Enable, Identify, Ping
from motor_driver.frames.table import Frame
from motor_driver.handshake import Handshake
from motor_driver.protocol import Arrival, Decoder
from motor_driver.session import NUMBERS, REPEAT, Session


def opened() -> Session:
    return Session("the port", Handshake(Config(), "the port", 0))


def running() -> Session:
    session = opened()
    session.handshake.hear(HELLO)
    assert isinstance(session.handshake.asks(0), Configure)
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


@pytest.mark.parametrize("sent", [40, 3 * NUMBERS + 40])  # numbers wrap
def test_a_board_that_obeys_what_was_not_sent_or_an_old_command_again_is_noticed(sent: int) -> None:
    session = running()
    session.due(0, True, 100)
    session.switch.hear(enabled())
    session.encoder._next, session.count = (session.encoder.seq + sent) % NUMBERS, session.count + sent
    newest = session.encoder.seq - 1

    def obeys(*numbers: int) -> list[bool]:
        session.obeyed = None
        return [session.hear_another(replace(enabled(), command=number % NUMBERS)) for number in numbers]

    assert obeys(newest - 2, newest - 2, newest - 1, newest) == [False] * 4
    assert obeys(newest - 1, newest - 2) == [False, True] and obeys(newest, newest + 1) == [False, True]
    assert obeys(newest, newest - 20, newest) == [False, True, False]


def test_what_a_board_had_heard_of_a_driver_before_is_nothing_to_stop_for() -> None:
    session = running()
    session.due(0, True, 100)
    assert not any(session.hear_another(replace(enabled(), command=command)) for command in (5000, 5000, 2, 2))
    off = replace(enabled(), flags=0, command=5000)
    assert not session.hear_another(off) and not session.hear_another(replace(enabled(), command=1))


@pytest.mark.parametrize(("period", "stopped"), [(5, 50), (1, 50), (20, 60), (100, 200)])
def test_a_board_that_obeys_another_alone_from_the_enable_on_is_noticed(period: int, stopped: int) -> None:
    """Somebody else's numbers are ahead of ours, and the board takes ours for old ones; times in ms."""
    session = running()
    session.due(0, True, 100)
    noticed = []
    for at in range(0, 400, period):
        session.heard = at * 1_000_000
        if session.hear_another(replace(enabled(), command=500 + at)):
            noticed.append(at)
    assert noticed[0] == stopped
    session.heard += 1_000_000
    assert not session.hear_another(replace(enabled(), command=2))  # ours again
    assert session.hear_another(replace(enabled(), command=900))


def test_what_a_driver_was_held_up_with_is_no_other_s_command() -> None:
    session = running()
    session.due(0, True, 100)
    assert not session.hear_another(replace(enabled(), command=500))
    session.heard = 300_000_000
    assert [session.hear_another(replace(enabled(), command=command)) for command in (500, 1, 2)] == [False] * 3
