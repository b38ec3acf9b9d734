"""What may be old, because the process stood still."""

from collections.abc import Callable

import pytest

from motor_ros.clocks import hold_ups
from motor_ros.clocks.hold_ups import HELD_UP, HoldUps


@pytest.mark.parametrize(("stood", "doubt"), [(0.9 * HELD_UP, False), (1.1 * HELD_UP, True)])
@pytest.mark.parametrize("looked", [False, True])
@pytest.mark.parametrize("looks", [0, 20])
def test_what_comes_after_a_node_stood_still_is_in_doubt(
    monkeypatch: pytest.MonkeyPatch, stood: float, doubt: bool, looked: bool, looks: int
) -> None:
    """The message may be there before the timer's turn comes, or after it; a node may stand from its first instant."""
    timers: list[Callable[[], object]] = []
    monkeypatch.setattr(hold_ups, "steady_timer", lambda node, period, callback: timers.append(callback))
    now = [50.0]
    node = HoldUps(None, lambda: now[0])  # type: ignore[arg-type]
    for _ in range(looks):
        now[0] += 0.1
        timers[0]()
    now[0] += stood
    if looked:
        timers[0]()
    assert node.in_doubt() is doubt
    for _ in range(34):
        now[0] += 0.1
        timers[0]()
    assert node.in_doubt() is doubt
    now[0] += 0.2
    assert not node.in_doubt()


@pytest.mark.parametrize(("waited", "old"), [(0.0, False), (0.9 * HELD_UP, False), (1.1 * HELD_UP, True)])
def test_a_start_that_takes_its_time_makes_no_message_old_that_its_sender_has_just_sent(
    monkeypatch: pytest.MonkeyPatch, waited: float, old: bool
) -> None:
    """On a slow computer the first reference was refused."""
    timers: list[Callable[[], object]] = []
    monkeypatch.setattr(hold_ups, "steady_timer", lambda node, period, callback: timers.append(callback))
    now = [50.0]
    node = HoldUps(None, lambda: now[0])  # type: ignore[arg-type]
    now[0] += 5.0
    assert node.bars(round(waited * 1e9)) is old
    now[0] += 0.1
    assert node.bars(round(waited * 1e9)) is old
    now[0] += 1.1 * HELD_UP  # it stands still later on: other computers' clocks are not gone by
    assert node.bars(round(waited * 1e9))
