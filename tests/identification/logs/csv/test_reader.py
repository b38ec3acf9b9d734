"""A CSV file as columns: what separates them, what a number is, and the line of every complaint."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.csv.reader import read_table
from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError


def table(path: Path, text: str, *wanted: str) -> Table:
    (path / "log.csv").write_text(text, encoding="utf-8")
    return read_table(path / "log.csv", wanted or ("t", "y"))


@pytest.mark.parametrize(
    "text", ["t,u,y\n0,1,2.5\n1,1,-3\n", "t;u;y\n0;1;2,5\n1;1;-3\n", "\ufefft\tu\ty\r\n\r\n0\t1\t 2.5\r\n1\t1\t-3\r\n"]
)
def test_the_separator_and_the_decimal_sign_are_found(tmp_path: Path, text: str) -> None:
    found = table(tmp_path, text)
    assert len(found) == 2 and found.numbers("t").tolist() == [0.0, 1.0] and found.numbers("y").tolist() == [2.5, -3.0]


def test_seconds_since_1970_keep_their_nanoseconds(tmp_path: Path) -> None:
    found = table(tmp_path, "t,y\n1760000000.123456789,1\n-0.000000001,2\n")
    assert found.nanoseconds("t").tolist() == [1_760_000_000_123_456_789, -1]
    assert found.nanoseconds("t").dtype == np.int64


@pytest.mark.parametrize("cell", ["", "fast", "nan", "inf"])
def test_a_cell_that_is_no_number_is_named_with_its_line(tmp_path: Path, cell: str) -> None:
    found = table(tmp_path, f"t,y\n0,1\n\n1,{cell}\n")
    with pytest.raises(RecordingError, match=r"log\.csv, line 4, column y: "):
        found.numbers("y")


def test_a_time_beyond_292_years_is_none(tmp_path: Path) -> None:
    assert table(tmp_path, "t,y\n0,1\n9223372036.854775807,1\n").nanoseconds("t")[1] == 2**63 - 1
    with pytest.raises(RecordingError, match="line 3, column t: '9223372036.9' is not a number"):
        table(tmp_path, "t,y\n0,1\n9223372036.9,1\n").nanoseconds("t")


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "is empty: it needs a line of column names"),
        ("t,y\n0,1\n", "has 1 row below its column names: at least 2 samples"),
        ("t,z\n0,1\n1,1\n", "has no column y: name one of t, z"),
        ("t,y,y\n0,1,1\n1,1,1\n", "has 2 columns named y: rename all but one"),
    ],
)
def test_a_table_that_does_not_do(tmp_path: Path, text: str, complaint: str) -> None:
    with pytest.raises(RecordingError, match=complaint):
        table(tmp_path, text)


@pytest.mark.parametrize(("numbers", "complaint"), [(11, "is one row of 11 numbers"), (10, "has 1 row")])
def test_a_row_of_one_signal(tmp_path: Path, numbers: int, complaint: str) -> None:
    (tmp_path / "log.csv").write_text(",".join(map(str, range(numbers))))
    with pytest.raises(RecordingError, match=complaint):
        read_table(tmp_path / "log.csv")


def test_rows_above_the_rows_are_told(tmp_path: Path) -> None:
    """As where notes stand beside the first rows; a number in a line of settings is no row."""
    rows = [f"{k},{k % 3},7" for k in range(20)]
    for first, said in ((["0,1,7,R,1.6", "1,2,7,L,2"], "2 lines (the first is 2)"), (["0,1"], "line 2")):
        (tmp_path / "log.csv").write_text("\n".join(["t,u,y", *first, *rows]) + "\n")
        table = read_table(tmp_path / "log.csv")
        assert len(table) == 20
        assert table.notes == (f"Left out: {said} above the rows, with other cells than they have.",)
    (tmp_path / "log.csv").write_text("\n".join(["gain,5", "# 1,2", "t,u,y", *rows]) + "\n")
    assert read_table(tmp_path / "log.csv").notes == ()


def test_one_column_alone_is_told(tmp_path: Path) -> None:
    (tmp_path / "log.csv").write_text("\n".join(f"{k * 0.7:.3f}" for k in range(300)))
    with pytest.raises(RecordingError, match="has one column of numbers: give a table that has the voltage"):
        read_table(tmp_path / "log.csv")
    (tmp_path / "log.csv").write_text("\n".join(["words"] * 300))
    with pytest.raises(RecordingError, match="has no rows of numbers in its first lines"):
        read_table(tmp_path / "log.csv")
