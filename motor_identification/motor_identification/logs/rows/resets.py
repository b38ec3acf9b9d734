"""Counters that are reset, and positions that jump to somewhere else: a run ends there, and another begins."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np

from motor_identification.logs.form import CsvForm
from motor_identification.logs.rows.held import find_fresh_rows
from motor_identification.logs.signals import Bools, Floats, Integers, Signals
from motor_identification.measurement.sanity_checks import find_count_jump
from motor_model.errors import RecordingError

FIRST_STEPS, FAR = 5, 10.0  # steps after a run's first, which is wrong where it is so many times each of them
MOST_JUMPS = 8  # to somewhere else: as many are misread values or a potentiometer's gap, more are a range
SCRAP = 20  # rows between two jumps, below which they are no recording
BACK_STEPS = 1.5  # usual steps a row that the motor has gone on meanwhile
WHOLE = 0.01  # of a step, by which one may differ from whole ones
RESET_STEPS = 3.0  # usual steps from 0, or from a run's first value, within which a counter is said to be reset

ToCounts: TypeAlias = Callable[[Floats], Integers]


def split_at_resets(signals: Signals, form: CsvForm, count_of: ToCounts) -> tuple[Signals, list[str]]:
    """Begin a run wherever a counter is reset, to 0 or to the run's first value, or jumps to somewhere else.

    What is on either side of a jump is right, whatever made it: a value that was misread, a potentiometer's gap, a
    frame that came late. Many jumps, or two alike, are a range that nobody knows.

    Args:
        signals: rows with positions.
        form: what they are.
        count_of: converts them to counts.

    Raises:
        RecordingError: a position wraps at a size that is not known.
    """
    wrong = _find_wrong_first_rows(signals, count_of)
    signals, begins, breaks = signals.only(~wrong), np.zeros(int(np.count_nonzero(~wrong)), np.bool_), _Breaks(form)
    split = signals.split(begins)
    while (row := _first_jump(split, count_of)) is not None:
        begins[np.searchsorted(signals.lines, split.lines[breaks.add(split, row)])] = True
        split = signals.split(begins)
    said = []
    if number := int(np.count_nonzero(wrong)):
        rows = "1 first row" if number == 1 else f"{number} first rows"
        said.append(f"Left out: {rows}, whose {form.motion} is that of something before.")
    if breaks.tops:
        said.append(f"{form.motion} is reset {_times(len(breaks.tops))}: {len(split.runs)} runs, a bag each.")
    if breaks.lines:
        split = _without_scraps(split)
        said.append(_describe_jumps(split, form, breaks.lines))
    return split, said


@dataclass
class _Breaks:
    """Where positions break off, one after the other as they are found."""

    form: CsvForm
    tops: list[float] = field(default_factory=list)  # the last positions before resets
    lines: list[int] = field(default_factory=list)  # of jumps to somewhere else

    def add(self, signals: Signals, row: int) -> list[int]:
        """Take note of a break before a row; returns the rows at which runs begin for it.

        Raises:
            RecordingError: it is one of so many, or so like another, that the position wraps.
        """
        run = next(run for run in signals.runs.values() if run.start < row < run.stop)
        motion = signals.motion
        usual = float(np.quantile(np.abs(np.diff(motion[run])), 0.9))
        near = RESET_STEPS * usual
        if min(abs(motion[row]), abs(motion[row] - motion[run.start])) <= near:
            if any(abs(top - motion[row - 1]) <= near for top in self.tops):
                raise _wrapped(signals, self.form, row, "and not for the first time")
            self.tops.append(float(motion[row - 1]))
            return [row]
        self.lines.append(int(signals.lines[row]))
        if len(self.lines) > MOST_JUMPS:
            raise _wrapped(signals, self.form, row, f"as in more than {MOST_JUMPS} places")
        return [row, _row_back(motion, row, run.stop, usual)]


def _find_wrong_first_rows(signals: Signals, count_of: ToCounts) -> Bools:
    """Find the first row, or the first few in which it stands, of runs (K,) that are far from all that follows."""
    wrong = np.zeros(len(signals), np.bool_)
    counts = count_of(signals.motion)
    for run in signals.runs.values():
        steps = np.abs(np.diff(counts[run])).astype(np.float64)
        first = int(np.argmax(steps > 0.0))  # the step from this row to the next
        after = steps[first + 1 :]
        if (
            first + 1 < SCRAP
            and len(after) >= FIRST_STEPS
            and steps[first] > FAR * max(np.max(after[:FIRST_STEPS]), 1.0)
        ):
            wrong[run.start : run.start + first + 1] = steps[first] > np.max(after)
    return wrong


def _row_back(motion: Floats, row: int, stop: int, usual: float) -> int:
    """The row at which a value that was misread from `row` on is right again; `row`, where it does not come back."""
    beside = np.abs(motion[row : min(row + SCRAP, stop)] - motion[row - 1])
    back = np.flatnonzero(beside <= BACK_STEPS * usual * np.arange(1, len(beside) + 1))
    return row + int(back[0]) if len(back) else row


def _without_scraps(signals: Signals) -> Signals:
    """The runs but for the few rows between a jump and the next, unless all are such."""
    keep = np.zeros(len(signals), np.bool_)
    for run in signals.runs.values():
        keep[run] = run.stop - run.start >= SCRAP
    return signals.only(keep) if keep.any() else signals


def _describe_jumps(signals: Signals, form: CsvForm, lines: list[int]) -> str:
    where = ", ".join(str(line) for line in sorted(lines))
    return (
        f"Caution: {form.motion} jumps {_times(len(lines))}, at line {where}, further than the motor goes: "
        f"{len(signals.runs)} runs, a bag each (where it wraps: --wrap R)."
    )


def _first_jump(signals: Signals, count_of: ToCounts) -> int | None:
    counts = count_of(signals.motion)
    for run in signals.runs.values():
        rows, _ = find_fresh_rows(signals.time[run], counts[run].astype(np.float64))
        rows = rows + run.start
        time = (signals.time[rows] - signals.time[run.start]) * 1e-9
        jump = find_count_jump(time, _in_least_steps(counts[rows]), signals.voltage[rows])
        if jump is not None:
            return int(rows[jump])
    return None


def _in_least_steps(counts: Integers) -> Integers:
    """Count in the least step of a position, shape (K,): whole degrees are 360 counts a turn, however stored.

    As they are where the motor shows no single step: it never stands from row to row, or not all are multiples of one.
    """
    steps = np.abs(np.diff(counts))
    if not steps.any() or steps.all():
        return counts
    least = np.min(steps[steps > 0])
    parts = (counts - counts[0]) / least
    whole = np.rint(parts)
    return whole.astype(np.int64) if np.all(np.abs(np.diff(parts) - np.diff(whole)) < WHOLE) else counts


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"


def _wrapped(signals: Signals, form: CsvForm, row: int, how: str) -> RecordingError:
    before, here = (f"{signals.motion[k]:.9g}" for k in (row - 1, row))
    return RecordingError(
        f"{signals.path}, line {signals.lines[row]}: {form.motion} jumps from {before} to {here}, {how}: say where it "
        "wraps (--wrap R)."
    )
