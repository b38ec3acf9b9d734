"""Pings and pongs: what they say of the board's clock, whatever the line and the host take."""

import pytest

from motor_driver.clock.board_clock import BoardClock
from motor_driver.exchange import MEMORY, PING_EVERY, Exchange
from motor_driver.frames.codes import BAUD
from motor_driver.frames.from_board import Pong
from motor_driver.frames.from_host import Ping

BYTE = 20_000  # [ns] at 500,000 baud, start and stop bit included
TICK = 500  # [ns]


def clock() -> BoardClock:
    made = BoardClock(TICK)
    made.hear(1_000_000, 0)
    return made


def test_it_asks_every_20_ms_with_a_new_token() -> None:
    exchange = Exchange(BAUD)
    asked = [exchange.asks(now) for now in (0, PING_EVERY - 1, PING_EVERY, 2 * PING_EVERY)]
    assert asked == [Ping(1), None, Ping(2), Ping(3)]


def test_the_round_trip_leaves_out_what_the_board_took() -> None:
    exchange, board = Exchange(BAUD), clock()
    ping = exchange.asks(10_000_000)
    assert ping is not None
    exchange.hear_pong(Pong(ping.token, 1_000_100, 1_000_300, 3, 4), board, 12_000_000)
    assert exchange.round_trip == 2_000_000 - 200 * TICK
    assert (exchange.board.bad_frames, exchange.board.dropped_samples) == (3, 4)


def test_an_answer_to_nobodys_question_says_nothing_of_the_clock() -> None:
    exchange = Exchange(BAUD)
    exchange.hear_pong(Pong(99, 1_000_100, 1_000_300, 1, 0), clock(), 12_000_000)
    assert exchange.round_trip is None and exchange.board.bad_frames == 1
    for k in range(MEMORY + 1):
        exchange.asks(k * PING_EVERY)
    exchange.hear_pong(Pong(1, 1_000_100, 1_000_300, 1, 0), clock(), 12_000_000)  # forgotten
    assert exchange.round_trip is None


@pytest.mark.parametrize(("took", "late"), [(99, False), (101, True), (3000, True)])
def test_a_link_that_holds_back_what_goes_over_it_is_late_after_five_answers(took: int, late: bool) -> None:
    """So many ms each answer takes; the last one is older than what is remembered.

    Where three more take too long already, two have to be there.
    """
    exchange, board, told = Exchange(BAUD, longest=0.1), clock(), []
    answers = [(k * PING_EVERY, (k * PING_EVERY + took * 1_000_000)) for k in range(1, 200)]
    asked = 0
    for token, (_, answered) in enumerate(answers, 1):
        while asked < len(answers) and answers[asked][0] <= answered:
            exchange.asks(answers[asked][0])
            asked += 1
        exchange.hear_pong(Pong(token, 1_000_100, 1_000_100, 0, 0), board, answered)
        told.append(exchange.late)
    assert told[: 2 if took == 3000 else 5] == [False] * (1 if took == 3000 else 4) + [late] and told[-1] is late
    exchange.hear_pong(Pong(10_000, 1_000_100, 1_000_100, 0, 0), board, answers[-1][1])  # nobody's
    assert exchange.late is late
    ping = exchange.asks(10**12)
    assert ping is not None
    exchange.hear_pong(Pong(ping.token, 1_000_100, 1_000_100, 0, 0), board, 10**12 + 1_000_000)
    assert not exchange.late  # it has recovered


def exchange_after(asked: int, answers: dict[int, int]) -> Exchange:
    """After so many pings, with the answers to some of them, so late [ms], in the order in which they came."""
    exchange, board = Exchange(BAUD, longest=0.1), clock()
    for k in range(1, asked + 1):
        exchange.asks(k * PING_EVERY)
    for token, took in answers.items():
        exchange.hear_pong(Pong(token, 1_000_100, 1_000_100, 0, 0), board, token * PING_EVERY + took * 1_000_000)
    return exchange


@pytest.mark.parametrize(("missing", "late"), [(2, False), (3, True)])
def test_answers_that_are_overdue_count_beside_two_that_came_late(missing: int, late: bool) -> None:
    exchange = exchange_after(20, {1: 110, 2: 120})
    assert not exchange.late
    exchange.look((2 + missing) * PING_EVERY + 101_000_000)
    assert exchange.late is late


def test_answers_that_a_noisy_line_has_lost_are_not_late() -> None:
    for answers in ({}, {1: 120}, {1: 120, 2: 90}, {1: 120, 2: 120, 20: 5}):  # none, one, one of two, all but one lost
        exchange = exchange_after(20, answers)
        exchange.look(20 * PING_EVERY + 5_000_000)
        assert not exchange.late


@pytest.mark.parametrize(
    ("asked", "answers", "deaf"), [(30, {}, False), (31, {}, True), (51, {20: 5}, True), (50, {20: 5}, False)]
)
def test_a_board_that_answers_nothing_for_half_a_second_is_deaf(
    asked: int, answers: dict[int, int], deaf: bool
) -> None:
    """Beyond the 0.1 s that an answer may take."""
    assert exchange_after(asked, answers).deaf is deaf


def test_what_was_lost_before_two_that_come_late_does_not_count_with_them() -> None:
    exchange = exchange_after(10, {9: 120, 10: 121})
    exchange.look(10 * PING_EVERY + 122_000_000)
    assert not exchange.late


def test_a_sample_without_a_fit_is_as_old_as_its_bytes() -> None:
    exchange = Exchange(BAUD)
    instant = exchange.hear_telemetry(1_500_000_000, 40_000_000)
    telemetry = 8 + 26 + 1  # bytes from the start of the first to the start of the last
    assert instant == 40_000_000 - telemetry * BYTE


def test_equal_delays_both_ways_cancel() -> None:
    """The host's clock is 7 s behind the board's; every frame waits 1 ms in each direction beside the line."""
    exchange, board = Exchange(BAUD), BoardClock(TICK)
    offset, wait = -7_000_000_000, 1_000_000
    stamp, line = 0, 13 * BYTE  # a ping's bytes: 8 + 4, and COBS
    for k in range(1, 200):
        now = 10_000_000_000 + k * PING_EVERY
        ping = exchange.asks(now)
        assert ping is not None
        received = now + line + wait - offset  # on the board
        sent = received + 100_000
        ticks = [(at - 1_000_000_000) // TICK for at in (received, sent)]
        board.hear(ticks[1] % (1 << 32), now)
        heard = sent + offset + (8 + 16 + 1) * BYTE + wait
        exchange.hear_pong(Pong(ping.token, *(tick % (1 << 32) for tick in ticks), 0, 0), board, heard)
        stamp = board.newest
    assert exchange.fit.fit is not None
    assert exchange.fit.fit.host(stamp) - (stamp + offset) == pytest.approx(0, abs=20_000)
