"""A position that was not read is no 0: rows of it are left out."""

import numpy as np
import pytest
from position_rows import form, rows

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.rows.drive.unread_values import FAR, FEWEST_STEPS, MOST_ROWS, drop_unread_values
from motor_identification.logs.signals import Floats

SAID = "whose y is 0 between two that go on from each other: it was not read (assumed)."


def there_and_back(start: float = 1000.0, count: int = 200) -> Floats:
    """An angle far from 0 that goes on by 10 in every row, to and fro."""
    half = count // 2
    return start + 10.0 * np.append(np.arange(half), np.arange(count - half)[::-1])


@pytest.mark.parametrize(("number", "left_out"), [(1, 1), (MOST_ROWS, MOST_ROWS), (MOST_ROWS + 1, 0)])
def test_a_few_rows_at_0_are_no_readings(number: int, left_out: int) -> None:
    angle = there_and_back()
    angle[50 : 50 + number] = 0.0
    found, said = drop_unread_values(rows(angle), form("deg"))
    assert len(found) == 200 - left_out
    assert said == ([f"Left out: {'1 row' if number == 1 else f'{number} rows'}, {SAID}"] if left_out else [])


@pytest.mark.parametrize(("distance", "left_out"), [(FAR + 1.0, 1), (FAR - 0.5, 0)])
def test_a_motor_may_pass_0(distance: float, left_out: int) -> None:
    """It goes to and fro by 10 a row, and is so many of them from 0 before and behind."""
    angle = there_and_back(0.0)
    angle += 10.0 * distance - angle[49]
    angle[50] = 0.0
    assert len(drop_unread_values(rows(angle), form("deg"))[0]) == 200 - left_out


def test_what_does_not_go_on_and_what_begins_again_is_kept() -> None:
    jump = there_and_back()
    jump[50] = 0.0
    jump[51:] += 500.0  # of a counter that was set to something else
    turn = np.full(200, 359.0)
    turn[::2] = 351.0
    turn[50] = 0.0  # an angle that goes to and fro about a full turn
    few = there_and_back(count=FEWEST_STEPS)
    few[20] = 0.0
    for angle in (jump, turn, few):
        assert drop_unread_values(rows(angle), form("deg"))[1] == []
    speed = there_and_back()
    speed[50] = 0.0
    assert drop_unread_values(rows(speed), CsvForm("t", "u", "w", Kind.SPEED, "rad/s"))[1] == []
