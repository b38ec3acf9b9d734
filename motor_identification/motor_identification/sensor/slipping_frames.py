"""Find the frames of held samples whose clock slips against that of the log, so that they lie on no even grid.

What is certain then is the value: one that stays for several rows and changes by many of its smallest steps was not
read in between. When it was made is known to a row or so: the middle of the changes around, less whole periods.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.recording import Bools, Floats, Integers

MANY = 8.0  # smallest steps by which typical changes differ: what turns by so much within rows does not stay for them
FEWEST = 20  # changes that tell
LEVELS = 12  # different changes: a speed that was computed from a few counts has few, whatever rows it is held for
SHORTEST = 3.5  # rows in a frame: a row more or less is half of shorter ones, and any change seems regular
REGULAR = 0.7  # share of the times between changes that are one frame, within a row
AROUND = 9  # changes whose middle says when one frame was made
MOVING = 3  # frames without a change, up to which the motor went on and frames were lost
# A frame that came late shows too short a way, and the next one makes up for it: shares of the usual rate.
SHORT, LONG, TOGETHER = 0.7, 1.4, 0.2


def find_slipping_frames(
    time: Floats, values: Floats, changed: Integers, guess: float
) -> tuple[Integers, Floats, float] | None:
    """Rows (F,), times (F,) [s] and period [s] of frames; None where values that stay are not held for certain.

    Args:
        time: [s] of the rows, shape (K,).
        values: of the same shape.
        changed: rows whose value differs from that before.
        guess: [s] about a frame.
    """
    change = np.abs(np.diff(values))[changed - 1]
    row = float(np.median(np.diff(time)))
    gaps = np.diff(time[changed])
    one = np.abs(gaps - guess) < 1.5 * row
    different = np.unique(change)
    if guess < SHORTEST * row or len(changed) < FEWEST or np.mean(one) < REGULAR or len(different) < LEVELS:
        return None
    if np.median(change) < MANY * min(different[0], float(np.min(np.diff(different)))):
        return None
    near = np.mean(gaps[one])  # of a guess that is a row short, the frames that took a row more are no others
    period = float(np.mean(gaps[np.abs(gaps - near) < 1.5 * row]))
    number = np.concatenate([[0.0], np.maximum(np.rint(gaps / period), 1.0).cumsum()])
    slip = time[changed] - number * period
    local = np.median(sliding_window_view(np.pad(slip, AROUND // 2, mode="edge"), AROUND), axis=1)
    made = local + number * period
    forward = made > np.maximum.accumulate(np.append(-np.inf, made[:-1]))
    changed, made, number = changed[forward], made[forward], number[forward]
    kept = ~mark_late_frames(made, values[changed])
    rows, made, number = changed[kept], made[kept], number[kept]
    return add_standstill(time, rows, made, number, period)


def mark_late_frames(made: Floats, values: Floats) -> Bools:
    """Mark frames (F,) that came late: a short way to them, a long one to the next, and the usual one over both."""
    late = np.zeros(len(values), np.bool_)
    if len(values) < 6:
        return late
    step, took = np.diff(values), np.diff(made)
    around = sliding_window_view(np.pad(step / took, 2, mode="edge"), 5)
    usual = np.median(around, axis=1)[1:]  # about each two steps
    before, after = step[:-1] / took[:-1], step[1:] / took[1:]
    both = (step[:-1] + step[1:]) / (took[:-1] + took[1:])
    way = np.sign(usual)
    before, after, both, usual = before * way, after * way, both * way, usual * way
    caught_up = (before >= 0.0) & (before < SHORT * usual) & (after > LONG * usual)
    late[1:-1] = caught_up & (np.abs(both - usual) < TOGETHER * usual)
    return late


def add_standstill(
    time: Floats, rows: Integers, made: Floats, number: Floats, period: float
) -> tuple[Integers, Floats, float]:
    """Add the frames of a standing motor to those (F,) with their numbers: between, before and after them."""
    first = number[0] - np.floor((made[0] - time[0]) / period)
    last = number[-1] + np.floor((time[-1] - made[-1]) / period)
    every = np.arange(first, last + 1.0)
    after = np.searchsorted(number, every)
    lost = np.diff(number, prepend=first - MOVING - 2, append=last + MOVING + 2)[after] <= MOVING + 1
    wanted = np.isin(every, number) | ~lost
    whole = np.interp(every, number, made)
    whole += period * (np.minimum(every - number[0], 0.0) + np.maximum(every - number[-1], 0.0))
    shown = np.minimum(np.searchsorted(time, whole), len(time) - 1)
    shown[np.isin(every, number)] = rows
    return shown[wanted].astype(np.int64), whole[wanted], period
