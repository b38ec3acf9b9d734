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
# Of the way in the first halves of the times at little voltage, that in the second ones: of less it ran out, as where a
# position is reached. Measured: 0.1 of a servo that was there.
RUNS_ON = 0.25
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
        if _runs_out(little, _travel(motion[:ran], form.kind)):
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


def _runs_out(little: Bools, travel: Floats) -> bool:
    """Whether a motor comes to a stop in the times, shape (K,), in which its voltage is little: that drives it not."""
    edges = np.flatnonzero(np.diff(little, prepend=False, append=False))
    times = [(begin, end) for begin, end in zip(edges[::2], edges[1::2], strict=True) if end - begin >= FEWEST]
    begins, ends = np.array(times, dtype=np.int64).reshape(-1, 2).T
    way = np.concatenate(([0.0], np.cumsum(travel)))
    middles = (begins + ends) // 2
    first, second = float(np.sum(way[middles] - way[begins])), float(np.sum(way[ends] - way[middles]))
    return second < RUNS_ON * first


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
