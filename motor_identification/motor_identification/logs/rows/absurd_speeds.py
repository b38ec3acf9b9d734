"""Leaves out what a speed's filter begins with: counts of the time before the log, over a step of no length."""

import numpy as np

from motor_identification.logs.signals import Bools, Floats, Signals

ABSURD = 100.0  # times the speed that nine of ten others do not exceed: no motor starts like that, and no pulse is that
USUAL = 0.9
FEWEST = 3  # rows: what is shorter is told as a wrong speed, wherever it stands
MOST = 0.2  # of the rows of a run: more of them are no accident


def drop_absurd_beginnings(signals: Signals) -> tuple[Signals, list[str]]:
    """Leave out the rows with which runs of speeds begin that are far beyond all others; and a finding that says so."""
    keep = np.ones(len(signals), np.bool_)
    for run in signals.runs.values():
        keep[run] = ~mark_absurd_beginning(signals.motion[run])
    if keep.all():
        return signals, []
    largest = float(np.max(np.abs(signals.motion[~keep])))
    usual = float(np.max(np.abs(signals.motion[keep])))
    return signals.only(keep), [
        f"Left out: the first {int((~keep).sum())} rows, whose speeds are up to {largest:.3g} where all others are up "
        f"to {usual:.3g}, as of a filter that began with garbage."
    ]


def mark_absurd_beginning(speed: Floats) -> Bools:
    """Mark the first speeds of a run, shape (K,): those far beyond the others, and as many as they take to fade.

    A filter that was filled with garbage forgets it at one rate: what takes it from the largest to that of a motor
    takes it from there to nothing.
    """
    marks = np.zeros(len(speed), np.bool_)
    size = np.abs(speed)
    if len(speed) < FEWEST or not np.any(size):
        return marks
    usual = float(np.quantile(size[int(MOST * len(size)) :], USUAL))
    far = np.flatnonzero(size > ABSURD * usual)
    if usual == 0.0 or len(far) < FEWEST or far[-1] >= MOST * len(speed):
        return marks
    within = np.flatnonzero(size[far[-1] :] <= usual)
    end = far[-1] + (int(within[0]) if len(within) else 0)
    peak = int(np.argmax(size[: end + 1]))
    marks[: min(2 * end - peak, len(speed))] = True
    return marks
