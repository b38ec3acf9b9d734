"""What columns and runs are by how their numbers behave."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.behaviour import can_have_stood, find_position
from motor_identification.logs.csv.table import Table

TIME = np.arange(300) * 0.01
SPEED = 20.0 * (1.0 - np.exp(-np.mod(TIME, 1.5) / 0.2)) * np.where(TIME < 1.5, 1.0, -0.6)


def test_a_position_among_a_position_and_its_speed() -> None:
    late = np.cumsum(np.where(np.arange(300) % 9 == 0, 0.04, 0.007))  # rows as a busy computer writes them
    angle = np.floor(np.cumsum(SPEED * np.diff(late, append=late[-1] + 0.01)) * 5.0)
    columns = {"t": late, "a": np.round(SPEED), "b": angle, "u": np.sign(SPEED)}
    table = Table(Path("log.csv"), np.arange(300), columns)
    assert find_position(table, ["a", "b"], "t") == "b" and find_position(table, ["b", "a"], "t") == "b"
    assert find_position(table, ["a", "u"], "t") == ""


@pytest.mark.parametrize(
    ("begin", "voltage", "stood"),
    [
        (0.0, 5.0, True),
        (4.0, 5.0, True),  # within the first row
        (-19.0, 5.0, False),  # it still turned the other way
        (-4.0, 5.0, True),  # noise
        (-9.0, 5.0, False),
        (40.0, 5.0, False),  # it came from a higher voltage
        (0.0, -5.0, True),
    ],
)
def test_a_motor_that_stood(begin: float, voltage: float, stood: bool) -> None:
    way = np.sign(voltage)
    speed = way * 20.0 + (way * begin - way * 20.0) * np.exp(-TIME / 0.2)
    assert can_have_stood(speed, voltage) == stood
    assert can_have_stood(speed[:5], voltage)  # too short to tell


def test_a_run_at_no_voltage() -> None:
    assert can_have_stood(np.zeros(50), 0.0) and not can_have_stood(20.0 * np.exp(-TIME / 0.2), 0.0)
