"""An angle that was not read while the motor started is caught up at once: what stands before is left out."""

import numpy as np
import pytest
from driven_rows import logged

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.rows.drive.unread_start import FEWEST_DRIVEN, drop_unread_start
from motor_identification.logs.signals import Floats

ANGLE = CsvForm("t", "u", "alpha", Kind.POSITION, "deg")


def frozen(rows: int, sign: float = 1.0) -> tuple[Floats, Floats]:
    """A motor of 50 ms that is driven from the first row on, and its angle, which is 0 up to a row."""
    volts = np.full(120, 0.8 * sign)
    volts[60:80] *= -1.0
    angle, speed = np.zeros(120), 0.0
    for row in range(1, 120):
        speed += 0.2 * (100.0 * volts[row - 1] - speed)
        angle[row] = angle[row - 1] + speed
    angle[:rows] = 0.0
    return volts, angle


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_rows_before_the_angle_was_read_are_left_out(sign: float) -> None:
    volts, angle = frozen(10, sign)
    found, said = drop_unread_start(logged(volts, angle), ANGLE)
    assert len(found) == 110 and found.motion[0] == angle[10]
    assert "Left out: the first 10 rows, in which alpha stands, behind which it goes" in said[0]


def test_a_start_of_its_own_is_kept() -> None:
    volts, angle = frozen(1)
    assert drop_unread_start(logged(volts, angle), ANGLE)[1] == []
    volts, angle = frozen(4)
    assert drop_unread_start(logged(volts, angle), ANGLE)[1] == [], "no further than it goes later on"
    volts, angle = frozen(10)
    assert drop_unread_start(logged(volts, angle), CsvForm("t", "u", "w", Kind.SPEED, "rad/s"))[1] == []
    angle[10:] += 5000.0  # further than the motor can have gone: something else jumps
    assert drop_unread_start(logged(volts, angle), ANGLE)[1] == []
    volts, angle = frozen(10)
    volts[: 10 - FEWEST_DRIVEN + 1] = 0.0
    assert drop_unread_start(logged(volts, angle), ANGLE)[1] == [], "hardly driven before"
    assert drop_unread_start(logged(np.zeros(80), np.zeros(80)), ANGLE)[1] == [], "one that never moves"
