"""The position among two columns."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.behaviour.position import find_position
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


@pytest.mark.parametrize(("units", "told"), [(1.0, True), (1.04, True), (1.1, False), (np.pi / 180.0, False)])
def test_a_position_of_a_steady_motor_by_its_speed_in_the_same_units(units: float, told: bool) -> None:
    """One that has its speed at once, but for the encoder's noise: all its ways are alike."""
    speed = 140.0 + 3.0 * np.random.default_rng(4).normal(size=300)
    columns = {"t": TIME, "a": np.round(speed), "b": np.floor(140.0 * units * TIME), "u": np.full(300, 20.0)}
    table = Table(Path("log.csv"), np.arange(300), columns)
    assert find_position(table, ["a", "b"], "t") == ("b" if told else "")
    assert find_position(table, ["b", "u"], "t") == ""
