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
AMBIGUOUS = 0.45  # of its range: a step that is nearly half of it could be one the other way


def find_wrap(values: Floats, unit: str, edges: int | None) -> float:
    """Find where values of one run, shape (K,), wrap: at a turn of so many edges, or a register's size; else 0."""
    return next((size for size in _list_ranges(unit, edges) if _without_jumps(values, size)[1]), 0.0)


def _list_ranges(unit: str, edges: int | None) -> tuple[float, ...]:
    ranges = RANGES.get(unit, ())
    return (float(edges), *ranges) if unit == "count" and edges else ranges


def unwrap(signals: Signals, form: CsvForm) -> tuple[Signals, list[str]]:
    """Take the jumps out of positions that wrap, if they wrap at a turn, at a register's size or at the encoder's."""
    ranges = _list_ranges(form.unit, form.edges_per_revolution) if form.wrap is None else (form.wrap,)
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
