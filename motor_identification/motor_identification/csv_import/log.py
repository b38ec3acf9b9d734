"""Turns other people's CSV logs into a motor's samples, and says which assumptions that took."""

import re
from collections.abc import Container
from dataclasses import dataclass
from itertools import count, groupby
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from motor_identification.csv_import.form import CsvForm
from motor_identification.csv_import.motion import read_motion
from motor_identification.csv_import.table import Table, read_table
from motor_model.errors import RecordingError
from motor_model.sample import Info, Sample

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True)
class Run:
    """One recording; `label` is the value of the split column made fit for a file name, empty without one."""

    label: str
    samples: tuple[Sample, ...]

    @property
    def duration(self) -> float:
        """[s] from the first sample to the last."""
        return (self.samples[-1].sample_time - self.samples[0].sample_time) * 1e-9


@dataclass(frozen=True)
class Log:
    """What a file holds; `findings` are lines for the user: what was found and what was assumed."""

    info: Info
    runs: tuple[Run, ...]
    findings: tuple[str, ...]


def read_log(path: Path, form: CsvForm) -> Log:
    """Read a CSV file as the form says.

    Raises:
        RecordingError: the file cannot be used as it is; the sentence names line and column.
    """
    table = read_table(path, form.columns)
    runs = _runs(table, form.split)
    time = table.nanoseconds(form.time)
    steps = _steps(table, form, time, list(runs.values()))
    voltage = table.numbers(form.voltage) * form.voltage_scale
    info = Info(
        name=form.name,
        source="import",
        single_channel=False,  # such logs have signs
        edge_resolution=0.0,  # and no stamps
        sample_period=float(np.median(steps)) * 1e-9,
        max_voltage=_max_voltage(form, voltage, path),
    )
    motion = read_motion(form, info, time, table.numbers(form.motion), list(runs.values()))
    rows = zip(time.tolist(), motion.speed.tolist(), voltage.tolist(), motion.counts.tolist(), strict=True)
    samples = tuple(Sample(*row) for row in rows)
    about = f"{path}: {_about_time(len(table), len(runs), steps)}, at most {info.max_voltage:.4g} V."
    return Log(
        info=motion.info,
        runs=tuple(Run(label, samples[rows_of_run]) for label, rows_of_run in runs.items()),
        findings=(about, *motion.findings),
    )


def _runs(table: Table, split: str | None) -> dict[str, slice]:
    """Rows that belong together, by label: a new run wherever the split column changes."""
    runs: dict[str, slice] = {}
    start = 0
    for value, rows in groupby(table.cells[split] if split else [""] * len(table)):
        stop = start + len(list(rows))
        if stop - start < 2:
            raise RecordingError(
                f"{table.path}, line {table.lines[start]}: the run with {split} = {value} has a single row; "
                "at least 2 samples are needed: correct or remove that line."
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


def _steps(table: Table, form: CsvForm, time: Integers, runs: list[slice]) -> Integers:
    """Time from row to row inside runs [ns], all positive."""
    for run in runs:
        steps = np.diff(time[run])
        if np.all(steps > 0):
            continue
        row = run.start + 1 + int(np.argmax(steps <= 0))
        before, here = (table.cells[form.time][k] for k in (row - 1, row))
        what = "stands still" if steps[row - 1 - run.start] == 0 else "runs backwards"
        hint = f"where {form.split} changes" if form.split else "where a column changes that --split names"
        raise RecordingError(
            f"{table.path}, line {table.lines[row]}: time {what} ({form.time} is {here} after {before}); "
            f"it may start again only {hint}."
        )
    return np.concatenate([np.diff(time[run]) for run in runs])


def _max_voltage(form: CsvForm, voltage: Floats, path: Path) -> float:
    largest = form.max_voltage or float(np.max(np.abs(voltage)))
    if largest == 0.0:
        raise RecordingError(f"{path}: {form.voltage} is 0 in every row: check --voltage, or say --max-voltage.")
    return largest


def _about_time(rows: int, runs: int, steps: Integers) -> str:
    span = f"{rows} rows" + (f" in {runs} runs" if runs > 1 else "")
    shortest, middle, longest = (float(value) * 1e-6 for value in (steps.min(), np.median(steps), steps.max()))
    return f"{span}, {steps.sum() * 1e-9:.2f} s, sample period {middle:.4g} ms ({shortest:.4g} to {longest:.4g} ms)"
