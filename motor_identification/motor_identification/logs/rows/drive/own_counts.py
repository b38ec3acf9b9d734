"""Recognise a loop on its own counts: each command answers the count of its row, with the encoder's rounding in it.

A PI controller changes its voltage by −kp·Δy and an integral's small step. Of speeds over single rows Δy is mostly the
rounding of a count, and so is the command's change: to a fit of speeds, a command that predicts the rounding of the
next row is a far too quick motor. Summed up to positions the rounding is gone after one row.

Such a controller's speeds often passed a filter y_k = m·y_{k−1} + (1 − m)·x_k first. Wherever two rows count alike, its
output's steps go down by m exactly: the commonest ratio of one step to the next is m. Running means of counts are taken
apart, too.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from motor_identification.logs.signals import Floats, Signals
from motor_identification.sensor.running_mean import OFF_GRID, size_of_count, take_single_rows
from motor_identification.sensor.value_lattice import find_lattice
from motor_identification.timing.speed_filter import MEMORY, SpeedFilter

FEWEST_ROWS = 50  # in which the command changes
CHANGES = 0.5  # of the rows: a loop's command changes in most
LARGE = 0.95  # of the command's changes are smaller
JUMP = 3.0  # times that: a set point's step, and no answer to one row
# Of the changes' variance that those of the speed explain, in the row and a few before: as they are, and beside the
# mean of their neighbours, where only the rounding of a row is left. Measured: 0.85 and more of 100 simulated loops
# both ways; 0.6 and 0 of a ramp of voltages, whose motor follows it.
ANSWERED = 0.5
ROWS = 3  # in which a controller answers: its own, and those of a loop that computes first or filters a little
# Rows of a running mean that is taken apart, and how many of them a run has at least. Measured: in runs of 120 to 600
# rows, one of 29 to 32 rows fits single counts by chance.
LONGEST_MEAN, FEWEST_MEANS = 32, 40
# Periods from one row to the next, from which on some between are missing, and the share of the rows: what they counted
# is missing in the sum. Measured: kv is 1 to 8 % off where one in twenty is.
LONG_ROW, MOST_LOST = 1.5, 0.01
# Counts, by which a row's is off the mean of its neighbours, and of the rows that are by less: an even motion counts
# n or n + 1 in every row, and is 1 off at most; a quarter is for speeds beside whole counts. Measured: 0.90 and more of
# 245 parts of simulated loops, none of them misread, one with 0.8; 0.2 where a mean of a real loop was taken apart
# wrongly.
ROUNDED, EVEN = 1.25, 0.9
STEPS = 1e-3  # of the largest step of a filter's output: smaller ones are digits
POLES = (0.02, 0.99)  # that are looked for
SAME_RATIO = 2e-3  # ratios that differ by no more are one
SHARE, FEWEST = 0.1, 30  # of the ratios, and at least, that are the filter's. By chance ratios are anywhere: 0.002


def take_fed_back(signals: Signals, period: float) -> tuple[Signals, float] | None:
    """Take what single rows counted, as speeds over one period [s], and a count's size in the motion's unit.

    None where speeds are no whole counts, of a period or of their own rows, as they are or before a filter; where the
    command does not answer them; where rows are missing, with what they counted; or where the counts are no motor's.
    """
    if _measure_lost(signals, period) > MOST_LOST or not _are_answered(signals):
        return None
    for speeds in _list_unfiltered(signals):
        for counted in (speeds, speeds * _measure_rows(signals, period)):
            size = size_of_count(counted, 1) if find_lattice(counted) > 0.0 else 0.0
            taken = replace(signals, motion=counted)
            if size > 0.0 and _measure_distance(taken, size) < OFF_GRID:
                return _take_single_rows(taken, size)
    return None


def _measure_lost(signals: Signals, period: float) -> float:
    """Measure the share of the rows after which some are missing, by a period [s]."""
    return float(np.mean(signals.steps() * 1e-9 > LONG_ROW * period)) if len(signals) > 1 else 1.0


def _measure_distance(signals: Signals, size: float) -> float:
    """Measure how far from whole counts rows are [counts]; not each run's first, before which nobody knows a filter."""
    rows = np.concatenate([signals.motion[run][1:] for run in signals.runs.values()]) / size
    return float(np.max(np.abs(rows - np.rint(rows)), initial=0.0))


def _are_even(counts: Floats) -> bool:
    """Decide whether most counts of single rows, shape (K,), lie between their neighbours but for their rounding.

    A mean that is taken apart wrongly, as of rows that were lost, leaves counts that are anywhere.
    """
    beside = np.abs(counts[1:-1] - 0.5 * (counts[:-2] + counts[2:]))
    return len(beside) > 0 and bool(np.mean(beside < ROUNDED) >= EVEN)


def _take_single_rows(signals: Signals, size: float) -> tuple[Signals, float] | None:
    """Take what single rows counted, and a count's size, of counts in units of `size` that may be running means.

    None where they are no motor's either way. The longest mean first: what fits it fits its divisors. Longer ones than
    a part of the rows fit by chance.
    """
    rows = min(run.stop - run.start for run in signals.runs.values())
    for window in range(min(LONGEST_MEAN, rows // FEWEST_MEANS), 0, -1):
        singles = [take_single_rows(signals.motion[run], window) for run in signals.runs.values() if window > 1]
        single = [one for one in singles if one is not None]
        motion = np.array(signals.motion)
        for run, values in zip(signals.runs.values(), single, strict=False):
            motion[run] = values
        if len(single) == len(singles) and _are_even(motion / (size * window)):
            return replace(signals, motion=motion), size * window
    return None


def _list_unfiltered(signals: Signals) -> Iterator[Floats]:
    """List speeds, shape (K,), as they are, and as they were before a filter of one pole if they passed one."""
    yield signals.motion
    pole = find_pole(np.concatenate([_find_ratios(signals.motion[run]) for run in signals.runs.values()]))
    if pole > 0.0:
        unfiltered = np.zeros(len(signals))
        for run in signals.runs.values():
            unfiltered[run] = SpeedFilter(MEMORY, pole).undo(signals.motion[run])
        yield unfiltered


def _find_ratios(speed: Floats) -> Floats:
    """Find the ratios of every step of a speed (K,) to the step before, where that is no digit; shape (M,)."""
    steps = np.diff(speed)
    before = np.flatnonzero(np.abs(steps[:-1]) > STEPS * np.max(np.abs(steps), initial=0.0))
    return np.asarray(steps[before + 1] / steps[before])


def find_pole(ratios: Floats) -> float:
    """Find the pole of a filter behind counts by the ratios, shape (M,), of steps one after the other; 0 without."""
    inside = np.sort(ratios[(ratios > POLES[0]) & (ratios < POLES[1])])
    if len(inside) == 0:
        return 0.0
    count = np.searchsorted(inside, inside + SAME_RATIO, side="right") - np.arange(len(inside))
    first = int(np.argmax(count))
    if count[first] < max(FEWEST, SHARE * len(ratios)):
        return 0.0
    return float(np.median(inside[first : first + count[first]]))


def _measure_rows(signals: Signals, period: float) -> Floats:
    """Measure the length of every row, shape (K,), in periods [s]; the first of a run has one."""
    rows = np.ones(len(signals))
    for run in signals.runs.values():
        rows[run][1:] = np.diff(signals.time[run]) * 1e-9 / period
    return rows


def _are_answered(signals: Signals) -> bool:
    """Decide whether the command of every run that changes often enough to tell answers the speeds of its rows."""
    told = [_answers(signals.voltage[run], signals.motion[run]) for run in signals.runs.values()]
    return True in told and False not in told


def _answers(voltage: Floats, speed: Floats) -> bool | None:
    """Decide whether a command [V] answers speeds, each of shape (K,), as a speed loop's does; None of too few rows.

    Against their way; with it, where the encoder or the motor is connected the other way round.
    """
    if len(voltage) < FEWEST_ROWS:
        return None
    change, steps = np.diff(voltage), np.diff(speed)
    told = change[ROWS - 1 :]
    if np.count_nonzero(told) < max(FEWEST_ROWS, CHANGES * len(told)):
        return False if len(told) > FEWEST_ROWS / CHANGES else None
    return _explain(change, steps) and _explain(_beside_neighbours(change), _beside_neighbours(steps))


def _beside_neighbours(values: Floats) -> Floats:
    """Compute by how much values (K,) are beside the mean of those before and after: of a ramp nothing, (K − 2,)."""
    return np.asarray(values[1:-1] - 0.5 * (values[:-2] + values[2:]))


def _explain(change: Floats, steps: Floats) -> bool:
    """Decide whether steps of a speed, in the row and a few before, explain most of a command's change, each (K,)."""
    change, by = change[ROWS - 1 :], np.column_stack([steps[ROWS - 1 - k : len(steps) - k] for k in range(ROWS)])
    small = np.abs(change) < JUMP * float(np.quantile(np.abs(change), LARGE))
    change, by = change[small], by[small]
    rest = change - by @ np.linalg.lstsq(by, change, rcond=None)[0]
    return bool(rest @ rest < (1.0 - ANSWERED) * (change @ change))
