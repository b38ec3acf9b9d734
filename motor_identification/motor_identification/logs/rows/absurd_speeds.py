"""Leaves out what speeds begin with that is of the time before the log, and what a sensor shows of a motor at rest.

A filter begins with counts over a step of no length; a program with the latest values of the run before. What measures
the time between edges shows a rest by the longest time that it waits for one, and never by 0.
"""

from dataclasses import replace

import numpy as np

from motor_identification.logs.signals import Bools, Floats, Signals

ABSURD = 100.0  # times the speed that nine of ten others do not exceed: no motor starts like that, and no pulse is that
USUAL = 0.9
FEWEST = 3  # rows: what is shorter is told as a wrong speed, wherever it stands
FAR, AFTER = 10.0, 3  # times the speeds of so many rows after it, and the steps of their drive, is a first one
REST, FEWEST_AT_REST = 0.05, 20  # of the next larger size, up to which one alone is that of a rest; and rows of it
MOST = 0.2  # of the rows of a run: more of them are no accident


def take_rest_for_zero(signals: Signals) -> tuple[Signals, list[str]]:
    """Take the one size of speeds far below all others, with which runs begin undriven, for 0 where none is 0."""
    sizes, rows = np.unique(np.abs(signals.motion), return_counts=True)
    if len(sizes) < 2 or not 0.0 < sizes[0] < REST * sizes[1] or rows[0] < FEWEST_AT_REST:
        return signals, []
    at_rest = np.abs(signals.motion) == sizes[0]
    if (
        not all(at_rest[run.start] for run in signals.runs.values())
        or np.median(np.abs(signals.voltage[at_rest])) > 0.0
    ):
        return signals, []
    said = f"Speeds of {sizes[0]:.4g}, in {rows[0]} rows, are those of a standing motor, as no other is that small: 0."
    return replace(signals, motion=np.where(at_rest, 0.0, signals.motion)), [said]


def drop_absurd_beginnings(signals: Signals) -> tuple[Signals, list[str]]:
    """Leave out the rows with which runs of speeds begin that are far beyond all others; and a finding that says so."""
    stale = np.zeros(len(signals), np.bool_)
    for run in signals.runs.values():
        stale[run.start] = is_of_run_before(signals.motion[run], signals.voltage[run])
    signals, said = signals.only(~stale), []
    if number := int(stale.sum()):
        rows = "the first row" if number == 1 else f"{number} first rows"
        said.append(f"Left out: {rows}, with the speed and the drive of a run before, as the motor stands right after.")
    keep = np.ones(len(signals), np.bool_)
    for run in signals.runs.values():
        keep[run] = ~mark_absurd_beginning(signals.motion[run])
    if keep.all():
        return signals, said
    largest = float(np.max(np.abs(signals.motion[~keep])))
    usual = float(np.max(np.abs(signals.motion[keep])))
    return signals.only(keep), [
        *said,
        f"Left out: the first {int((~keep).sum())} rows, whose speeds are up to {largest:.3g} where all others are up "
        f"to {usual:.3g}, as of a filter that began with garbage.",
    ]


def is_of_run_before(speed: Floats, voltage: Floats) -> bool:
    """Whether the first row, of speeds and drives of shape (K,), is the latest of a run before.

    The motor stands right after it, and moves off under a drive that goes on from elsewhere. Measured: of a sine that
    rose from 0, whose first row was the end of the one before: its voltages seemed to have held until their rows.
    """
    if len(speed) <= AFTER + 1 or not np.any(speed[1:]):
        return False
    stands = abs(float(speed[0])) > FAR * float(np.max(np.abs(speed[1 : AFTER + 1])))
    steps = np.abs(np.diff(voltage[: AFTER + 2]))
    return stands and float(steps[0]) > FAR * float(np.max(steps[1:]))


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
