"""Rows of a log that belong together, and the time between them."""

import re
from collections.abc import Container, Iterable
from itertools import count, groupby

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.csv_form import CsvForm
from motor_identification.logs.csv_table import Table
from motor_model.errors import RecordingError

Integers = NDArray[np.int64]


def runs_of(table: Table, split: str | None) -> dict[str, slice]:
    """Rows that belong together, by label: a new run wherever the split column changes.

    Raises:
        RecordingError: a run of a single row.
    """
    runs: dict[str, slice] = {}
    start = 0
    for value, rows in groupby(table.cells[split] if split else [""] * len(table)):
        stop = start + len(list(rows))
        if stop - start < 2:
            raise RecordingError(
                f"{table.path}, line {table.lines[start]}: the run with {split} = {value} has a single row, "
                "and at least 2 are needed: correct or remove that line."
            )
        runs[_label(value, runs)] = slice(start, stop)
        start = stop
    return runs


def _label(value: str, taken: Container[str]) -> str:
    """The value fit for a file name; a value that comes again gets a number."""
    label = re.sub(r"[^\w.+-]", "_", value)
    if label not in taken:
        return label
    return next(name for number in count(2) if (name := f"{label}_{number}") not in taken)


def steps_of(table: Table, form: CsvForm, time: Integers, runs: Iterable[slice]) -> Integers:
    """Time from row to row inside runs [ns], all positive.

    Raises:
        RecordingError: time stands still or runs backwards in a run, or a run begins before the motor's rest ends.
    """
    column, runs = str(form.time), list(runs)
    for run in runs:
        steps = np.diff(time[run])
        if form.rest_until is not None and time[run.start] < round(form.rest_until * 1e9):
            raise RecordingError(
                f"{table.path}, line {table.lines[run.start]}: the run begins at {column} = "
                f"{table.cells[column][run.start]}, before --rest-until {form.rest_until:g}: that option is for rows "
                "that begin after the first voltage was applied."
            )
        if np.all(steps > 0):
            continue
        row = run.start + 1 + int(np.argmax(steps <= 0))
        before, here = (table.cells[column][k] for k in (row - 1, row))
        what = "stands still" if steps[row - 1 - run.start] == 0 else "runs backwards"
        hint = f"where {form.split} changes" if form.split else "where a column changes that --split names"
        raise RecordingError(
            f"{table.path}, line {table.lines[row]}: time {what} ({column} is {here} after {before}); "
            f"it may restart only {hint}."
        )
    return np.concatenate([np.diff(time[run]) for run in runs])
