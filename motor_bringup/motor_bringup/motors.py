"""Two motors at work, `left` and `right`, each with its own board, wherever those are plugged in."""

from collections.abc import Mapping

from motor_bringup import motor
from motor_bringup.argument import PLANT, Argument, checked
from motor_bringup.files import named
from motor_bringup.parameter_file import parameters_for
from motor_bringup.program import Session
from motor_model.errors import MotorError

SIDES = ("left", "right")
BOARDS = tuple(
    Argument(side, "", f"the {side} board's number, as flashed, or the file that `check` wrote") for side in SIDES
)
ARGUMENTS = (
    PLANT,
    *BOARDS,
    *(argument for argument in motor.ARGUMENTS if argument.name in ("model", "gains", "record", "control")),
)


def session(told: Mapping[str, str]) -> Session:
    """Return what `motors.launch.py` starts.

    Raises:
        MotorError: a word is none of the choices, a file cannot be read, or the boards cannot be told apart.
    """
    values = checked(ARGUMENTS, told)
    shared = {name: value for name, value in values.items() if name not in SIDES}
    boards = boards_of(values)
    programs = (motor.session({**shared, **boards[side], "namespace": side}).programs for side in SIDES)
    return Session(tuple(program for both in programs for program in both))


def boards_of(values: Mapping[str, str]) -> dict[str, dict[str, str]]:
    """Find both boards, as arguments of one motor each.

    Raises:
        MotorError: a file cannot be read, or the boards cannot be told apart.
    """
    boards = {side: _board(side, values[side]) for side in SIDES}
    numbers = [board["board_id"] for board in boards.values()]
    if values["plant"] == "hardware" and not all(numbers):
        missing = SIDES[numbers.index("")]
        raise MotorError(
            f"nobody has said which board is {missing}: flash each with a number of its own (ros2 run motor_board "
            f"flash --board-id 1), and say left:=1 right:=2, or name the files that 'check' wrote."
        )
    if numbers[0] and numbers[0] == numbers[1]:
        raise MotorError(
            f"left and right are both the board {numbers[0]}: flash one of them with another number (ros2 run "
            "motor_board flash --board-id)."
        )
    return boards


def _board(side: str, said: str) -> dict[str, str]:
    """The board as arguments of one motor: its number, and the file if it was one that was named."""
    if not said or said.isdecimal():
        return {"board_id": said}
    file = named(said, f"number or parameter file of the {side} board")
    return {"board_id": str(parameters_for(f"/{side}/motor_driver", file).get("board_id", "")), "parameters": file}
