"""A turn by hand: alive or not, which way, and whether so many edges a turn can be true."""

import pytest

from motor_driver.check.hand import Turned, judge_counts
from motor_driver.check.look import Answer


def test_what_is_alive_counts_on_and_what_goes_to_and_fro_has_no_b() -> None:
    assert Turned(Answer.DONE, 96, 96, 90).alive and Turned(Answer.DONE, 6, 6, 6).alive
    assert not Turned(Answer.DONE, 3, 3, 3).alive  # a push
    assert Turned(Answer.DONE, 0, 2, 50).to_and_fro and not Turned(Answer.DONE, 3, 3, 50).to_and_fro


def test_the_way_is_known_only_of_a_turn_that_was_said_to_be_done() -> None:
    assert (Turned(Answer.DONE, -90, 91, 80).way, Turned(Answer.DONE, 90, 90, 80).way) == (-1, 1)
    assert Turned(None, -90, 91, 80).way == Turned(Answer.NO, 90, 91, 80).way == 0


@pytest.mark.parametrize(("counted", "turns", "fits"), [(109, 1, True), (112, 1, False), (82, 1, True), (81, 1, False)])
def test_a_hand_is_off_by_fifteen_per_cent_of_a_turn(counted: int, turns: int, fits: bool) -> None:
    assert (judge_counts(Turned(Answer.DONE, counted, counted, 50), turns, 96) is None) == fits


def test_a_gear_multiplies_what_is_expected() -> None:
    assert judge_counts(Turned(Answer.DONE, 380, 380, 300), 1, 11, 34.014) is None
    wrong = judge_counts(Turned(Answer.DONE, 374, 374, 300), 1, 11, 50.0)
    assert wrong is not None and wrong.sentence == "One turn by hand gave 374 edges, where 550 are expected."
    assert "With 11 edges in a turn of the encoder's shaft that is a gear of about 34 to 1" in wrong.cure


def test_ten_turns_tell_more() -> None:
    assert judge_counts(Turned(Answer.DONE, 970, 970, 900), 10, 96) is None
    wrong = judge_counts(Turned(Answer.DONE, 1000, 1000, 900), 10, 96)
    assert wrong is not None and wrong.sentence.startswith("10 turns by hand gave 1000 edges, where 960 are expected")


@pytest.mark.parametrize(
    ("counted", "told", "said"),
    [
        (48, 96, "near 48: only edges of one polarity"),
        (24, 96, "near 24: only edges of one polarity"),
        (374, 11, "a gear of about 34 to 1: say --gear-ratio"),
        (70, 96, "near 70, and exactly, as the disc has it"),
    ],
)
def test_a_wrong_number_comes_with_what_it_may_mean(counted: int, told: int, said: str) -> None:
    wrong = judge_counts(Turned(Answer.DONE, -counted, counted, 50), 1, told)
    assert wrong is not None and wrong.code == "wrong_counts" and said in wrong.cure


def test_where_nobody_has_said_a_number_the_count_is_shown() -> None:
    unknown = judge_counts(Turned(Answer.DONE, 95, 95, 50), 1, None)
    assert unknown is not None and unknown.code == "unknown_counts" and "gave 95 edges" in unknown.sentence
