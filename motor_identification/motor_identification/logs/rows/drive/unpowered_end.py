"""Leave out the end of a log in which a motor was driven and not powered: a fuse or its driver had switched it off."""

import numpy as np

from motor_identification.logs.form import CsvForm, Kind
from motor_identification.logs.rows.drive.constant_voltage import CONSTANT, STANDS
from motor_identification.logs.rows.drive.unpowered_start import (
    HALF,
    MOSTLY,
    ROWS,
    find_standing_voltage,
    list_advances,
    mark_motion,
)
from motor_identification.logs.signals import Bools, Floats, Signals

FEWEST = 5  # rows at rest under a voltage that did not change, so that no dead time explains them
EXPECTED = 20  # counts in them, had the motor run on
# How fast a motor ran: from which part of its rows on, and which quantile. One of which nobody logged when it was
# switched off may have run out for most of them.
HALFWAY, MOST = (0.5, 0.5), (0.0, 0.9)
RUNNING = 0.75  # of the speed at that voltage: below, it was coming to a stop
# Of the speed in the first third of a time at little voltage, that in the last one: of less it slows down. It runs on
# where it is to keep so much of the latter by how its slowing ends: elsewhere it runs out, as a servo that is there and
# as behind a bridge that coasts. Measured: to 0.1 of a servo in 40 rows; of a gearmotor's 9 counts a row 2 after 80.
KEEPS, SETTLES = 0.9, 0.5
AGAIN = " It runs again later: to have all of it, log the voltage, too."


def drop_unpowered_end(signals: Signals, form: CsvForm) -> tuple[Signals, list[str]]:
    """Leave out the last rows of runs in which the motor stands at voltages at half of which it ran before.

    So are those in which it comes to rest under one voltage that somebody said, of which no row says that it was on.
    """
    keep, said = np.ones(len(signals), np.bool_), []
    for run in signals.runs.values():
        volts, motion = np.abs(signals.voltage[run]), signals.motion[run]
        every, said_alone = len(volts), form.voltage == CONSTANT
        if said_alone and form.kind is Kind.SPEED:  # of which noise is no motion
            motion = np.where(np.abs(motion) > STANDS * np.max(np.abs(motion)), motion, 0.0)
        if said_alone and (again := _count_rows_until_restart(volts, motion, form.kind)):
            volts, motion = volts[:again], motion[:again]
        ran = _count_rows_until_rest(motion, form.kind)
        stood, kept = find_standing_voltage(volts[ran:]), ran + 1
        if stopped := _count_rows_until_stop(volts, motion, form.kind, ran, MOST if said_alone else HALFWAY):
            stood, kept = float(volts[-1]), stopped
        if stopped and said_alone:
            keep[run.start + kept : run.stop] = False
            said.append(
                f"Left out: the last {every - kept} rows, in which {form.motion} comes to rest under the "
                f"{stood:.3g} V that were said: the motor was switched off, or held (assumed)."
                + (AGAIN if len(volts) < every else "")
            )
            continue
        little = (volts[:ran] > 0.0) & (volts[:ran] <= HALF * stood)
        if np.count_nonzero(little) < ROWS or np.mean(mark_motion(motion, form.kind)[:ran][little]) < MOSTLY:
            continue
        if np.count_nonzero(little & _mark_running(volts[:ran], _travel(motion[:ran], form.kind), HALF * stood)) < ROWS:
            continue
        keep[run.start + kept : run.stop] = False
        said.append(
            f"Left out: the last {len(volts) - kept} rows, in which {form.motion} stands at up to {stood:.3g} V and "
            f"before which it ran at {HALF * stood:.3g} V and less: the motor was switched off, or held (assumed)."
        )
    return signals.only(keep), said


def _travel(motion: Floats, kind: Kind) -> Floats:
    """The way of each row, shape (K,), without its sign."""
    return np.abs(list_advances(motion, kind))


def _mark_running(volts: Floats, travel: Floats, most: float) -> Bools:
    """Mark the times, of rows (K,), of up to `most` volts, or of 0 V for a few rows, in which a motor does not run out.

    Where it slows down from third to third by ever less, as a lag does, they tell at which speed that ends.
    """
    little = (volts > 0.0) & (volts <= most)
    for begin, end in _list_times(volts == 0.0):
        if end - begin < FEWEST and little[begin - 1 : begin].any() and little[end : end + 1].any():
            little[begin:end] = True
    runs = np.zeros(len(volts), np.bool_)
    for begin, end in _list_times(little):
        if end - begin < FEWEST:
            continue
        first, middle, last = (float(np.mean(third)) for third in np.array_split(travel[begin:end], 3))
        bend = first + last - 2.0 * middle
        ends_at = (first * last - middle**2) / bend if bend > 0.0 else 0.0
        runs[begin:end] = last > 0.0 and (last >= KEEPS * first or ends_at >= SETTLES * last)
    return runs


def _list_times(marked: Bools) -> list[tuple[int, int]]:
    """List the times that are marked, of rows (K,): each from a row to before another."""
    edges = np.flatnonzero(np.diff(marked, prepend=False, append=False)).tolist()
    return list(zip(edges[::2], edges[1::2], strict=True))


def _count_rows_until_rest(motion: Floats, kind: Kind) -> int:
    """How many rows there are until a motor rests for good: its speeds, shape (K,), are 0, or its counts the last."""
    moves = motion != (0.0 if kind is Kind.SPEED else motion[-1])
    return int(np.flatnonzero(moves)[-1]) + 1 if moves.any() else 0


def _count_rows_until_restart(volts: Floats, motion: Floats, kind: Kind) -> int:
    """How many rows there are until a motor that had come to rest under its voltage moves again; 0 where it does not.

    A rest is as long as one at a log's end, and in it would have been as many counts.
    """
    speed = _travel(motion, kind)
    moves = (speed > 0.0) & (volts > 0.0)
    moved = speed[moves]
    if len(moved) < ROWS:
        return 0
    begin = int(np.flatnonzero(moves)[ROWS - 1])
    count = 0.0 if kind is Kind.SPEED else float(np.min(moved))
    fewest = max(ROWS, EXPECTED * count * len(speed[begin:]) / float(np.sum(speed[begin:])))
    edges = np.flatnonzero(np.diff(np.concatenate(([1.0], speed[begin:], [1.0])) > 0.0))
    long = [stop for start, stop in zip(edges[::2], edges[1::2], strict=True) if stop - start >= fewest]
    again = begin + int(long[0]) if long else len(volts)
    return again if again < len(volts) else 0


def _count_rows_until_stop(volts: Floats, motion: Floats, kind: Kind, ran: int, level: tuple[float, float]) -> int:
    """How many rows there are until a motor comes to rest though its voltage stays the same; 0 where it does not.

    A robot was told to stop, and its log went on with the last duty. level: from which part of those rows on, and which
    quantile of the speeds, is how fast it ran.
    """
    changes = np.flatnonzero(np.diff(volts))
    since = int(changes[-1]) + 1 if len(changes) else 0
    if volts[-1] == 0.0 or len(volts) - ran < FEWEST or ran - since < ROWS:
        return 0
    speed = _travel(motion, kind)
    begin, share = level
    ran_at = float(np.quantile(speed[since + round(begin * (ran - since)) : ran], share))
    count = 0.0 if kind is Kind.SPEED else float(np.min(speed[speed > 0.0]))
    if ran_at <= 0.0 or ran_at * (len(volts) - ran) < EXPECTED * count:
        return 0
    return int(np.flatnonzero(speed >= RUNNING * ran_at)[-1]) + 1
