"""Which of several ports: all are asked, one runs; none and several are a sentence."""

import pytest

from motor_driver.ports.port_error import PortError
from motor_driver.ports.search import BUSY_ROUNDS, Search

PORTS = ["a", "b", "c"]


def asked(search: Search, matches: str, found: list[str] = PORTS) -> list[str]:
    """The ports of a round; those in `matches` have the number."""
    ports = []
    while len(ports) < len(found):
        port, roll_call = search.next(found)
        assert roll_call and port
        search.hear(port, port in matches)
        ports.append(port)
    return ports


def test_all_ports_are_asked_before_the_one_runs() -> None:
    search = Search()
    assert asked(search, "b") == PORTS
    assert search.next(PORTS) == ("b", False)


def test_none_is_a_sentence_and_so_are_two_and_the_next_round_may_find_it() -> None:
    search = Search()
    asked(search, "")
    with pytest.raises(PortError, match="^None of a, b, c has the board with that board_id: plug it in"):
        search.next(PORTS)
    asked(search, "ac")
    with pytest.raises(
        PortError, match=r"^Several boards have that board_id \(a, c\): nobody knows which one is meant"
    ):
        search.next(PORTS)
    asked(search, "c")
    assert search.next(PORTS) == ("c", False)


def test_the_only_port_is_opened_at_once() -> None:
    assert Search().next(["a"]) == ("a", False)


def test_a_port_in_use_is_asked_again_for_a_while_then_it_is_somebody_elses() -> None:
    search = Search()
    for port in PORTS:
        assert search.next(PORTS) == (port, True)
        search.is_busy(port) if port == "a" else search.hear(port, port == "b")
    for _ in range(BUSY_ROUNDS):
        assert search.next(PORTS) == ("", False)
        assert search.next(PORTS) == ("a", True)
        search.is_busy("a")
    assert search.next(PORTS) == ("b", False)


def test_a_port_that_somebody_lets_go_is_asked() -> None:
    search = Search()
    for port in PORTS:
        search.next(PORTS)
        search.is_busy(port) if port == "a" else search.hear(port, port == "b")
    search.next(PORTS)
    assert search.next(PORTS) == ("a", True)
    search.hear("a", True)
    with pytest.raises(PortError, match=r"\(b, a\)"):
        search.next(PORTS)


def test_after_a_lost_cable_the_same_port_is_tried_first_and_then_all() -> None:
    search = Search()
    asked(search, "b")
    search.next(PORTS)
    search.is_lost("b")
    assert search.next(PORTS) == ("b", False)
    assert asked(search, "a") == PORTS  # another board is there now
    assert search.next(PORTS) == ("a", False)


def test_a_board_that_was_unplugged_meanwhile_is_not_opened() -> None:
    search = Search()
    asked(search, "c")
    with pytest.raises(PortError, match="^None of a, b has"):
        search.next(["a", "b"])
