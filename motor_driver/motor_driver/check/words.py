"""What a person reads during and after a first run: prompts, one line a step, and the result."""

from motor_driver.check.check import Check
from motor_driver.check.look import Prompt
from motor_driver.check.pins import name_board
from motor_driver.check.record import CURED, OK, UNKNOWN, WRONG, Row
from motor_driver.check.settings import Settings
from motor_driver.frames.from_board import Hello

MARKS = {OK: "ok", WRONG: "WRONG", CURED: "cured", UNKNOWN: "?"}


def plan_of(settings: Settings) -> str:
    """Return what is about to happen, before it does."""
    return (
        f"The motor will turn a little, both ways, at {settings.highest:.3g} V at most, for some seconds in all. "
        "Keep the supply's switch within reach; Ctrl-C gives 0 V."
    )


def prompt_of(prompt: Prompt, settings: Settings) -> str:
    """Return what a person is asked."""
    times = "one turn" if settings.turns == 1 else f"{settings.turns} turns"
    return {
        Prompt.HANDS_OFF: "Keep your hands off the shaft.",
        Prompt.TURN: f"Turn the shaft by hand, {times}, in the direction that is to be forward; then press Enter "
        f"({settings.hand_time:.0f} s). If it cannot be turned: n and Enter.",
        Prompt.TURNS: "Edges come with the motor off. Does the shaft turn now? y or n, and Enter.",
        Prompt.FORWARD: "The shaft has just turned, at a positive voltage. Was that forward? y or n, and Enter.",
    }[prompt]


def board_row(board: Hello, port: str) -> Row:
    """Return which board was found."""
    number = f"board_id {board.board_id}" if board.board_id else "no board_id"
    channels = "one channel" if board.channels == 1 else "two channels"
    return Row("board", OK, f"firmware {board.firmware} on {name_board(board.board)} at {port}, {number}, {channels}")


def line_of(row: Row) -> str:
    """One line."""
    return f"{row.step:10} {MARKS[row.mark]:6} {row.text}"


def verdict_of(check: Check) -> str:
    """Return the last sentence."""
    wrong = [found for found in check.record.findings if not found.cured]
    if wrong:
        return "Not everything is right: no parameter file is written."
    right = "All is right with the parameters that make up for the wiring" if check.record.findings else "All is right"
    unknown = ", ".join(row.step for row in check.record.rows if row.mark == UNKNOWN)
    return f"{right}, as far as it was checked (not: {unknown})." if unknown else f"{right}."
