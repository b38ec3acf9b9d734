"""The unit of a column of times, where its name does not say it: by when it is, and by how often rows come."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import TIME_UNITS
from motor_model.errors import RecordingError

Floats = NDArray[np.float64]

SLOWEST = 0.4  # [s] between rows of a recording that shows motion; also the border between units, which are 1,000 apart
LATE = 3.0  # times the usual step: a row that came later than that
FIRST_ROWS, SLOW = 5, 0.75  # rows, and times the last rate: a motor needs rows to get going
STEADY = 0.15  # by which the rate of the third quarter may be off that of the last one
_SINCE_1970 = (1e9, 2.2e9)  # [s] 2001 to 2039
SLOWEST_STEADY = 5e3  # [ms] between the rows of a static curve
_DAYS = ((2e4, 7e4), (7e5, 8e5))  # of a date, as spreadsheets and MATLAB count them
_ROUND = 100.0  # times that are all multiples of it are no microseconds: nobody's loop is that even
# Microseconds of one tick of a small board's timer, by which its clock goes on; rows of a loop are many of them apart,
# by steps of many kinds, and so many of them are by no chance.
TICK, TICKS_APART, KINDS, FEWEST_STAMPS = 4.0, 8.0, 5, 50


def read_clock(table: Table, name: str) -> Floats:
    """Read a column of times, shape (K,): numbers, or dates and times of day [ns]; empty where it is neither."""
    for read in (table.numbers, table.nanoseconds):
        try:
            return np.asarray(read(name), dtype=np.float64)
        except RecordingError:
            continue
    return np.zeros(0)


def since_1970(values: Floats) -> str:
    """The unit in which times, shape (K,), count from 1970 and lie between 2001 and 2039; empty where in none."""
    for unit, size in TIME_UNITS.items():
        low, high = (limit * 1e9 / size for limit in _SINCE_1970)
        if low <= float(np.median(values)) <= high and row_period(values) < 10.0 * 1e9 / size:
            return unit
    return ""


def are_days(values: Floats) -> bool:
    """Whether times, shape (K,), are dates in days: as seconds their rows would be microseconds apart."""
    if len(values) < 2 or not any(low < float(np.median(values)) < high for low, high in _DAYS):
        return False
    return 0.0 < row_period(values) * 86_400.0 < SLOWEST


def guess_time_unit(values: Floats) -> tuple[str, str]:
    """The unit of times, shape (K,), and why."""
    if unit := since_1970(values):
        return unit, f"they count from 1970 in {unit}"
    period = row_period(values)
    if period * TIME_UNITS["us"] * 1e-9 < SLOWEST and _are_ticks(values):
        return "us", f"all are multiples of {TICK:g}, as where a small board's timer ticks every {TICK:g} us"
    rounded = not np.any(values % _ROUND) and bool(np.any(values))
    for unit, size in TIME_UNITS.items():
        if period * size * 1e-9 < SLOWEST or (unit == "ms" and rounded and period < SLOWEST_STEADY):
            return unit, f"rows are then {period * size * 1e-6:.4g} ms apart"
    return "ns", f"rows are then {period * 1e-6:.4g} ms apart"


def can_be_longer(values: Floats) -> bool:
    """Whether times, shape (K,), may be in a longer unit than the guessed one: nothing but their rows tells it."""
    return not since_1970(values) and not _are_ticks(values)


def _are_ticks(values: Floats) -> bool:
    """Whether times, shape (K,), are whole ticks of 4 us, as those of an Arduino's micros().

    No loop keeps to every fourth millisecond by steps that vary.
    """
    if len(values) < FEWEST_STAMPS or np.any(values % TICK) or np.max(np.abs(values)) >= 2.0**53:
        return False
    steps = np.unique(np.diff(values))
    steps = steps[steps > 0.0]
    if len(steps) < KINDS or row_period(values) < TICKS_APART * TICK:
        return False
    return bool(np.gcd.reduce(steps.astype(np.int64)) == TICK)


def row_period(values: Floats) -> float:
    """The median of the steps forward; 0 without one."""
    steps = np.diff(values)
    forward = steps[steps > 0.0]
    return float(np.median(forward)) if len(forward) else 0.0


def find_clock(columns: Mapping[str, Floats]) -> str | None:
    """Find the column, of several by name, whose values of shape (K,) are most like times; None where none can be.

    A motor's angle may go on as times do, but not from the first row on, and not so evenly. At one voltage it is as
    even as the clock: then the first rows tell it, in which a motor that stood has to get going.
    """
    able = {name: values for name, values in columns.items() if runs_forward(values)}
    able = {
        name: values for name, values in able.items() if not any(_gets_going(values, one) for one in able.values())
    } or able
    return min(able, key=lambda name: _unevenness(able[name]), default=None)


def _gets_going(values: Floats, clock: Floats) -> bool:
    """Whether values, shape (K,), are the angle of a motor that stood, by other ones taken for the clock.

    They go on by less in the first rows than later, and steadily at last.
    """
    count = len(values)
    places = ((0, min(FIRST_ROWS, count - 1)), (count // 2, 3 * count // 4), (3 * count // 4, count - 1))
    first, before, last = (_rate(values, clock, *place) for place in places)
    return first < SLOW * last and abs(before - last) < STEADY * last


def _rate(values: Floats, clock: Floats, begin: int, end: int) -> float:
    passed = float(clock[end] - clock[begin])
    return float(values[end] - values[begin]) / passed if passed > 0.0 else 0.0


def _unevenness(values: Floats) -> float:
    """Measure how far values, shape (K,), are beside a straight line, RMS in steps; late rows count for nothing.

    Of 3,500 simulated pairs of a clock and the counts of a motor at one voltage, 5 % are taken for one another; by the
    share of equal steps it were 21 %, as whole milliseconds are no more even than counts.
    """
    steps = np.diff(values)
    steps = steps[steps <= LATE * np.median(steps[steps > 0.0])]
    place, row = np.concatenate(([0.0], np.cumsum(steps))), np.arange(len(steps) + 1.0)
    rest = place - np.polyval(np.polyfit(row, place, 1), row)
    with np.errstate(over="ignore"):  # a column of anything
        return float(np.std(rest) / max(np.mean(steps), 1e-300))


def runs_forward(values: Floats) -> bool:
    """Whether values, shape (K,), can be times: they go on in nearly every row, by about equal steps.

    Where they go on in all of them, as a clock with many digits does, a fifth of the rows may be late.
    """
    steps = np.diff(values)
    if len(steps) < 3 or np.mean(steps >= 0.0) < 0.95 or np.mean(steps > 0.0) < 0.5:
        return False
    forward = steps[steps > 0.0]
    most = 0.9 if len(forward) < len(steps) else 0.8
    return bool(np.quantile(forward, most) <= 3.0 * np.quantile(forward, 0.1))
