"""Turns other people's CSV logs into a motor's samples, and says which assumptions that took."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.csv_form import CsvForm
from motor_identification.logs.csv_table import Table, read_table
from motor_identification.logs.motion import read_motion
from motor_identification.logs.runs import runs_of, steps_of
from motor_identification.logs.steady import read_steady
from motor_model.errors import RecordingError
from motor_model.sample import Info, Sample

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

FROM_THEN = "Assumed: a row's voltage is applied from its time until the next row (otherwise: --voltage-before)."
BEFORE = "A row's voltage is applied from the time of the row before until its own."


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
    runs = runs_of(table, form.split)
    voltage = table.numbers(form.voltage) * form.voltage_scale
    info = Info(
        name=form.name,
        source="import",
        single_channel=False,  # such logs have signs
        edge_resolution=0.0,  # and no stamps
        max_voltage=_max_voltage(form, voltage, path),
    )
    if form.time is None:
        return _steady_log(table, form, info, voltage, runs)
    return _timed_log(table, form, info, voltage, runs)


def _timed_log(table: Table, form: CsvForm, info: Info, voltage: Floats, runs: dict[str, slice]) -> Log:
    """Rows with a time of their own."""
    time = table.nanoseconds(str(form.time))
    steps = steps_of(table, form, time, runs.values())
    info = replace(info, sample_period=float(np.median(steps)) * 1e-9)
    motion = read_motion(form, info, table, time, voltage, list(runs.values()))
    held = _held(form, voltage, runs)
    rows = zip(time.tolist(), motion.speed.tolist(), held.tolist(), motion.counts.tolist(), strict=True)
    samples = tuple(Sample(*row) for row in rows)
    about = f"{table.path}: {_about_time(len(table), len(runs), steps)}, up to {info.max_voltage:.4g} V."
    applied = BEFORE if form.voltage_before else FROM_THEN
    rest = () if form.rest_until is None else (_about_rest(form.rest_until, len(runs)),)
    return Log(
        info=motion.info,
        runs=tuple(Run(label, _from_rest(samples[rows], form, voltage[rows.start])) for label, rows in runs.items()),
        findings=(about, *motion.findings, applied, *rest),
    )


def _held(form: CsvForm, voltage: Floats, runs: dict[str, slice]) -> Floats:
    """[V] what holds from every row's time until the next, shape (K,)."""
    if not form.voltage_before:
        return voltage
    return np.concatenate([np.append(voltage[rows][1:], voltage[rows][-1]) for rows in runs.values()])


def _from_rest(samples: tuple[Sample, ...], form: CsvForm, voltage: float) -> tuple[Sample, ...]:
    """The samples of a run, beginning at the instant when its first voltage [V] came upon a standing motor."""
    if form.rest_until is None:
        return samples
    begin, (first, *others) = round(form.rest_until * 1e9), samples
    if first.sample_time == begin:
        return (replace(first, speed=0.0), *others)
    return (replace(first, sample_time=begin, speed=0.0, voltage=float(voltage)), *samples)


def _about_rest(rest_until: float, runs: int) -> str:
    which = "every run begins" if runs > 1 else "the bag begins"
    return (
        f"The motor stands until {rest_until:g} s: {which} then, at speed 0, with the voltage and the count of its "
        "first row."
    )


def _steady_log(table: Table, form: CsvForm, info: Info, voltage: Floats, runs: dict[str, slice]) -> Log:
    """Rows that are steady states."""
    steady = read_steady(form, info, voltage, table.numbers(form.motion), list(runs.values()))
    about = f"{table.path}: {len(table)} steady states, up to {info.max_voltage:.4g} V."
    made = tuple(Run(label, samples) for label, samples in zip(runs, steady.samples, strict=True))
    return Log(steady.info, made, (about, *steady.findings))


def _max_voltage(form: CsvForm, voltage: Floats, path: Path) -> float:
    largest = form.max_voltage or float(np.max(np.abs(voltage)))
    if largest == 0.0:
        raise RecordingError(f"{path}: {form.voltage} is 0 in every row: check --voltage, or give --max-voltage.")
    return largest


def _about_time(rows: int, runs: int, steps: Integers) -> str:
    span = f"{rows} rows" + (f" in {runs} runs" if runs > 1 else "")
    shortest, middle, longest = (float(value) * 1e-6 for value in (steps.min(), np.median(steps), steps.max()))
    return f"{span}, {steps.sum() * 1e-9:.2f} s, sample period {middle:.4g} ms ({shortest:.4g} to {longest:.4g} ms)"
