"""A duty is obeyed under the number that it was sent with."""

from dataclasses import replace

import pytest
from board_frames import enabled

from motor_driver.frames.from_host import Command, Enable, Identify, Ping
from motor_driver.output.commands import KEPT, Commands


def sent(*frames: Command | Enable | Ping | Identify, first: int = 65_533) -> Commands:
    """Their numbers wrap."""
    commands = Commands()
    for k, frame in enumerate(frames):
        commands.send(frame, (first + k) % 65_536)
    return commands


@pytest.mark.parametrize(
    ("number", "duty", "disagrees"),
    [
        (65_533, 0, False),  # the enable
        (65_533, 20, True),
        (65_534, 20, False),
        (65_534, 21, True),
        (65_534, -20, True),
        (65_534, 0, False),  # not latched yet
        (65_535, 20, True),  # a ping, which no board obeys
        (65_535, 0, False),
        (0, -40, False),
        (0, 20, False),  # the one before is latched yet
        (0, 40, True),
        (5000, 256, False),  # not known
    ],
)
def test_what_is_obeyed_under_a_number_of_ours_was_sent_with_it(number: int, duty: int, disagrees: bool) -> None:
    commands = sent(Enable(1, 7, 2), Command(20), Ping(1), Command(-40))
    assert commands.disagree(replace(enabled(), command=number, duty=duty)) is disagrees


def test_what_was_commanded_before_an_enable_is_none_of_its_duties() -> None:
    commands = sent(Command(100), Enable(1, 7, 2), Command(20), first=0)
    assert commands.disagree(replace(enabled(), command=1, duty=100))
    assert commands.disagree(replace(enabled(), command=2, duty=100))


def test_old_numbers_are_not_judged() -> None:
    commands = sent(Command(20), *[Ping(k) for k in range(KEPT)], first=0)
    assert not commands.disagree(replace(enabled(), command=0, duty=100))
    assert commands.disagree(replace(enabled(), command=1, duty=100))
