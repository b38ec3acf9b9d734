"""The drive of a log of one step that has no column of it: so many volts where the user says so, once the motor moves.

A log that begins before its step shows a motor that stands much longer than it then takes to come up to its speed, or
until the time 0 of an oscilloscope that was triggered, or until whoever asks says.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import CsvForm, Kind, time_unit_size

Floats = NDArray[np.float64]

CONSTANT = "(constant voltage)"  # column
STANDS = 0.05  # of its last speed: the largest may be that of a value which was read before a row's time
RISEN = 0.63  # of its last speed: a time constant after the step
LONGER = 3.0  # times what it takes to rise: no bridge and no network is as late as that, which would be a delay
COUNTS = 8.0  # as usual, of a position, over which its speed is averaged: one count in a row is no top speed
FEWEST_ROWS = 10  # that tell a motor which stands from a first row of zeros


def give_voltage(table: Table, voltage: float) -> Table:
    """Add a column of one voltage [V]."""
    return replace(table, cells={**table.cells, CONSTANT: np.full(len(table), voltage)})


def wait_for_motion(table: Table, form: CsvForm) -> Table:
    """Take the constant voltage from the rows in which a motor stands before its step, and say so."""
    if form.voltage != CONSTANT or form.split or form.time is None:
        return table
    motion = table.numbers(form.motion)
    if form.rest_until is not None and (rested := _count_rows_at_rest(table, form, motion, form.rest_until)):
        note = f"Left out: the first {rested} rows, in which the motor stands until {form.rest_until:g} s, as was said."
        return table.rows(np.arange(len(table)) >= rested, note)
    if form.kind is Kind.SPEED:
        standing = count_standing_rows(motion)
    else:
        standing = count_standing_rows(_differentiate(motion, table.numbers(form.time)), _count_slow_rows(motion))
    note = (
        f"The motor stands in the first {standing} rows, longer than any delay: its voltage is taken to come in the "
        "last of them, and a delay is not to be had from it."
    )
    without = standing - 1
    if not standing:
        without = 0 if form.rest_until is not None else _count_rows_at_rest(table, form, motion, 0.0)
        note = (
            f"The clock begins before 0 s, as that of an oscilloscope before its trigger, and the motor stands until "
            f"then, {without} rows: its voltage is taken to come at 0 s (assumed; otherwise: --rest-until)."
        )
    if without <= 0:
        return table
    voltage = table.numbers(CONSTANT).copy()
    voltage[:without] = 0.0
    return replace(table, cells={**table.cells, CONSTANT: voltage}, notes=(*table.notes, note))


def _count_rows_at_rest(table: Table, form: CsvForm, motion: Floats, until: float) -> int:
    """Count the first rows, before a time [s], if a motor stands in all of them; 0 where it moves, or they are few."""
    time = table.nanoseconds(form.time or "", time_unit_size(form.time_unit))
    before = int(np.argmax(time >= round(until * 1e9))) if np.any(time >= round(until * 1e9)) else 0
    if before < FEWEST_ROWS or np.any(np.diff(time) < 0):
        return 0
    return before if np.ptp(motion[:before]) <= STANDS * np.ptp(motion) else 0


def count_standing_rows(speed: Floats, slow: int = 1) -> int:
    """Count the rows before a motor moves, of speeds (K,) in any unit; 0 where a delay may be as long.

    slow: rows over which speeds are averaged to see them rise.
    """
    size = np.abs(speed)
    smooth = np.asarray(np.convolve(size, np.full(slow, 1.0 / slow))[: len(size)])
    last = float(np.median(smooth[-(len(size) // 4 + 1) :]))
    moves = size > STANDS * (last or np.max(size, initial=0.0))
    first = int(np.argmax(moves)) if moves.any() else 0
    rise = max(int(np.argmax(smooth[first:] >= RISEN * last)) - (slow - 1) // 2, 0)
    return first if first >= max(FEWEST_ROWS, LONGER * rise) else 0


def _count_slow_rows(motion: Floats) -> int:
    """Count the rows in which positions (K,) usually go on by enough of their steps to tell a speed."""
    steps = np.abs(np.diff(motion))
    steps = steps[steps > 0.0]
    return max(1, min(len(motion) // 4, round(COUNTS * steps.min() * len(motion) / steps.sum()))) if len(steps) else 1


def _differentiate(motion: Floats, time: Floats) -> Floats:
    """Differentiate positions (K,) by the time since the row before: many a step is long because rows are missing."""
    steps, held = np.diff(motion, prepend=motion[:1]), np.diff(time, prepend=time[:1])
    return np.asarray(np.divide(steps, held, out=np.zeros(len(steps)), where=held > 0.0))
