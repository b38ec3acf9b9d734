"""Boards and pins by name."""

import pytest

from motor_driver.check.pins import name_board, name_pins
from motor_driver.check.record import Record
from motor_driver.frames.codes import Board


@pytest.mark.parametrize(("board", "name"), [(1, "an ATmega328P"), (2, "an ATmega2560"), (9, "a board of kind 9")])
def test_a_board_by_its_name(board: int, name: str) -> None:
    assert name_board(board) == name


def test_a_mega_has_some_pins_elsewhere_each_renamed_once() -> None:
    text = "Exchange the wires on D7 and D8; D3, D5 and D6 to the bridge, A0 and D80 as they are."
    assert name_pins(text, Board.ATMEGA328P) == text
    wanted = "Exchange the wires on D19 and D48; D3, D7 and D6 to the bridge, A0 and D80 as they are."
    assert name_pins(text, Board.ATMEGA2560) == wanted


def test_a_finding_names_the_boards_own_pins() -> None:
    for board, pins in ((Board.ATMEGA328P, "D7 and D8"), (Board.ATMEGA2560, "D19 and D48")):
        record = Record(board)
        record.find("forward", "channels_swapped")
        assert (
            f"Exchange the wires on {pins}"
            in record.rows[0].text
            == f"{record.findings[0].sentence} {record.findings[0].cure}"
        )
