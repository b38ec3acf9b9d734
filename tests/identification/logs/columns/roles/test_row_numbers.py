"""Columns that number the rows."""

from pathlib import Path

import numpy as np

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.roles.row_numbers import (
    FEWEST_ROWS,
    leave_out_numbers,
    tell_duration,
    tell_number,
)
from motor_identification.logs.columns.vocabulary import Quantity
from motor_identification.logs.csv.table import Table
from motor_identification.logs.rows.drive.constant_voltage import CONSTANT

ROWS = np.arange(60.0)
TIMES = 0.01 * ROWS + 0.002 * np.sin(ROWS)
MOVED = np.sin(ROWS)


def _left(timed: bool = False, time: str | None = "t", **columns: np.ndarray) -> list[str]:  # type: ignore[type-arg]
    count = len(columns["t"])
    table = Table(Path("log.csv"), np.arange(count), {**columns, CONSTANT: np.full(count, 6.0)})
    headings = [read_heading(name) for name in table.names if name != "t"]
    return [one.name for one in leave_out_numbers(table, headings, time, timed)]


def test_numbers_are_left_out_beside_a_motion() -> None:
    assert _left(t=TIMES, a=ROWS + 1.0, b=MOVED) == ["b", CONSTANT] == _left(True, t=TIMES, a=ROWS + 1.0, b=MOVED)
    assert _left(time=None, t=TIMES, a=ROWS, b=MOVED) == ["a", "b", CONSTANT]
    assert _left(t=TIMES, a=3.0 + 1.0001 * TIMES, b=MOVED) == ["b", CONSTANT], "another clock"
    few = slice(0, FEWEST_ROWS)
    assert _left(t=TIMES[few], a=ROWS[few], b=MOVED[few]) == ["a", "b", CONSTANT]


def test_the_only_column_beside_times_that_were_said_is_what_they_are_the_times_of() -> None:
    assert _left(t=TIMES, a=ROWS) == [CONSTANT] and _left(True, t=TIMES, a=ROWS) == ["a", CONSTANT]


def test_numbers_by_their_name() -> None:
    table = Table(Path("log.csv"), np.arange(60), {"sample": ROWS, "Sample no": MOVED, "speed": ROWS})
    told = [tell_number(table, read_heading(name)).quantity for name in table.names]
    assert told == [Quantity.OTHER, None, Quantity.SPEED]


def test_how_long_a_row_took_drives_nothing_and_is_no_clock() -> None:
    """Also of a struct, `MotorDC.delay`; what goes on under such a name are times, and `dphi_dt` is a speed."""
    same, late = np.full(60, 16.0), 10.0 + np.sin(ROWS)
    names = {"MotorDC.delay": same, "dt": late, "sample_period": late, "Ts": TIMES, "ts": 1e3 * np.floor(ROWS / 7.0)}
    table = Table(Path("log.csv"), np.arange(60), {**names, "dphi_dt": late, "delay speed": late})
    told = [tell_duration(table, read_heading(name)).quantity for name in table.names]
    assert told[:3] == [Quantity.OTHER] * 3 and Quantity.OTHER not in told[3:]
