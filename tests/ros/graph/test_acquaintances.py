"""Nobody is obeyed before his node is known, and nobody who plays a recording."""

import pytest

from motor_ros.graph.acquaintances import LISTED, PATIENCE, SETTLED, WATCHED, Acquaintances, Verdict
from motor_ros.graph.publishers import Publisher

USER, PLAYER = Publisher((1,), "/user"), Publisher((2,), "/x")
NAMELESS = Publisher((2,), "")
OBEYED, WAITS, REFUSED = Verdict


def met(*there: Publisher, at: int = 0, players: tuple[str, ...] = ()) -> Acquaintances:
    return Acquaintances().look(there, set(players), at)


def test_a_node_is_obeyed_once_it_has_been_known_for_a_while() -> None:
    user = met(USER)
    assert user.judge(1, SETTLED - 1) is WAITS
    assert user.judge(1, SETTLED) is OBEYED


def test_one_whose_node_is_not_known_lets_everybody_wait_and_at_last_be_refused() -> None:
    """Whose message it is nobody says."""
    two = met(USER).look((USER, NAMELESS), set(), 10 * SETTLED)
    at = 10 * SETTLED
    assert two.judge(at, at + SETTLED) is WAITS
    assert two.judge(at, at + PATIENCE) is WAITS
    assert two.judge(at, at + PATIENCE + 1) is REFUSED
    known = two.look((USER, PLAYER), set(), at + 5)
    assert known.judge(at, at + 5) is WAITS
    assert known.judge(at, at + 5 + SETTLED) is OBEYED


@pytest.mark.parametrize(("later", "verdict"), [(LISTED, WAITS), (LISTED + 1, OBEYED)])
@pytest.mark.parametrize("newcomer", [PLAYER, NAMELESS])
def test_a_message_waits_for_no_newcomer_of_later(newcomer: Publisher, later: int, verdict: Verdict) -> None:
    """Beside ten nodes a second that come and go, nine of ten references were refused after 2 s."""
    at = 10 * SETTLED
    two = met(USER).look((USER,), set(), at + later).look((USER, newcomer), set(), at + later + 1)
    assert two.judge(at, at + later + 1) is verdict
    assert two.judge(at + later, at + later + 1) is WAITS  # what has come since may be the newcomer's


def test_who_is_first_seen_late_may_have_been_there_all_the_time() -> None:
    """A busy program looks again half a second after a message of a player that had just come."""
    at = 10 * SETTLED
    two = met(USER).look((USER,), set(), at - 1).look((USER, PLAYER), set(), at + 5 * LISTED)
    assert two.judge(at, at + 5 * LISTED) is WAITS


@pytest.mark.parametrize(("begun", "verdict"), [(LISTED, WAITS), (LISTED + 1, OBEYED)])
def test_who_was_not_listed_may_have_come_while_the_list_was_made(begun: int, verdict: Verdict) -> None:
    at = 10 * SETTLED
    two = met(USER).look((USER,), set(), at + 3 * LISTED, at + begun).look((USER, PLAYER), set(), at + 3 * LISTED + 1)
    assert two.judge(at, at + 3 * LISTED + 1) is verdict


@pytest.mark.parametrize("later", [LISTED + 1, PATIENCE])
def test_a_request_waits_for_every_newcomer(later: int) -> None:
    """It may come before its sender is listed."""
    at = 10 * SETTLED
    two = Acquaintances(awaited=True).look((USER,), set(), 0).look((USER, PLAYER), set(), at + later)
    assert two.judge(at, at + later) is WAITS


def test_what_somebody_may_have_sent_who_has_gone_unknown_is_refused() -> None:
    gone = met(USER, NAMELESS).look((USER,), set(), 10 * SETTLED)
    assert gone.judge(10 * SETTLED, 10 * SETTLED) is REFUSED
    assert gone.judge(10 * SETTLED + 1, 10 * SETTLED + 1) is OBEYED


def test_who_has_sent_once_and_has_gone_is_obeyed_if_he_was_known() -> None:
    """`ros2 topic pub --once` ends a tenth of a second later."""
    gone = met(USER).look((), set(), SETTLED // 2)
    assert gone.judge(1, SETTLED // 2) is OBEYED


def test_nothing_that_came_while_a_player_was_there_is_obeyed() -> None:
    two = met(USER).look((USER, PLAYER), {"/x"}, 10 * SETTLED)
    assert two.players == "/x"
    assert two.judge(10 * SETTLED, 20 * SETTLED) is REFUSED
    assert two.judge(10 * SETTLED + 1, 10 * SETTLED + 1) is REFUSED  # nor what has come since the latest look
    after = two.look((USER,), set(), 11 * SETTLED)
    assert after.players == "" and after.judge(11 * SETTLED, 11 * SETTLED) is REFUSED
    assert after.judge(11 * SETTLED + 1, 11 * SETTLED + 1) is OBEYED


@pytest.mark.parametrize(("after", "watched"), [(WATCHED, True), (WATCHED + 1, False)])
def test_services_are_looked_at_for_a_while(after: int, watched: bool) -> None:
    assert met(USER, at=5).watches(5 + after) is watched


def test_services_are_looked_at_while_somebody_is_not_known_or_plays() -> None:
    assert met(NAMELESS).watches(10 * WATCHED) and met(PLAYER, players=("/x",)).watches(10 * WATCHED)
    assert not Acquaintances().watches(0)


@pytest.mark.parametrize(("after", "verdict"), [(SETTLED - 1, REFUSED), (SETTLED, OBEYED)])
def test_who_asks_and_ends_before_it_is_known_for_a_while_leaves_a_doubt(after: int, verdict: Verdict) -> None:
    """Beside another client it was obeyed by its name alone, and a player may have any."""
    both = Acquaintances(awaited=True).look((USER,), set(), 0).look((USER, PLAYER), set(), 10 * SETTLED)
    gone = both.look((USER, PLAYER), set(), 10 * SETTLED + after).look((USER,), set(), 11 * SETTLED)
    assert gone.judge(10 * SETTLED, 11 * SETTLED) is verdict
    assert gone.judge(11 * SETTLED + 1, 11 * SETTLED + 1) is OBEYED  # who is still there
