"""Positions that wrap after a turn or at the size of a counter."""

from dataclasses import replace
from math import tau

import numpy as np

from motor_identification.logs.form import CsvForm
from motor_identification.logs.signals import Floats, Signals
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
FEWEST_WRAPS = 2  # by which a range of its own is told: a single jump may be a counter's reset
GOES_ON = 0.5  # of the step before a wrap, within which that behind it is: after a reset a motor may stand
ALIKE = 0.01  # of a range, within which it comes out of each of its wraps
AMBIGUOUS = 0.45  # of its range: a step that is nearly half of it could be one the other way


def find_wrap(values: Floats, unit: str, edges: int | None) -> float:
    """Find where values of one run, shape (K,), wrap: at a turn of so many edges, or a register's size; else 0."""
    return next((size for size in _list_ranges(unit, edges) if _without_jumps(values, size)[1]), 0.0)


def _list_ranges(unit: str, edges: int | None) -> tuple[float, ...]:
    ranges = RANGES.get(unit, ())
    return (float(edges), *ranges) if unit == "count" and edges else ranges


def find_own_range(values: Floats) -> float:
    """Find a range of a position's own in one run, shape (K,), where it wraps again and again as the motor goes on.

    Each jump is the range less the step that the motor went meanwhile, which is that of the rows about it. Returns 0
    where there are fewer than two jumps, where they differ, or where the motor does not go on: a counter that was
    reset begins anew.
    """
    step = np.diff(values)
    jumps = np.flatnonzero(np.abs(step) > 0.5 * float(np.ptp(values)))
    jumps = jumps[(jumps > 0) & (jumps < len(step) - 1)]
    if len(jumps) < FEWEST_WRAPS:
        return 0.0
    before, behind = step[jumps - 1], step[jumps + 1]
    sizes = np.abs(step[jumps]) + 0.5 * np.abs(before + behind)
    size = float(np.median(sizes))
    goes_on = np.abs(behind - before) < GOES_ON * np.abs(before)
    against = step[jumps] * before < 0.0
    alike = np.abs(sizes - size) < ALIKE * size
    return size if bool(np.all(goes_on & against & alike)) else 0.0


def unwrap(signals: Signals, form: CsvForm) -> tuple[Signals, list[str]]:
    """Take the jumps out of positions that wrap, if they wrap at a turn, at a register's size or at the encoder's."""
    known = _list_ranges(form.unit, form.edges_per_revolution) if form.wrap is None else (form.wrap,)
    own = {find_own_range(signals.motion[run]) for run in signals.runs.values()} if form.wrap is None else set()
    for size in (*known, *sorted(own - {0.0})):
        unwrapped = signals.motion.copy()
        jumps = 0
        for run in signals.runs.values():
            unwrapped[run], number = _without_jumps(signals.motion[run], size)
            jumps += number
        if jumps:
            _check_wraps(signals, unwrapped, form, size)
            why = "" if size in known else "; assumed, as it jumps back while the motor goes on; otherwise: --wrap"
            said = f"{form.motion} wraps at {size:.6g} {form.unit} ({jumps} times{why}): unwrapped."
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
