"""Turns other people's logs into a motor's samples, and says which assumptions that took."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import nan
from pathlib import Path

import numpy as np

from motor_identification.logs.csv.reader import read_table
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import CsvForm, Kind, time_unit_size
from motor_identification.logs.motion import Motion, read_motion
from motor_identification.logs.rows.absurd_speeds import drop_absurd_beginnings, take_rest_for_zero
from motor_identification.logs.rows.drive.coded_rows import drop_coded_rows
from motor_identification.logs.rows.drive.late_start import drop_late_start
from motor_identification.logs.rows.drive.logged_levels import split_between_levels
from motor_identification.logs.rows.drive.lost_counts import caution_lost_counts
from motor_identification.logs.rows.drive.lost_rows import read_speeds_where_rows_are_lost
from motor_identification.logs.rows.drive.unpowered_end import drop_unpowered_end
from motor_identification.logs.rows.drive.unpowered_start import drop_unpowered_start
from motor_identification.logs.rows.drive.unread_start import drop_unread_start
from motor_identification.logs.rows.drive.unread_values import drop_unread_values
from motor_identification.logs.rows.even_clock import restore_even_clock
from motor_identification.logs.rows.parts import (
    check_rest,
    check_steps,
    drop_first_rows,
    split_at_gaps,
    split_at_restarts,
    split_by_column,
)
from motor_identification.logs.rows.row_lengths import divide_by_regular_rows
from motor_identification.logs.rows.stamps import drop_stray_stamps, separate_stamps, unwrap_clock
from motor_identification.logs.rows.wraps import unwrap
from motor_identification.logs.run import Run
from motor_identification.logs.signals import LARGEST_VOLTAGE, Floats, Integers, Signals, read_signals
from motor_identification.logs.steady import read_steady
from motor_identification.logs.still_runs import leave_out_still_runs
from motor_identification.logs.voltage_timing import acts_before
from motor_model.errors import RecordingError
from motor_model.sample import RANGES, Info, Measurement, Sample

FROM_THEN = "Assumed: a row's voltage is applied from its time until the next row (otherwise: --voltage-before)."
BEFORE = "A row's voltage is applied from the time of the row before until its own."
ANSWERED = (
    "A row's motion answers its own voltage: that is applied from the time of the row before until its own (found; "
    "otherwise: --no-voltage-before)."
)


NUMBERS = {  # what a user calls the numbers of a plant, with their units
    "edges_per_revolution": ("the counts of a turn", ""),
    "sample_period": ("the time from row to row", " s"),
    "speed_window": ("the time that a speed is the mean over", " s"),
    "speed_lag": ("the age of a speed", " s"),
    "max_voltage": ("the largest voltage", " V"),
    "gear_ratio": ("the gear's ratio", ""),
}


@dataclass(frozen=True)
class Log:
    """What a file holds; `findings` are lines for the user: what was found and what was assumed."""

    info: Info
    runs: tuple[Run, ...]
    findings: tuple[str, ...]


def read_log(path: Path, form: CsvForm) -> Log:
    """Read a text table as the form says.

    Raises:
        RecordingError: the file cannot be used as it is; the sentence names line and column.
    """
    return read_motor(read_table(path, form.columns), form)


def read_motor(table: Table, form: CsvForm) -> Log:
    """Read one motor out of a table, from whatever format that came.

    Raises:
        RecordingError: the table cannot be used as it is; the sentence names line and column.
    """
    signals, coded = drop_coded_rows(read_signals(table, form, split_by_column(table, form.split)), table, form)
    signals, form, lost = read_speeds_where_rows_are_lost(signals, form)
    info = Info(
        name=form.name,
        source="import",
        single_channel=False,  # such logs have signs, unless their counts show that they have none
        edge_resolution=0.0,  # and no stamps
        max_voltage=_max_voltage(form, signals),
        gear_ratio=float(form.gear) if form.gear != 1 else 0.0,
    )
    log = _steady_log(form, info, signals) if form.time is None else _timed_log(table, form, info, signals)
    _check_ranges(table.path, log.info)
    return replace(log, findings=(*table.notes, *coded, *lost, *log.findings))


def _check_ranges(path: Path, info: Info) -> None:
    """Refuse what no reader of the bag would take, such as rows a nanosecond apart."""
    for name, (low, high) in RANGES.items():
        value = getattr(info, name)
        if not low <= value <= high:
            what, unit = NUMBERS.get(name, (name, ""))
            raise RecordingError(
                f"{path}: {what} comes to {value:.3g}{unit}, and must be from {low:g} to {high:g}{unit}: "
                "check columns and units."
            )


def _timed_log(table: Table, form: CsvForm, info: Info, signals: Signals) -> Log:
    """Rows with a time of their own."""
    said: list[str] = []
    signals, full = unwrap_clock(signals, time_unit_size(form.time_unit))
    signals, stray = drop_stray_stamps(signals)
    signals, restarts = split_at_restarts(signals, form)
    signals, levels = split_between_levels(signals)
    stamped = signals
    signals, stamps = separate_stamps(signals)
    signals, divided = divide_by_regular_rows(stamped, signals) if form.kind is Kind.SPEED else (signals, [])
    signals, first = drop_first_rows(signals)
    signals, rests = take_rest_for_zero(signals) if form.kind is Kind.SPEED else (signals, [])
    signals, unpowered = drop_unpowered_start(signals, form)
    signals, late = drop_late_start(signals, form)
    signals, off = drop_unpowered_end(signals, form)
    signals, misread = drop_unread_values(signals, form)
    signals, unread = drop_unread_start(signals, form)
    signals, absurd = drop_absurd_beginnings(signals) if form.kind is Kind.SPEED else (signals, [])
    signals, gaps = split_at_gaps(signals)
    signals, clock = _restore_clock(signals, form)
    said += [
        *full,
        *stray,
        *restarts,
        *levels,
        *stamps,
        *divided,
        *first,
        *rests,
        *unpowered,
        *late,
        *off,
        *misread,
        *unread,
        *absurd,
        *gaps,
        *clock,
        *caution_lost_counts(signals, form),
    ]
    check_rest(signals, table, form)
    check_steps(signals)
    info = replace(info, sample_period=float(np.median(signals.steps())) * 1e-9)
    motion = read_motion(form, info, signals)
    signals = motion.signals
    found = form.voltage_before is None and acts_before(_counted_speeds(motion))
    before = form.voltage_before or found
    samples = _samples(motion, _hold(signals, before))
    about = f"{table.path}: {_about_time(signals)}, up to {info.max_voltage:.4g} V."
    applied = ANSWERED if found else BEFORE if before else FROM_THEN
    fresh = signals.fresh_runs()
    rest = () if form.rest_until is None else (_about_rest(form.rest_until, len(fresh), len(signals.runs)),)
    made = [
        Run(label, _from_rest(samples[rows], form, signals.voltage[rows.start]) if label in fresh else samples[rows])
        for label, rows in signals.runs.items()
    ]
    runs, still = leave_out_still_runs(made)
    info = replace(
        motion.info,
        voltage_assumed=form.voltage_before is None and not found,
        rows_said=form.nominal_period is not None,
        speed_said=form.speed_window is not None or form.speed_lag is not None,
    )
    return Log(info, runs, (about, *said, *motion.findings, applied, *rest, *still))


def _restore_clock(signals: Signals, form: CsvForm) -> tuple[Signals, list[str]]:
    """Put rows onto the clock that their motion goes on with; positions that wrap are unwrapped for that."""
    is_speed = form.kind is Kind.SPEED
    unwrapped = signals if is_speed else unwrap(signals, form)[0]
    restored, said = restore_even_clock(unwrapped, form.even_clock, is_speed)
    return (replace(signals, time=restored.time), said) if said else (signals, [])


def _samples(motion: Motion, held: Floats) -> tuple[Sample, ...]:
    signals = motion.signals
    count = len(signals)
    columns = (
        signals.time.tolist(),
        motion.speed.tolist(),
        held.tolist(),
        motion.counts.tolist(),
        (0,) * count,
        (0.0,) * count,
        (nan,) * count if np.isnan(signals.supply).all() else signals.supply.tolist(),
        (nan,) * count if np.isnan(signals.current).all() else signals.current.tolist(),
    )
    return tuple(map(Sample, *columns))


def _counted_speeds(motion: Motion) -> Iterator[tuple[Floats, Floats]]:
    """Voltages [V] and means from row to row of every run of counts, each of shape (K,).

    Logged speeds tell nothing by this: they may be made of rows after their own. Fits find when they were made.
    """
    signals = motion.signals
    if motion.info.measurement is Measurement.COUNTS:
        for rows in signals.runs.values():
            ways = np.sign(motion.speed[rows][1:]) if motion.info.single_channel else 1.0
            yield signals.voltage[rows][1:], ways * np.diff(motion.counts[rows]) / np.diff(signals.time[rows])


def _hold(signals: Signals, before: bool) -> Floats:
    """[V] what holds from every row's time until the next, shape (K,); `before`: what is logged held until the row."""
    if not before:
        return signals.voltage
    held = np.empty(len(signals))
    for rows in signals.runs.values():
        held[rows] = np.append(signals.voltage[rows][1:], signals.voltage[rows][-1])
    return held


def _from_rest(samples: tuple[Sample, ...], form: CsvForm, voltage: float) -> tuple[Sample, ...]:
    """The samples of a run, beginning at the instant when its first voltage [V] came upon a standing motor."""
    if form.rest_until is None:
        return samples
    begin, (first, *others) = round(form.rest_until * 1e9), samples
    if first.sample_time == begin:
        return (replace(first, speed=0.0), *others)
    return (replace(first, sample_time=begin, speed=0.0, voltage=float(voltage)), *samples)


def _about_rest(rest_until: float, fresh: int, runs: int) -> str:
    every = "every run" if fresh == runs else "every run that goes on from none before"
    which = f"{every} begins" if runs > 1 else "the bag begins"
    return (
        f"The motor stands until {rest_until:g} s: {which} then, at speed 0, with the voltage and the count of its "
        "first row."
    )


def _steady_log(form: CsvForm, info: Info, signals: Signals) -> Log:
    """Rows that are steady states."""
    steady = read_steady(form, info, signals.voltage, signals.motion, list(signals.runs.values()))
    about = f"{signals.path}: {len(signals)} steady states, up to {info.max_voltage:.4g} V."
    made = tuple(Run(label, samples) for label, samples in zip(signals.runs, steady.samples, strict=True))
    return Log(steady.info, made, (about, *steady.findings))


def _max_voltage(form: CsvForm, signals: Signals) -> float:
    """[V] at full duty: what was said, or the supply column's median, where no row got more; else the most of a row."""
    largest = form.max_voltage or max(float(np.max(np.abs(signals.voltage))), _usual_supply(form, signals))
    if largest == 0.0:
        raise RecordingError(
            f"{signals.path}: {form.voltage} is 0 in every row: check --voltage, or give --max-voltage."
        )
    return largest


def _usual_supply(form: CsvForm, signals: Signals) -> float:
    """[V] the median of the supply that the drive is a share of; 0 without one, or of a motor that nothing drives."""
    if form.supply is None or not np.any(signals.voltage):
        return 0.0
    return min(float(np.median(signals.supply)), LARGEST_VOLTAGE)


def _about_time(signals: Signals) -> str:
    steps: Integers = signals.steps()
    span = f"{len(signals)} rows" + (f" in {len(signals.runs)} runs" if len(signals.runs) > 1 else "")
    shortest, middle, longest = (float(value) * 1e-6 for value in (steps.min(), np.median(steps), steps.max()))
    return f"{span}, {steps.sum() * 1e-9:.2f} s, sample period {middle:.4g} ms ({shortest:.4g} to {longest:.4g} ms)"
