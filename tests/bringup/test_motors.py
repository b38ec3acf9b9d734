"""Two motors in one line: each board is known by its number, or by the file that `check` wrote."""

from pathlib import Path

import pytest

from motor_bringup import motors
from motor_bringup.program import Program
from motor_model.errors import MotorError


def by_side(told: dict[str, str]) -> dict[tuple[str, str], Program]:
    return {(program.namespace, program.executable): program for program in motors.session(told).programs}


def test_each_driver_has_its_number_and_each_emulated_board_is_flashed_with_it() -> None:
    programs = by_side({"plant": "emulated", "left": "7", "right": "9"})
    for side, number in (("left", "7"), ("right", "9")):
        driver, board = programs[side, "motor_driver"].parameters, programs[side, "board_emulator"].parameters
        assert (driver["board_id"], driver["name"]) == (number, side)
        assert board["board_id"] == int(number) and driver["port"] == board["link"] == f"/tmp/motor_board_{side}"
    assert {executable for _, executable in programs} == {"motor_driver", "board_emulator", "motor_control"}
    real = by_side({"plant": "hardware", "left": "7", "right": "9"})["left", "motor_driver"].parameters
    assert real["board_id"] == "7" and real["port"] == ""


def test_a_file_that_check_wrote_says_number_and_wiring(tmp_path: Path) -> None:
    for side, number in (("left", 7), ("right", 9)):
        values = f'{{board_id: "{number}", reverse_motor: {str(side == "left").lower()}}}'
        text = f"/**/motor_driver:\n  ros__parameters: {values}\n"
        (tmp_path / f"{side}.yaml").write_text(text, encoding="utf-8")
    files = {side: str(tmp_path / f"{side}.yaml") for side in ("left", "right")}
    programs = by_side({"plant": "hardware", **files, "control": "false"})
    drivers = [programs[side, "motor_driver"].parameters for side in ("left", "right")]
    assert [driver["board_id"] for driver in drivers] == ["7", "9"]
    assert [driver["reverse_motor"] for driver in drivers] == [True, False]
    assert [driver["name"] for driver in drivers] == ["left", "right"]


@pytest.mark.parametrize(
    ("told", "says"),
    [
        ({"plant": "hardware"}, "nobody has said which board is left: flash each with a number of its own"),
        ({"plant": "hardware", "left": "7"}, "nobody has said which board is right"),
        ({"plant": "hardware", "left": "7", "right": "7"}, "left and right are both the board 7: flash one"),
        ({"plant": "emulated", "left": "7", "right": "7"}, "left and right are both the board 7"),
        ({"left": "none.yaml"}, "there is no number or parameter file of the left board .*none.yaml"),
    ],
)
def test_boards_that_cannot_be_told_apart_are_one_sentence(told: dict[str, str], says: str) -> None:
    with pytest.raises(MotorError, match=says):
        motors.session(told)


def test_simulated_motors_need_no_boards() -> None:
    assert {namespace for namespace, _ in by_side({})} == {"left", "right"}
