"""Turns other people's CSV logs into a motor's samples, and says which assumptions that took."""

import re
from dataclasses import dataclass, replace
from enum import Enum
from itertools import groupby
from math import degrees, pi, radians
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from motor_identification.csv_table import Table, read_table
from motor_model.errors import RecordingError
from motor_model.sample import Info, Measurement, Sample

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


class Kind(str, Enum):
    """What the motion column of a log holds."""

    SPEED = "speed"
    POSITION = "position"
    COUNT = "count"


# By kind: what one unit is in rad/s or rad; the first one is the default. A count has the size that the encoder gives it.
UNITS: dict[Kind, dict[str, float]] = {
    Kind.SPEED: {"rad/s": 1.0, "deg/s": radians(1.0), "rpm": 2.0 * pi / 60.0},
    Kind.POSITION: {"rad": 1.0, "deg": radians(1.0), "rev": 2.0 * pi, "count": 0.0},
    Kind.COUNT: {"count": 0.0},
}


@dataclass(frozen=True)
class CsvFormat:
    """Which columns of a file mean what; None is "not said"."""

    time: str  # column of seconds
    voltage: str  # column; times `voltage_scale` it is volts, applied from the row's time on
    motion: str  # column of what `kind` says, in `unit`
    kind: Kind
    unit: str
    voltage_scale: float = 1.0
    edges_per_revolution: int | None = None
    count_quantum: float | None = None  # the size of one count in `unit`
    speed_window: float | None = None  # [s] what a speed is the mean over
    speed_lag: float | None = None  # [s] how old the middle of that window is at the row's time
    split: str | None = None  # column; each run of one value is a recording of its own
    name: str = "motor"
    max_voltage: float | None = None  # [V]


@dataclass(frozen=True)
class Run:
    """One recording; `label` is the value of the split column, made fit for a file name."""

    label: str
    samples: tuple[Sample, ...]


@dataclass(frozen=True)
class Imported:
    """What a log holds; `findings` are lines for the user: what was found and what was assumed."""

    info: Info
    runs: tuple[Run, ...]
    findings: tuple[str, ...]


def import_csv(path: Path, form: CsvFormat) -> Imported:
    """Read a log.

    Raises:
        RecordingError: the file cannot be used as it is; the sentence names line and column.
    """
    columns = [form.time, form.voltage, form.motion, *([form.split] if form.split else [])]
    table = read_table(path, columns)
    runs = _runs(table, form.split)
    time = table.nanoseconds(form.time)
    steps = _steps(table, form, time, runs)
    voltage = table.numbers(form.voltage) * form.voltage_scale
    motion = table.numbers(form.motion)
    period = float(np.median(steps)) * 1e-9
    info = Info(name=form.name, source="import", single_channel=False, edge_resolution=0.0, sample_period=period)
    info = replace(info, max_voltage=_max_voltage(form, voltage, path))
    about = _about_time(len(table), len(runs), steps)
    read = _read_speed if form.kind is Kind.SPEED else _read_counts
    info, speed, counts, findings = read(path, form, info, time, motion, runs)
    samples = tuple(
        Sample(*values) for values in zip(time.tolist(), speed.tolist(), voltage.tolist(), counts.tolist(), strict=True)
    )
    return Imported(
        info,
        tuple(Run(label, samples[part]) for label, part in runs),
        (f"{path}: {about}, at most {info.max_voltage:.4g} V.", *findings),
    )


def _runs(table: Table, split: str | None) -> list[tuple[str, slice]]:
    """Rows that belong together: a new run wherever the split column changes."""
    if split is None:
        return [("", slice(0, len(table)))]
    runs: list[tuple[str, slice]] = []
    seen: dict[str, int] = {}
    start = 0
    for value, rows in groupby(table.cells[split]):
        stop = start + len(list(rows))
        label = re.sub(r"[^\w.+-]", "_", value) or "none"
        seen[label] = seen.get(label, 0) + 1
        runs.append((label if seen[label] == 1 else f"{label}_{seen[label]}", slice(start, stop)))
        if stop - start < 2:
            raise RecordingError(
                f"{table.path}, line {table.lines[start]}: the run with {split} = {value} has one row only; "
                "at least 2 samples are needed."
            )
        start = stop
    return runs


def _steps(table: Table, form: CsvFormat, time: Integers, runs: list[tuple[str, slice]]) -> Integers:
    """Time from row to row inside runs [ns]."""
    for _, part in runs:
        steps = np.diff(time[part])
        if np.all(steps > 0):
            continue
        row = part.start + 1 + int(np.argmax(steps <= 0))
        before, here = (table.cells[form.time][k] for k in (row - 1, row))
        what = "stands still" if here == before else "runs backwards"
        hint = f"where {form.split} changes" if form.split else "where the column changes that --split names"
        raise RecordingError(
            f"{table.path}, line {table.lines[row]}: time {what} ({form.time} is {here} after {before}); "
            f"it may start again only {hint}."
        )
    return np.concatenate([np.diff(time[part]) for _, part in runs])


def _max_voltage(form: CsvFormat, voltage: Floats, path: Path) -> float:
    largest = form.max_voltage or float(np.max(np.abs(voltage)))
    if largest == 0.0:
        raise RecordingError(f"{path}: {form.voltage} is 0 in every row: check --voltage, or say --max-voltage.")
    return largest


def _about_time(rows: int, runs: int, steps: Integers) -> str:
    span = f"{rows} rows" + (f" in {runs} runs" if runs > 1 else "")
    shortest, middle, longest = (float(value) * 1e-6 for value in (steps.min(), np.median(steps), steps.max()))
    return f"{span}, {steps.sum() * 1e-9:.2f} s, sample period {middle:.4g} ms ({shortest:.4g} to {longest:.4g} ms)"
