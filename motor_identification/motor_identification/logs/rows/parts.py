"""Rows of a log that belong together: by a column, where time begins again, where rows are missing."""

import re
from collections.abc import Container
from decimal import Decimal
from itertools import count, groupby

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.logs.columns.behaviour.edge_times import counts_on
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import CsvForm
from motor_identification.logs.rows.bursts import spread_bursts
from motor_identification.logs.signals import Bools, Floats, Integers, Signals
from motor_model.errors import RecordingError

GAP = 20.0  # sample periods without a row: what was commanded meanwhile is not known any more
AROUND = 21  # rows whose steps tell the sample period where a board became slow, as by the interrupts of its encoder
BURSTS, FEWEST_ROWS = 10, 20  # gaps, and rows between them: so many short pieces are no recordings
COMPUTERS = 10**18  # [ns] since 1970, in 2001: a later clock is a computer's
LATE = 5.0  # sample periods from the first row to the second: it was logged before the recording began
MOST_RUNS = 1000  # bags that one log may become; a column that is none to split by makes more


def split_by_column(table: Table, split: str | None) -> dict[str, slice]:
    """Rows that belong together, by label: a new run wherever the split column changes.

    Raises:
        RecordingError: a run of a single row, or too many runs.
    """
    runs: dict[str, slice] = {}
    start = 0
    column = table.column(split) if split else [b""] * len(table)
    for _, rows in groupby(column):
        stop = start + len(list(rows))
        value = table.text(split, start) if split else ""
        if stop - start < 2:
            raise RecordingError(
                f"{table.path}, line {table.lines[start]}: the run with {split} = {value} has a single row, "
                "and at least 2 are needed: correct or remove that line."
            )
        if len(runs) == MOST_RUNS:
            raise RecordingError(
                f"{table.path}: {split} changes more than {MOST_RUNS} times: give --split a column that changes "
                "between runs only."
            )
        runs[_label(value, runs)] = slice(start, stop)
        start = stop
    return runs


def _label(value: str, taken: Container[str]) -> str:
    """The value fit for a file name; a value that comes again gets a number."""
    label = re.sub(r"[^\w.+-]", "_", value)[:80]
    if label not in taken:
        return label
    return next(name for number in count(2) if (name := f"{label}_{number}") not in taken)


def split_at_restarts(signals: Signals, form: CsvForm) -> tuple[Signals, list[str]]:
    """Begin a run wherever time runs backwards.

    Raises:
        RecordingError: it does so all the time.
    """
    back = _inside(signals, np.diff(signals.time, prepend=signals.time[:1]) < 0)
    if not back.any():
        return signals, []
    number = int(back.sum())
    lost = _lost_order(signals, back)
    if lost is not None or number >= MOST_RUNS:
        row = int(np.argmax(back)) if lost is None else lost
        before, here = (_say_seconds(int(signals.time[k])) for k in (row - 1, row))
        raise RecordingError(
            f"{signals.path}, line {signals.lines[row]}: time runs backwards ({form.time} is {here} s after "
            f"{before}), and does not begin again: name the column of times with --time, or correct that line."
        )
    parts = signals.split(back)
    said = f"{form.time} begins again {_times(number)}: {_bags(parts)}{_alone(signals, parts)}."
    return name_by_voltage(parts), [said]


def _say_seconds(nanoseconds: int) -> str:
    """Say a time [ns] in s with all its digits: of seconds since 1970 ten are no more than the whole ones."""
    return f"{Decimal(nanoseconds).scaleb(-9).normalize():f}"


def _lost_order(signals: Signals, back: Bools) -> int | None:
    """The first row at which time steps back by less than half of its run: rows out of order are no new beginning."""
    for run in signals.runs.values():
        start = run.start
        for row in np.flatnonzero(back[run]) + run.start:
            elapsed = signals.time[row - 1] - signals.time[start]
            if 2 * (signals.time[row - 1] - signals.time[row]) <= elapsed:
                return int(row)
            start = int(row)
    return None


def split_at_gaps(signals: Signals) -> tuple[Signals, list[str]]:
    """Begin a run after every gap in the rows."""
    steps = np.diff(signals.time, prepend=signals.time[:1])
    gap = _inside(signals, steps > GAP * _period(signals))
    if gap.any():
        gap[gap] = steps[gap] > GAP * _periods_around(steps, np.flatnonzero(gap))
    if not gap.any():
        return signals, []
    spread, said = spread_bursts(signals, gap)
    if said:
        return spread, said
    number = int(gap.sum())
    short = number >= BURSTS and len(signals) < FEWEST_ROWS * (number + 1)
    if short:
        _check_clock(signals, number)
    if short or number >= MOST_RUNS:
        return signals, [f"Caution: {number} gaps of more than {GAP:g} sample periods; none is cut out."]
    lost = float(steps[gap].sum()) * 1e-9
    parts = signals.split(gap)
    if not parts.runs:
        return signals, []
    missing = f"Rows are missing {_times(int(gap.sum()))} ({lost:.3g} s in all): {_bags(parts)}"
    return parts, [f"{missing}{_alone(signals, parts)}."]


def _check_clock(signals: Signals, gaps: int) -> None:
    """Refuse a computer's stamps of rows that came in bursts: they tell when a link handed them on.

    Raises:
        RecordingError: the stamps count from 1970; a board's own clock tells of pauses that there were.
    """
    if np.median(signals.time) < COMPUTERS:
        return
    rows, even = len(signals) / (gaps + 1), float(signals.steps().mean()) * 1e-9
    raise RecordingError(
        f"{signals.path}: rows come in bursts, about {rows:.2g} at a time, as a link hands them on that stores them: "
        f"their times tell nothing. Say how far rows are apart: --sample-period S ({even:.3g} s on average)."
    )


def drop_first_rows(signals: Signals) -> tuple[Signals, list[str]]:
    """Leave out the first row of a run that was logged long before the second.

    Not where rows come with the counts: a motor that stood takes long to its first one.
    """
    keep = np.ones(len(signals), np.bool_)
    limit = LATE * _period(signals)
    for run in signals.runs.values():
        late = run.stop - run.start > 2 and signals.time[run.start + 1] - signals.time[run.start] > limit
        keep[run.start] = not late or counts_on(signals.motion[run]) or counts_on(-signals.motion[run])
    dropped = int((~keep).sum())
    if not dropped:
        return signals, []
    which = "the first row" if dropped == 1 else f"the first rows of {dropped} runs"
    return signals.only(keep), [f"Left out: {which}, logged more than {LATE:g} sample periods before the second."]


def _period(signals: Signals) -> float:
    """[ns] the median step, of those that are not 0."""
    steps = signals.steps()
    forward = steps[steps > 0]
    return float(np.median(forward)) if len(forward) else 0.0


def _periods_around(steps: Integers, rows: Integers) -> Floats:
    """[ns] the median of the steps, shape (K,), around each of some rows (L,)."""
    padded = np.pad(steps, AROUND // 2, mode="edge")
    return np.asarray(np.median(sliding_window_view(padded, AROUND)[rows], axis=1))


def _inside(signals: Signals, marks: Bools) -> Bools:
    """Marks on all rows but the first of each run."""
    inside = marks.copy()
    inside[[run.start for run in signals.runs.values()]] = False
    return inside


def name_by_voltage(signals: Signals) -> Signals:
    """Name runs of one voltage each by it, if no two have the same."""
    levels = [np.unique(signals.voltage[run][: run.stop - run.start]) for run in signals.runs.values()]
    if any(len(level) != 1 for level in levels):
        return signals
    names = [f"{level[0]:.4g}V" for level in levels]
    if len(set(names)) < len(names):
        return signals
    return Signals(**{**signals.__dict__, "runs": dict(zip(names, signals.runs.values(), strict=True))})


def _alone(before: Signals, after: Signals) -> str:
    """Say which rows are left out, as they are alone in their run."""
    lost = len(before) - len(after)
    rows = "1 row that stands alone is" if lost == 1 else f"{lost} rows that stand alone are"
    return f" ({rows} left out)" if lost else ""


def _bags(parts: Signals) -> str:
    return "1 run" if len(parts.runs) == 1 else f"{len(parts.runs)} runs, a bag each"


def _times(number: int) -> str:
    return {1: "once", 2: "twice"}.get(number, f"{number} times")


def check_rest(signals: Signals, table: Table, form: CsvForm) -> None:
    """Refuse a run that begins before the motor's rest ends.

    Raises:
        RecordingError: one does.
    """
    if form.rest_until is None:
        return
    for run in signals.runs.values():
        if signals.time[run.start] < round(form.rest_until * 1e9):
            raise RecordingError(
                f"{table.path}, line {signals.lines[run.start]}: the run begins at {form.time} = "
                f"{signals.time[run.start] * 1e-9:g} s, before --rest-until {form.rest_until:g}: that option is "
                "for rows that begin after the first voltage was applied."
            )


def check_steps(signals: Signals) -> Integers:
    """Time from row to row inside runs [ns], all positive.

    Raises:
        RecordingError: there are none.
    """
    if not signals.runs:
        raise RecordingError(f"{signals.path}: no run has two rows at different times: check --time.")
    return signals.steps()
