"""Positions that wrap after a turn or at the size of a counter, and counters that are reset."""

from collections.abc import Callable
from dataclasses import replace
from math import tau

import numpy as np

from motor_identification.logs.form import CsvForm
from motor_identification.logs.rows.held import find_fresh_rows
from motor_identification.logs.signals import Bools, Floats, Integers, Signals
from motor_identification.measurement.sanity_checks import find_count_jump
from motor_model.errors import RecordingError

# Where counters and angles wrap, by unit: a turn, and the sizes of registers.
RANGES: dict[str, tuple[float, ...]] = {
    "rad": (tau,),
    "deg": (360.0,),
    "rev": (1.0,),
    "count": (256.0, 1024.0, 2048.0, 4096.0, 8192.0, 16384.0, 65536.0, 2.0**32),
}
SLACK = 1.02  # of its range: how far values may reach that wrap there (a turn of 6.3 rad)
REACHED = 0.75  # of its range that values have to cover, before they are said to wrap at it
USUAL = 3.0  # times the largest other step by which an unwrapped one may differ from 0
AMBIGUOUS = 0.45  # of its range: a step that is nearly half of it could be one the other way
FIRST_STEPS, FAR = 5, 10.0  # steps after a run's first, which is wrong where it is so many times each of them
MOST_JUMPS = 8  # to somewhere else: as many are misread values or a potentiometer's gap, more are a range
SCRAP = 20  # rows between two jumps, below which they are no recording
BACK_STEPS = 1.5  # usual steps a row that the motor has gone on meanwhile
RESET_STEPS = 3.0  # usual steps from 0, or from a run's first value, within which a counter is said to be reset


def unwrap(signals: Signals, form: CsvForm) -> tuple[Signals, list[str]]:
    """Take the jumps out of positions that wrap, if they wrap at a turn, at a register's size or at the encoder's."""
    ranges = RANGES.get(form.unit, ())
    if form.unit == "count" and form.edges_per_revolution:
        ranges = (float(form.edges_per_revolution), *ranges)
    if form.wrap is not None:
        ranges = (form.wrap,)
    for size in ranges:
        unwrapped = signals.motion.copy()
        jumps = 0
        for run in signals.runs.values():
            unwrapped[run], number = _without_jumps(signals.motion[run], size)
            jumps += number
        if jumps:
            _check_wraps(signals, unwrapped, form, size)
            said = f"{form.motion} wraps at {size:.6g} {form.unit} ({jumps} times): unwrapped."
            return replace(signals, motion=unwrapped), [said]
    return signals, []


def _check_wraps(signals: Signals, unwrapped: Floats, form: CsvForm, size: float) -> None:
    """Refuse positions that go nearly half their range from one value to the next: which way, nobody can tell.

    Raises:
        RecordingError: they do.
    """
    farthest = max(float(np.max(np.abs(np.diff(unwrapped[run])))) for run in signals.runs.values())
    share = farthest / size
    if share > AMBIGUOUS:
        raise RecordingError(
            f"{signals.path}: {form.motion} wraps at {size:.6g} {form.unit}, and goes by up to {share:.2f} of "
            "that from one value to the next, so that its direction is open: log it faster, or unwrapped."
        )


def _without_jumps(values: Floats, size: float) -> tuple[Floats, int]:
    """The values without jumps of a range's size, and how many there were; none unless all of it fits."""
    step = np.diff(values)
    jump = np.abs(step) > 0.5 * size
    span = float(np.ptp(values))
    if not jump.any() or not REACHED * size < span <= SLACK * size:
        return values, 0
    mended = step - size * np.rint(step / size)
    usual = float(np.max(np.abs(step[~jump]), initial=0.0))
    if np.max(np.abs(mended[jump])) > USUAL * max(usual, 0.01 * size):
        return values, 0
    turns = np.concatenate(([0.0], np.cumsum(np.where(jump, -np.rint(step / size), 0.0))))
    return values + size * turns, int(jump.sum())


def split_at_resets(
    signals: Signals, form: CsvForm, count_of: Callable[[Floats], Integers]
) -> tuple[Signals, list[str]]:
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
    whole, begins = signals, _mark_wrong_first_rows(signals, count_of)
    left_out = int(begins.sum())
    signals = whole.split(begins)
    resets = 0
    tops: list[float] = []
    jumps: list[int] = []  # lines
    while (row := _first_jump(signals, count_of)) is not None:
        run = next(run for run in signals.runs.values() if run.start < row < run.stop)
        motion = signals.motion
        usual = float(np.quantile(np.abs(np.diff(motion[run])), 0.9))
        near, right = RESET_STEPS * usual, row
        if min(abs(motion[row]), abs(motion[row] - motion[run.start])) <= near:
            if any(abs(top - motion[row - 1]) <= near for top in tops):
                raise _wrapped(signals, form, row, "and not for the first time")
            tops.append(float(motion[row - 1]))
            resets += 1
        else:
            right = _row_back(motion, row, run.stop, usual)
            jumps.append(int(signals.lines[row]))
            if len(jumps) > MOST_JUMPS:
                raise _wrapped(signals, form, row, f"as in more than {MOST_JUMPS} places")
        begins[np.searchsorted(whole.lines, signals.lines[[row, right]])] = True
        signals = whole.split(begins)
    said = [f"{form.motion} is reset {resets} times: {len(signals.runs)} runs, a bag each."] if resets else []
    if left_out:
        said.insert(0, f"Left out: {left_out} first rows, whose {form.motion} is that of something before.")
    if jumps:
        signals = _without_scraps(signals)
        said.append(_about_jumps(signals, form, jumps))
    return signals, [line.replace(" 1 times", " once").replace("1 first rows", "1 first row") for line in said]


def _mark_wrong_first_rows(signals: Signals, count_of: Callable[[Floats], Integers]) -> Bools:
    """Mark the second rows (K,) of runs whose first is far from it, as it is from nothing that follows."""
    begins = np.zeros(len(signals), np.bool_)
    counts = count_of(signals.motion)
    for run in signals.runs.values():
        steps = np.abs(np.diff(counts[run])).astype(np.float64)
        if len(steps) > FIRST_STEPS and steps[0] > FAR * max(np.max(steps[1 : 1 + FIRST_STEPS]), 1.0):
            begins[run.start + 1] = steps[0] > np.max(steps[1:])
    return begins


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


def _about_jumps(signals: Signals, form: CsvForm, lines: list[int]) -> str:
    where = ", ".join(str(line) for line in sorted(lines))
    return (
        f"Caution: {form.motion} jumps {len(lines)} times, at line {where}, further than the motor goes: "
        f"{len(signals.runs)} runs, a bag each (where it wraps: --wrap R)."
    )


def _first_jump(signals: Signals, count_of: Callable[[Floats], Integers]) -> int | None:
    counts = count_of(signals.motion)
    for run in signals.runs.values():
        rows, _ = find_fresh_rows(signals.time[run], counts[run].astype(np.float64))
        rows = rows + run.start
        time = (signals.time[rows] - signals.time[run.start]) * 1e-9
        jump = find_count_jump(time, counts[rows], signals.voltage[rows])
        if jump is not None:
            return int(rows[jump])
    return None


def _wrapped(signals: Signals, form: CsvForm, row: int, how: str) -> RecordingError:
    before, here = (f"{signals.motion[k]:.9g}" for k in (row - 1, row))
    return RecordingError(
        f"{signals.path}, line {signals.lines[row]}: {form.motion} jumps from {before} to {here}, {how}: say where it "
        "wraps (--wrap R)."
    )
