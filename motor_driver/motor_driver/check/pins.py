"""Name a board and its pins: the findings name an Uno's, and other boards have some of them elsewhere."""

import re
from collections.abc import Mapping

from motor_driver.frames.codes import Board

NAMES = {Board.ATMEGA328P: "an ATmega328P", Board.ATMEGA2560: "an ATmega2560"}
ELSEWHERE: Mapping[int, Mapping[str, str]] = {Board.ATMEGA2560: {"D5": "D7", "D7": "D19", "D8": "D48"}}


def name_board(board: int) -> str:
    """Name the chip of a board, as its hello has it."""
    return next((name for kind, name in NAMES.items() if kind == board), f"a board of kind {board}")


def name_pins(text: str, board: int) -> str:
    """Name this board's pins in place of an Uno's."""
    pins = ELSEWHERE.get(board, {})
    return re.sub(r"\bD\d+\b", lambda found: pins.get(found.group(), found.group()), text)
