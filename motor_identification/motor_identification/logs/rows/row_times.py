"""Times of rows that have none: so many seconds from row to row, where the user or a column says so."""

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.clock import are_days, read_clock
from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.vocabulary import Quantity
from motor_identification.logs.csv.table import GARBLED, Table

_STEP = frozenset({"dt", "δt", "deltat", "deltatime", "timestep", "timedelta"})
_RATES = frozenset(
    {"fs", "fsample", "samplerate", "samplingrate", "samplefrequency", "samplingfrequency", "freqsample"}
)
_PERIODS = frozenset(
    {"ts", "te", "tsample", "tsamp", "sampletime", "samplingtime", "sampleperiod", "samplingperiod", "abtastzeit"}
)
_PERIOD = (1e-5, 1.0)  # [s] that rows of a motor's log are apart
LONGEST = 5.0  # times the shortest of nine in ten steps, which the longest of them are at most

_PERIOD_IN_NAME = re.compile(
    r"[(\[,;]?\s*\b(?P<word>dt|ts|t_s)\s*[=:]\s*(?P<size>\d+\.?\d*|\.\d+)\s*(?P<unit>m?s|us|)\s*[)\]]?$", re.I
)
_WORDS = re.compile(r"[^\W_\d]+|\d+")
_SECONDS, _NANOSECONDS = frozenset({"sec", "secs", "seconds"}), frozenset({"nanosec", "nsec", "nsecs", "nanoseconds"})
SAME_PERIOD = 1e-3  # of it, within which `Ts` and `fs` beside each other are one
ROW_TIMES = "(row times)"  # column: where a row stands, and then when it was


def number_rows(table: Table) -> Table:
    """Add a column of where each row stands, before any is left out."""
    return replace(table, cells={**table.cells, ROW_TIMES: np.arange(len(table), dtype=np.int64)})


def give_times(table: Table, period: float) -> Table:
    """Turn the places of rows into times [ns], `period` [s] apart; the first row left is at 0."""
    place: NDArray[np.int64] = np.asarray(table.column(ROW_TIMES), dtype=np.int64)
    time = np.rint(np.abs(place - place[:1]) * (period * 1e9)).astype(np.int64)
    return replace(table, cells={**table.cells, ROW_TIMES: time})


def write_times_in_seconds(table: Table) -> Table:
    """Write times that are dates in days, or seconds and nanoseconds in two columns, as one column of a usual unit."""
    return _join_nanoseconds(_count_from_first_day(table))


def _count_from_first_day(table: Table) -> Table:
    """Turn days, as spreadsheets and MATLAB count them, into seconds since the first row."""
    for name in table.names:
        heading = read_heading(name)
        if heading.quantity is not Quantity.TIME or heading.unit or not bool(np.all(table.readable(name))):
            continue
        values = read_clock(table, name)
        if are_days(values):
            said = f"{name} is in days, as spreadsheets and MATLAB count them: seconds since the first row are taken."
            cells = {**table.cells, name: np.round((values - values[0]) * 86_400.0, 6)}
            return replace(table, cells=cells, notes=(*table.notes, said))
    return table


def _join_nanoseconds(table: Table) -> Table:
    """Make one column of `stamp.sec` and `stamp.nanosec`, as tools write the stamps of ROS messages."""
    words = {name: tuple(_WORDS.findall(name.lower())) for name in table.names}
    for name, own in words.items():
        fine = next((one for one in own if one in _NANOSECONDS), None)
        rest = tuple(word for word in own if word != fine)
        pairs = [one for one, other in words.items() if other[-1:] and _is_seconds_of(other, rest)] if fine else []
        columns = (*pairs, name)
        if len(pairs) != 1 or not all(bool(np.all(table.readable(one))) for one in columns):
            continue
        seconds, nanoseconds = (table.numbers(one) for one in columns)
        if np.any(seconds % 1.0) or np.any(nanoseconds % 1.0) or np.any((nanoseconds < 0.0) | (nanoseconds >= 1e9)):
            continue
        joined = np.rint(seconds).astype(np.int64) * 10**9 + np.rint(nanoseconds).astype(np.int64)
        others = {one: other for one, other in table.cells.items() if one not in columns}
        cells = {f"{'.'.join(rest) or 'time'} [ns]": joined, **others}
        said = f"Times are {pairs[0]} and {name} together."
        return replace(table, cells=cells, notes=(*table.notes, said))
    return table


def _is_seconds_of(words: tuple[str, ...], rest: tuple[str, ...]) -> bool:
    """Whether a column's words are those of another's, with seconds for nanoseconds."""
    return any(word in _SECONDS and tuple(one for one in words if one != word) == rest for word in words)


def sum_steps(table: Table) -> Table:
    """Add a column of times where there is none, and one says by its name how long every row took: `dt`, `delta_t_ms`.

    Such a column has about the same value in all rows, above 0, but for the first, which is at 0 and may say so; one
    that grows from row to row is a clock. Rows that are left out later keep their time.
    """
    headings = [read_heading(name) for name in table.names]
    if any(one.quantity is Quantity.TIME and not _STEP & _joined(one) for one in headings):
        return table
    named = [one for one in headings if _STEP & _joined(one)]
    if len(named) != 1:
        return table
    (step,) = named
    readable = table.readable(step.name)
    good = np.flatnonzero(readable)
    if len(good) < max(2, (1.0 - GARBLED) * len(readable)):
        return table
    values = np.full(len(readable), np.nan)
    values[good] = table.rows(good, "").numbers(step.name)
    steps = np.where(readable, values, np.median(values[good]))[1:]  # a garbled row took as long as most
    if not np.all(steps > 0.0) or _is_clock(steps):
        return table
    if np.quantile(steps, 0.9) > LONGEST * np.quantile(steps, 0.1):
        return table
    unit = f" [{step.unit}]" if step.unit else ""
    time = np.concatenate([[0.0], np.cumsum(steps)])
    cells = {name: cells for name, cells in table.cells.items() if name != step.name}
    note = (
        f"No column of times: they are summed from {step.name}, how long after the one before each row was (assumed)."
    )
    return replace(table, cells={f"time{unit}": time, **cells}, notes=(*table.notes, note))


def take_periods_out(table: Table) -> Table:
    """Take `dt = 10 ms` out of a column's name, `rpm (dt=10ms)`, and give it a column where there is none of times.

    One that is called so and has no cells is that column. Without a unit whole numbers are milliseconds, as nobody logs
    a motor so many seconds apart.
    """
    timed = any(read_heading(name).quantity is Quantity.TIME for name in table.names if not _tells_period(name))
    cells: dict[str, Sequence[str] | NDArray[Any]] = {}
    for name, column in table.cells.items():
        match, bare = _tells_period(name), _PERIOD_IN_NAME.sub("", name).strip()
        if match is None or bare in table.cells or (not bare and table.readable(name).any()):
            cells[name] = column
            continue
        if bare:
            cells[bare] = column
        if not timed:
            unit = match["unit"].lower() or ("ms" if float(match["size"]) >= 1.0 else "s")
            cells[f"{match['word']} [{unit}]"] = np.full(len(table), float(match["size"]))
    return replace(table, cells=cells)


def _tells_period(name: str) -> re.Match[str] | None:
    return _PERIOD_IN_NAME.search(name)


def tells_how_often(name: str) -> bool:
    """Whether a name is that of a sampling rate or period: `Fs`, `Ts`, `sample_rate`, `dt`."""
    return bool((_RATES | _PERIODS | _STEP) & _joined(read_heading(name)))


def space_evenly(table: Table) -> Table:
    """Add a column of times where there is none, and one, or its first cell alone, says how often rows came: `fs`."""
    headings = [read_heading(name) for name in table.names]
    periods = {one: _period(table, one) for one in headings if tells_how_often(one.name)}
    told = [one for one, period in periods.items() if period is not None]
    others = [one for one in headings if one not in told]
    if not told or any(one.quantity is Quantity.TIME for one in others):
        return table
    period = periods[told[0]] or 0.0
    if any(abs((periods[one] or 0.0) - period) > SAME_PERIOD * period for one in told):
        return table
    time = np.arange(len(table)) * period
    note = f"No column of times: rows are {period * 1e3:.6g} ms apart, as {told[0].name} says (assumed)."
    cells = {"time [s]": time, **{one.name: table.column(one.name) for one in others}}
    return replace(table, cells=cells, notes=(*table.notes, note))


def _period(table: Table, heading: Heading) -> float | None:
    """The seconds between rows that a column of one value says; None where it has several, or says none."""
    good = np.flatnonzero(table.readable(heading.name))
    values = table.rows(good, "").numbers(heading.name) if len(good) else np.zeros(0)
    if not len(values) or np.ptp(values) > 0.0 or values[0] <= 0.0:
        return None
    size = float(values[0])
    period = 1.0 / size if _RATES & _joined(heading) else size * {"ms": 1e-3, "us": 1e-6}.get(heading.unit, 1.0)
    return period if _PERIOD[0] <= period <= _PERIOD[1] else None


def _is_clock(values: NDArray[np.float64]) -> bool:
    """Whether values, shape (K,), are times, which go on and never back, or too few to tell."""
    return len(values) < 2 or bool(np.all(np.diff(values) >= 0.0) and values[-1] > values[0])


def _joined(heading: Heading) -> frozenset[str]:
    """The words of a name, alone and all together: `delta t` is `deltat`."""
    return frozenset((*heading.words, "".join(heading.words)))
