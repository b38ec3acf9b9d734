"""The rows of one motor's log as arrays, in runs that belong together."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.motion.direction import is_backward
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import CsvForm, time_unit_size
from motor_model.errors import RecordingError
from motor_model.sample import RANGES

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Bools = NDArray[np.bool_]

# What no small motor has, and what a slip of the units makes: refused where it is read.
LARGEST_VOLTAGE = RANGES["max_voltage"][1]  # [V]
LARGEST_MOTION = 1e15  # in any unit: beyond, float64 has no whole counts left


@dataclass(frozen=True)
class Signals:
    """Arrays of shape (K,); `runs` are contiguous parts of them, by label."""

    path: Path
    lines: Integers  # in the file, from 1
    time: Integers  # [ns]
    voltage: Floats  # [V]
    motion: Floats  # in the form's unit
    supply: Floats  # [V] NaN if unmeasured
    current: Floats  # [A] NaN if unmeasured
    runs: dict[str, slice]

    def __len__(self) -> int:
        return len(self.time)

    def only(self, keep: Bools) -> "Signals":
        """The rows to be kept, shape (K,); runs that are left with fewer than two rows are gone."""
        before = np.concatenate(([0], np.cumsum(keep)))
        runs = {label: slice(int(before[run.start]), int(before[run.stop])) for label, run in self.runs.items()}
        kept = {label: run for label, run in runs.items() if run.stop - run.start >= 2}
        if len(kept) == len(runs):
            return self._rows(keep, kept)
        still = np.zeros(int(before[-1]), np.bool_)
        for run in kept.values():
            still[run] = True
        return self._rows(keep, kept).only(still)

    def split(self, begins: Bools) -> "Signals":
        """Runs that begin anew at marked rows, shape (K,); runs of one row are gone, and need no number."""
        runs: dict[str, slice] = {}
        for label, run in self.runs.items():
            inside = np.flatnonzero(begins[run.start + 1 : run.stop]) + run.start + 1
            edges = [run.start, *map(int, inside), run.stop]
            parts = list(zip(edges, edges[1:], strict=False))
            several = sum(stop - start > 1 for start, stop in parts) > 1
            for number, (start, stop) in enumerate(parts, start=1):
                if stop - start > 1 and not several:
                    runs[label] = slice(start, stop)
                else:
                    runs[f"{label}_{number}" if label else f"{number}"] = slice(start, stop)
        return replace(self, runs=runs).only(np.ones(len(self), np.bool_))

    def steps(self) -> Integers:
        """[ns] from row to row inside runs."""
        parts = [np.diff(self.time[run]) for run in self.runs.values()]
        return np.concatenate(parts) if parts else np.zeros(0, np.int64)

    def fresh_runs(self) -> dict[str, slice]:
        """The runs whose clock begins again, or that are the first; others go on behind rows that are missing."""
        fresh, last = {}, None
        for label, run in self.runs.items():
            if last is None or self.time[run.start] <= last:
                fresh[label] = run
            last = self.time[run.stop - 1]
        return fresh

    def _rows(self, keep: Bools, runs: dict[str, slice]) -> "Signals":
        names = ("lines", "time", "voltage", "motion", "supply", "current")
        return replace(self, runs=runs, **{name: getattr(self, name)[keep] for name in names})


def read_signals(table: Table, form: CsvForm, runs: dict[str, slice]) -> Signals:
    """The columns of a table as the form says, in rows that nothing was done to yet.

    Raises:
        RecordingError: a cell is not a number, or a voltage is none of a motor.
    """
    count = len(table)
    unknown = np.full(count, np.nan)
    supply = table.numbers(form.supply) * form.supply_scale if form.supply else unknown
    with np.errstate(over="ignore"):  # refused below
        drive = table.numbers(form.voltage) * form.voltage_scale
        voltage = drive * supply if form.supply else drive
    if form.direction:
        voltage = np.where(is_backward(table, form.direction, form.backward), -voltage, voltage)
    wrong = ~(np.abs(voltage) <= LARGEST_VOLTAGE)
    if wrong.any():
        row = int(np.argmax(wrong))
        raise RecordingError(
            f"{table.path}, line {table.lines[row]}: {form.voltage} comes to {voltage[row]:.3g} V, which no such motor "
            "has: check the column and --voltage-scale."
        )
    motion = table.numbers(form.motion)
    motion = np.cumsum(motion) if form.increments else motion
    far = np.abs(motion) > LARGEST_MOTION
    if far.any():
        row = int(np.argmax(far))
        raise RecordingError(
            f"{table.path}, line {table.lines[row]}: {form.motion} is {motion[row]:.3g}, which is no motion of a "
            "motor: check the column, or remove that line."
        )
    time = table.nanoseconds(form.time, time_unit_size(form.time_unit)) if form.time else np.zeros(count, np.int64)
    return Signals(
        path=table.path,
        lines=np.asarray(table.lines, np.int64),
        time=time,
        voltage=voltage,
        motion=motion,
        supply=supply,
        current=table.numbers(form.current) * form.current_scale if form.current else unknown,
        runs=runs,
    )
