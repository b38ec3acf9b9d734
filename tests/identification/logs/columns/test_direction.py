"""Which of a direction's values is backward; what it does to an import: test_odd_logs.py."""

from pathlib import Path

import numpy as np

from motor_identification.logs.columns.direction import find_direction_column, read_direction
from motor_identification.logs.csv.table import Table

DRIVE = np.array([0.0, 5.0, 5.0, 7.0])
SPEED = np.array([0.0, 3.0, -3.0, -4.0])


def made(way: list[str], **others: list[str]) -> Table:
    cells = {"pwm": np.array(["0", "5", "5", "7"]), "dir": np.array(way)}
    return Table(Path("log.csv"), np.arange(2, 6), {**cells, **{name: np.array(one) for name, one in others.items()}})


def test_the_column_is_found_beside_a_drive_without_a_sign() -> None:
    way = ["1", "1", "0", "0"]
    assert find_direction_column(made(way), "pwm", "") == "dir"
    assert find_direction_column(made(way, back=["0", "1", "-1", "0"]), "back", "") is None  # it has a sign
    assert find_direction_column(made(["1", "2", "3", "4"]), "pwm", "") is None  # more than two ways
    assert find_direction_column(made(way, dir_right=way), "pwm", "right") == "dir_right"


def test_which_value_is_backward() -> None:
    for way, backward in (
        (["1", "1", "0", "0"], ("0",)),
        (["CW", "CW", "CCW", "CCW"], ("CCW",)),
        (["0", "0", "1", "1"], ("1",)),  # as the motion turns with it
        (["0", "1", "-1", "-1"], ("-1",)),
        (["stop", "fwd", "rev", "rev"], ("rev",)),
    ):
        found = read_direction(made(way), "dir", DRIVE, SPEED)
        assert found is not None and found.backward == backward
    assert read_direction(made(["A", "A", "B", "B"]), "dir", DRIVE, SPEED) is None
    assert read_direction(made(["1", "1", "0", "0"]), "dir", DRIVE, np.abs(SPEED)) is None
