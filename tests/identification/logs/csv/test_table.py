"""Columns as numbers and times, with the line of every complaint."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError


def table(*cells: object, comma: bool = False) -> Table:
    array = np.array([str(cell).encode() for cell in cells])
    return Table(Path("log.csv"), tuple(range(2, 2 + len(cells))), {"t": array}, decimal_comma=comma)


def test_times_are_exact_in_every_unit() -> None:
    assert table("1760000000.123456789", "-0.000000001").nanoseconds("t").tolist() == [1_760_000_000_123_456_789, -1]
    assert table("1760000000123", "5").nanoseconds("t", 10**6).tolist() == [1_760_000_000_123_000_000, 5_000_000]
    assert table("0,5", "1,25", comma=True).nanoseconds("t").tolist() == [500_000_000, 1_250_000_000]
    assert table("0.1", "0.3").nanoseconds("t").tolist() == [100_000_000, 300_000_000]


def test_times_of_day() -> None:
    assert table("12:00:00", "12:00:00.5").nanoseconds("t").tolist() == [43_200 * 10**9, 43_200_500_000_000]
    dated = table("1970-01-02 00:00:01.25", "1970-01-02T00:00:02Z").nanoseconds("t")
    assert dated.tolist() == [86_401_250_000_000, 86_402_000_000_000]
    with pytest.raises(RecordingError, match="line 3, column t: '25:00:00' is not a number"):
        table("12:00:00", "25:00:00").nanoseconds("t")


@pytest.mark.parametrize("cell", ["9223372036.9", "nan", "inf", "1e99", "", "x", "0x10"])
def test_what_is_no_time(cell: str) -> None:
    with pytest.raises(RecordingError, match="log.csv, line 3, column t: "):
        table("0", cell).nanoseconds("t")
    assert table("0", "9223372036.854775807").nanoseconds("t")[1] == 2**63 - 1


def test_numbers_and_what_is_none() -> None:
    assert table("1", "-2.5e3").numbers("t").tolist() == [1.0, -2500.0]
    assert table("1,5", "2", comma=True).numbers("t").tolist() == [1.5, 2.0]
    assert table("1", "2").text("t", 1) == "2" and len(table("1", "2")) == 2
    for cell, what in (("x", "'x' is not a number"), ("", "the cell is empty"), ("inf", "'inf' is not a number")):
        with pytest.raises(RecordingError, match=f"line 3, column t: {what}"):
            table("0", cell).numbers("t")
    with pytest.raises(RecordingError, match="has no column y: name one of t"):
        table("0").numbers("y")


def test_a_column_is_converted_once_and_cannot_be_written_to() -> None:
    made = table("1", "2", "3")
    first = made.numbers("t")
    assert made.numbers("t") is first
    with pytest.raises(ValueError, match="read-only"):
        first[0] = 5.0
    fewer = made.rows(np.array([True, False, True]), "a note")
    assert fewer.numbers("t").tolist() == [1.0, 3.0]
    floats = np.array([0.5, 0.25])
    assert Table(Path("log.csv"), (2, 3), {"t": floats}).numbers("t").tolist() == [0.5, 0.25]
    floats[0] = 1.0  # whose array it is may still write to it
