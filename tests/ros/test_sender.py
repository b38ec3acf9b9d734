"""Senders of one topic are told apart by name, number and pace."""

import pytest

from motor_ros.sender import Sender

MS = 1_000_000  # [ns]


def steady(number: int, at: int, period: int = 5) -> Sender:
    """A sender that has sent every `period` ms."""
    return Sender("a", number - 1, (at - period) * MS).after(number, at * MS)


@pytest.mark.parametrize(
    ("name", "number", "after", "ours"),
    [
        ("a", 101, 5, True),
        ("a", 101, 0, True),  # late and at once
        ("b", 101, 5, False),
        ("a", 100, 5, False),
        ("a", 1, 5, False),
        ("a", 110, 50, True),  # nine were missed
        ("a", 110, 25, True),
        ("a", 110, 24, False),  # that many do not come so quickly
        ("a", None, 5, True),
    ],
)
def test_what_is_the_next_message_of_a_sender(name: str, number: int | None, after: int, ours: bool) -> None:
    assert steady(100, 1000).sent(name, number, (1000 + after) * MS) == ours


def test_a_sender_that_is_not_counted_is_known_by_its_name() -> None:
    sender = Sender("a", None, 0).after(None, 5 * MS)
    assert sender.sent("a", 7, 10 * MS) and not sender.sent("b", 7, 10 * MS)


def test_the_pace_is_that_of_successive_messages() -> None:
    assert steady(100, 1000).period == 5 * MS
    assert steady(100, 1000).after(104, 1020 * MS).period == 5 * MS
    assert Sender("a", 1, 0).after(2, 100_000).period == MS  # none is quicker


def test_a_sender_that_was_held_up_is_no_second_one() -> None:
    """A loop of 200 Hz that a busy computer holds up for half a second, then as quick as ever, with messages lost."""
    sender, now = steady(100, 1000), 1000 * MS
    for number, wait in [*((100 + k, 60) for k in range(1, 9)), (110, 6), (111, 1), (115, 11), (116, 0), (118, 5)]:
        now += wait * MS
        assert sender.sent("a", number, now), number
        sender = sender.after(number, now)
    assert not sender.sent("a", 140, now + 5 * MS)


@pytest.mark.parametrize(
    ("name", "number", "then", "ours"),
    [
        ("a", 150, 151, True),  # it was the one before
        ("a", 150, 150, False),
        ("a", 150, 101, False),  # behind it
        ("a", 100, 101, False),
        ("a", 7, 101, False),
        ("b", 150, 151, False),
        ("a", 150, None, True),
    ],
)
def test_what_may_have_been_sent_between_two_messages(name: str, number: int, then: int | None, ours: bool) -> None:
    assert steady(100, 1000).sent_between(Sender(name, number, 1001 * MS), then) == ours
