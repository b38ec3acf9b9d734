"""Rows that belong together, and the time between them."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.csv_form import CsvForm, Kind
from motor_identification.logs.csv_table import Table
from motor_identification.logs.runs import runs_of, steps_of
from motor_model.errors import RecordingError

FORM = CsvForm("t", "u", "y", Kind.SPEED, "rad/s")


def table(**cells: list[str]) -> Table:
    return Table(Path("log.csv"), tuple(range(2, 2 + len(next(iter(cells.values()))))), cells)


def nanoseconds(*seconds: float) -> "np.ndarray[tuple[int], np.dtype[np.int64]]":
    return np.rint(np.array(seconds) * 1e9).astype(np.int64)


def test_without_a_column_to_split_by_all_rows_are_one_run() -> None:
    assert runs_of(table(t=["0", "1", "2"]), None) == {"": slice(0, 3)}


def test_a_run_is_as_long_as_its_value_and_one_that_comes_again_gets_a_number() -> None:
    rows = table(d=["10 %", "10 %", "-5", "-5", "-5", "10 %", "10 %"])
    assert runs_of(rows, "d") == {"10__": slice(0, 2), "-5": slice(2, 5), "10___2": slice(5, 7)}


def test_a_run_of_a_single_row_is_refused_with_its_line() -> None:
    with pytest.raises(RecordingError, match="log.csv, line 4: the run with d = b has a single row"):
        runs_of(table(d=["a", "a", "b", "c", "c"]), "d")


def test_steps_are_counted_inside_runs_only() -> None:
    rows = table(t=["0", "1", "0", "2"])
    steps = steps_of(rows, FORM, nanoseconds(0.0, 1.0, 0.0, 2.0), [slice(0, 2), slice(2, 4)])
    assert steps.tolist() == [10**9, 2 * 10**9]


@pytest.mark.parametrize(("third", "what"), [(0.01, "stands still"), (0.005, "runs backwards")])
def test_time_that_does_not_go_on_is_refused(third: float, what: str) -> None:
    rows = table(t=["0", "0.01", str(third)])
    with pytest.raises(RecordingError, match=rf"line 4: time {what} \(t is {third} after 0\.01\); it may restart only"):
        steps_of(rows, FORM, nanoseconds(0.0, 0.01, third), [slice(0, 3)])
    with pytest.raises(RecordingError, match="only where d changes"):
        steps_of(rows, replace(FORM, split="d"), nanoseconds(0.0, 0.01, third), [slice(0, 3)])


def test_a_run_may_begin_when_the_rest_ends_but_not_before() -> None:
    rows = table(t=["0.1", "0.2"])
    steps = steps_of(rows, replace(FORM, rest_until=0.1), nanoseconds(0.1, 0.2), [slice(0, 2)])
    assert steps.tolist() == [10**8]
    with pytest.raises(RecordingError, match=r"the run begins at t = 0\.1, before --rest-until 0\.11"):
        steps_of(rows, replace(FORM, rest_until=0.11), nanoseconds(0.1, 0.2), [slice(0, 2)])
