"""Garbled rows and the order of rows; what they do to an import: test_odd_logs.py."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.csv.mending import mend_table, take_off_units
from motor_identification.logs.csv.table import Table


def made(**columns: list[str]) -> Table:
    rows = len(next(iter(columns.values())))
    return Table(Path("log.csv"), np.arange(2, rows + 2), {name: np.array(one) for name, one in columns.items()})


def test_one_row_of_a_hundred_may_be_garbled_and_two_may_not() -> None:
    good = [str(k) for k in range(200)]
    for bad, left in ((2, 198), (3, 200)):
        cells = [*good]
        cells[10 : 10 + bad] = ["", "x", "nan"][:bad]
        mended = mend_table(made(t=good, u=cells))
        assert len(mended) == left
        assert len(mended.notes) == (left < 200)


def test_a_column_without_a_name_of_its_own_is_named_once() -> None:
    good = [str(k) for k in range(200)]
    for name, said in (("column 2", "line 12, column 2: 'x'"), ("u", "line 12, column u: 'x'")):
        (note,) = mend_table(made(t=good, **{name: [*good[:10], "x", *good[11:]]})).notes
        assert note == f"Left out: 1 row with a cell that is no number ({said})."


def test_columns_of_words_and_of_other_things_cost_no_row() -> None:
    good = [str(k) for k in range(200)]
    mended = mend_table(made(t=good, mode=["run"] * 199 + [""], error=["0"] * 199 + ["x"], text=["a"] * 200))
    assert len(mended) == 200 and not mended.notes


def test_rows_are_turned_round_where_all_of_them_come_backwards() -> None:
    back = [str(k) for k in range(99, -1, -1)]
    assert mend_table(made(t=back, u=back)).numbers("t").tolist() == list(range(100))
    clock = [f"12:00:{k:02d}" for k in range(59, -1, -1)]
    assert mend_table(made(time=clock, u=back[:60])).text("time", 0) == "12:00:00"
    restarts = [str(k % 10) for k in range(100)]
    assert not mend_table(made(t=restarts, u=back)).notes


def test_units_are_taken_off_cells_that_all_have_the_same() -> None:
    table = take_off_units(
        made(t=["0 ms", "10 ms", "20.5 ms"], u=["1V", "-2.5V", "x"], y=["1 ms", "2 s", "3 ms"], z=["1", "2 V", "3"])
    )
    assert table.names == ["t [ms]", "u", "y", "z"] and table.numbers("t [ms]").tolist() == [0.0, 10.0, 20.5]
    assert take_off_units(made(mode=["run 1", "run 2"], w=["3 furlongs", "4 furlongs"])).names == ["mode", "w"]
    many = take_off_units(made(t=[f"{k} sec" for k in range(300)] + ["end"]))
    assert many.names == ["t [s]"] and many.text("t [s]", 299) == "299" and many.text("t [s]", 300) == ""


@pytest.mark.parametrize(
    ("cell", "lost"), [("1901", True), ("1901.0", True), ("1901.00", False), ("1901,0", False), ("1.901e3", False)]
)
def test_a_number_that_is_written_with_a_point_has_lost_none(cell: str, lost: bool) -> None:
    """12.00 V for one row, between 1.20 and 1.21 V, is the kick that starts a motor."""
    values = [f"{190.0 + k % 3 / 10:g}" for k in range(200)]
    values[10] = cell
    table = made(t=[str(k) for k in range(200)], pwm=values)
    table = replace(table, decimal_comma=True) if "," in cell else table
    mended = mend_table(table)
    assert (mended.notes != table.notes) is lost
    assert mended.numbers("pwm")[10] == (pytest.approx(190.1) if lost else 1901.0)


def test_a_point_that_a_drive_or_a_speed_lost_is_put_back_and_told() -> None:
    times = [str(k) for k in range(200)]
    values = [f"{190.0 + k % 3 / 10:g}" for k in range(200)]
    broken = [*values[:10], "1901", *values[11:]]
    for name, mends in (("pwm", True), ("speed [rpm]", True), ("angle [deg]", False), ("error", False)):
        mended = mend_table(made(t=times, **{name: broken}))
        assert mended.numbers(name)[10] == (pytest.approx(190.1) if mends else 1901.0)
        about = "Line 12, column {}: 1901 between 190 and 190.2 lost its point, and is taken for 190.1 (assumed)."
        assert mended.notes == ((about.format(name),) if mends else ())
    assert not mend_table(made(t=times, pwm=values)).notes
