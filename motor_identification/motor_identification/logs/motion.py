"""The motion column of a log as speeds and counts: what it is exact about, and what had to be assumed."""

from dataclasses import dataclass, replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.csv_form import UNITS, CsvForm, Kind
from motor_identification.logs.csv_table import Table
from motor_identification.measurement.sanity_checks import find_count_jump
from motor_model.errors import RecordingError
from motor_model.sample import Info, Measurement

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

# How far, relatively, the counts of a turn may be from those said or from a whole number: they scale what is measured
# where positions are counted, and only the noise floor where speeds are given.
_AGREE_COUNTS, _AGREE_SPEED = 1e-4, 1e-3
_FAR = 5.5  # times between the steps of speeds and one count, below the 2π, 9.5 and 57.3 of mistaken units
_ON_GRID = 0.05  # counts: how far positions may lie beside whole counts before the user is told


@dataclass(frozen=True)
class Motion:
    """Speeds [rad/s] and counts, each of shape (K,), with the info that says how to read them."""

    speed: Floats
    counts: Integers
    info: Info
    findings: tuple[str, ...]


def read_motion(form: CsvForm, info: Info, table: Table, time: Integers, voltage: Floats, runs: list[slice]) -> Motion:
    """What the column says; `time` [ns] and `voltage` [V] of all rows have the shape (K,).

    Raises:
        RecordingError: the size of a count is not to be had, or contradicts the edges per revolution; counts jump.
    """
    values = table.numbers(form.motion)
    if form.kind is Kind.SPEED:
        return _mean_speeds(form, info, values)
    motion = _counts(form, info, time, values, runs)
    for run in runs:
        jump = find_count_jump((time[run] - time[run.start]) * 1e-9, motion.counts[run], voltage[run])
        if jump is not None:
            raise _jumped(form, table, run.start + jump)
    return motion


def _jumped(form: CsvForm, table: Table, row: int) -> RecordingError:
    before, here = (table.cells[form.motion][k] for k in (row - 1, row))
    return RecordingError(
        f"{table.path}, line {table.lines[row]}: {form.motion} jumps from {before} to {here}: the counter "
        "wrapped or was reset. Unwrap it, or mark the parts in a column for --split."
    )


def _mean_speeds(form: CsvForm, info: Info, values: Floats) -> Motion:
    unit = UNITS[Kind.SPEED][form.unit] or 1.0
    window = form.speed_window or info.sample_period
    lag = 0.5 * window if form.speed_lag is None else form.speed_lag
    edges = form.edges_per_revolution or 0
    if form.count_quantum:
        edges = _agreed(form, 2.0 * pi / (form.count_quantum * unit * window), _AGREE_SPEED)
    if edges:
        _check_steps(form, values, edges, 2.0 * pi / edges / window / unit)
    info = replace(info, measurement=Measurement.SPEED, speed_window=window, speed_lag=lag, edges_per_revolution=edges)
    assumed = "" if form.speed_window else " (assumed: one sample period; otherwise: --speed-window)"
    placed = "" if form.speed_lag is not None else " (assumed: the window ends there; otherwise: --speed-lag)"
    count = (
        f"One count ({edges} per revolution) within the window is {2.0 * pi / edges / window / unit:.4g} {form.unit}."
        if edges
        else "The resolution is not said: a fit finds it in the values (otherwise: --edges-per-revolution)."
    )
    findings = (
        f"Speeds without counts: each is the mean over {window * 1e3:.4g} ms{assumed}.",
        f"The middle of that window is {lag * 1e3:.4g} ms before the row's time{placed}.",
        count,
    )
    return Motion(values * unit, np.zeros(len(values), np.int64), info, findings)


def _check_steps(form: CsvForm, values: Floats, edges: int, count: float) -> None:
    """Speeds that lie on a grid show the size of one count; far from what was said, a unit or a window is wrong."""
    step = _grid_step(values)
    if step is not None and not 1.0 / _FAR < step / count < _FAR:
        raise RecordingError(
            f"Speeds in {form.motion} change in steps of {step:.4g} {form.unit}, but one count ({edges} per "
            f"revolution) is {count:.4g}: check --unit, --edges-per-revolution and --speed-window."
        )


def _counts(form: CsvForm, info: Info, time: Integers, values: Floats, runs: list[slice]) -> Motion:
    quantum, edges, how = _count_size(form, values)
    exact = values / quantum
    counts = np.rint(exact).astype(np.int64)
    beside = float(np.max(np.abs(exact - counts)))
    speed = np.empty(len(counts))
    for run in runs:
        speed[run] = _differences(counts[run], time[run]) * (2.0 * pi / edges)
    info = replace(info, measurement=Measurement.COUNTS, edges_per_revolution=edges)
    findings = [
        f"Sampled counts without time stamps: one count is {quantum:.6g} {form.unit}, {edges} per revolution{how}.",
        "The angle is known to one count at each row's time; the speed is its difference quotient.",
    ]
    if beside > _ON_GRID:
        findings.append(f"Caution: values are up to {beside:.2f} counts off whole counts: check --count-quantum.")
    return Motion(speed, counts, info, tuple(findings))


def _differences(counts: Integers, time: Integers) -> Floats:
    """[counts/s] since the row before; the first row has none, and takes that of the second."""
    rate = np.diff(counts) / (np.diff(time) * 1e-9)
    return np.concatenate((rate[:1], rate))


def _count_size(form: CsvForm, values: Floats) -> tuple[float, int, str]:
    """The size of one count in the form's unit, the counts of a turn, and in words where that comes from."""
    unit = UNITS[form.kind][form.unit]
    if unit is None:  # the file counts by itself
        if form.edges_per_revolution is None:
            raise RecordingError("The size of a count is unknown: give --edges-per-revolution.")
        return form.count_quantum or 1.0, form.edges_per_revolution, ""
    turn = 2.0 * pi / unit
    if form.count_quantum:
        return form.count_quantum, _agreed(form, turn / form.count_quantum, _AGREE_COUNTS), ""
    if form.edges_per_revolution:
        return turn / form.edges_per_revolution, form.edges_per_revolution, ""
    step = _grid_step(values)
    if step is None:
        raise RecordingError(
            f"Positions in {form.motion} show no encoder steps: give --edges-per-revolution or --count-quantum."
        )
    return step, _agreed(form, turn / step, _AGREE_COUNTS), " (assumed: the smallest step in the data)"


def _agreed(form: CsvForm, exact: float, tolerance: float) -> int:
    """Whole counts of a turn, if a count's size leads to them and they are those that were said."""
    edges = form.edges_per_revolution or max(round(exact), 1)
    if abs(exact - edges) > tolerance * edges:
        expected = f"{edges}" if form.edges_per_revolution else "a whole number"
        raise RecordingError(
            f"The counts come to {exact:.6g} per revolution, not {expected}: "
            "check --count-quantum, --edges-per-revolution and --unit."
        )
    return edges


def _grid_step(values: Floats) -> float | None:
    """The spacing of the grid that all values lie on; None where there is none, or too few to tell."""
    levels = np.unique(values)
    if len(levels) < 10:
        return None
    steps = np.diff(levels)
    step = float(np.min(steps[steps > 1e-9 * np.ptp(levels)]))
    exact = (levels - levels[0]) / step
    return step if np.max(np.abs(exact - np.rint(exact))) < _ON_GRID else None
