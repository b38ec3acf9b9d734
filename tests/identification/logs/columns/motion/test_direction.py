"""Which of a direction's values is backward; what it does to an import: test_odd_logs.py."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.motion.direction import find_direction_column, join_two_ways, read_direction
from motor_identification.logs.columns.vocabulary import Quantity
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
        (["N", "F", "R", "R"], ("R",)),
    ):
        found = read_direction(made(way), "dir", DRIVE, SPEED)
        assert found is not None and found.backward == backward
    assert read_direction(made(["A", "A", "B", "B"]), "dir", DRIVE, SPEED) is None
    assert read_direction(made(["1", "1", "0", "0"]), "dir", DRIVE, np.abs(SPEED)) is None


def test_a_value_that_only_stands_where_nothing_drives_is_no_way() -> None:
    """A direction of 1 and 0, where 0 means that the motor is off."""
    found = read_direction(made(["0", "1", "1", "1"]), "dir", DRIVE, np.abs(SPEED))
    assert found is not None and found.backward == () and "where dir is 1" in found.why
    assert read_direction(made(["0", "0", "1", "1"]), "dir", DRIVE, np.abs(SPEED)) is None  # 5 V where it is 0
    off = read_direction(made(["1", "1", "1", "1"]), "dir", 0.0 * DRIVE, SPEED)
    assert off is not None and off.backward == ()


@pytest.mark.parametrize(
    ("way", "speed", "backward"),
    [("F", SPEED, ()), ("R", -np.abs(SPEED), ("R",)), ("R", np.abs(SPEED), ()), ("F", -np.abs(SPEED), ())],
)
def test_a_run_of_one_way_goes_as_the_motion(way: str, speed: NDArray[np.float64], backward: tuple[str, ...]) -> None:
    """A speed without a sign turns with the drive, whichever way that is."""
    found = read_direction(made(["N", way, way, way]), "dir", np.abs(DRIVE), speed)
    assert found is not None and found.backward == backward
    assert read_direction(made(["N", "A", "A", "A"]), "dir", np.abs(DRIVE), speed) is None


@pytest.mark.parametrize(
    ("one", "other", "joined"),
    [
        ("pwm_fwd", "pwm_rev", True),
        ("RPWM", "LPWM", True),
        ("duty forward", "duty reverse", True),
        ("pwm_left", "pwm_right", False),  # two motors
        ("pwm_fwd", "duty_rev", False),
    ],
)
def test_two_drives_that_are_never_on_together_are_one(one: str, other: str, joined: bool) -> None:
    first, second = np.tile([0.0, 5.0, 0.0, 0.0], 30), np.tile([0.0, 0.0, 7.0, 0.0], 30)

    def made_of(a: NDArray[np.float64], b: NDArray[np.float64]) -> Table:
        return Table(Path("log.csv"), np.arange(2, 122), {other: b, one: a, "rpm": first})

    found = join_two_ways(made_of(first, second), None)
    assert (found.names == ["rpm", f"{one} - {other} (duty)"]) is joined
    if joined:
        assert found.numbers(found.names[-1]).tolist() == (first - second).tolist()
        assert read_heading(found.names[-1]).quantity is Quantity.DUTY and len(found.notes) == 1
        for a, b in ((first, -second), (first, np.zeros(120)), (first, first), (first + (np.arange(120) < 30), second)):
            assert join_two_ways(made_of(a, b), None).names == [other, one, "rpm"]
        assert join_two_ways(made_of(first, second), one).names == [other, one, "rpm"]
