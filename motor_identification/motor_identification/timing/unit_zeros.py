"""Find the zeros that running means leave in speeds: frequencies at which there is nothing, not even noise.

A motor has no such zeros, nor has a filter of poles alone. What a mean of N rows left is predicted from a few rows
before and the voltage (ARX; L. Ljung, System Identification, 1999, 4.2) worse than what went in: a few rows do not tell
what drops out of the mean. So what went in is computed for every N, and the likelihoods of such predictions compared.
"""

from collections.abc import Sequence
from math import log, sqrt

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.recording import Bools, Floats, Integers, Recording
from motor_identification.sensor.row_clock import number_rows
from motor_identification.sensor.speed_sensor import mark_motion
from motor_identification.timing.speed_filter import LEAST_ROWS, MEAN, MOST_ROWS, SpeedFilter, measure_part, undo_mean

PAST = 6  # speeds and voltages before that predict the next one
# Of log likelihood, in all and a row. Measured: 0.03 to 0.8 a row behind a mean; 0.005 at most, and 21 in all, in fifty
# logs of real motors and a hundred simulated ones without; 10 in all in 1,200 of 60 to 260 rows.
LEAST_GAIN, LEAST_GAIN_OF_ROW = 20.0, 0.02
LEAST_SPEEDS = 60
MOST_SPEEDS = 20_000  # of a recording that are looked at
# Of a recording, a mean, or so many rows of any: of which less is looked at half of a mean is found, as far as it goes.
LONGEST, SHORT = 0.1, 12


def find_means(recordings: Sequence[Recording]) -> tuple[int, ...]:
    """Find of how many rows the speeds of recordings may be running means, or have zeros as those; empty of none.

    The likeliest, and two: behind a pole, zeros beside its own gain a little.
    """
    longest = max(recordings, key=len)
    speed, voltage = longest.speed[:MOST_SPEEDS], longest.voltage[:MOST_SPEEDS]
    number = number_rows(longest.time[: len(speed)])
    moving = mark_motion(speed)[PAST:] if number is None else _mark_whole(mark_motion(speed), number)
    if number is not None:
        voltage = voltage[np.searchsorted(number, np.arange(int(number[-1]) + 1), side="right") - 1]
    count = int(np.count_nonzero(moving))
    if count < LEAST_SPEEDS:
        return ()
    most = min(MOST_ROWS, max(int(LONGEST * len(speed)), SHORT))
    cost = {rows: _measure_cost(_undo(speed, rows, number), voltage, moving, rows) for rows in range(1, most + 1)}
    least = max(LEAST_GAIN / count, LEAST_GAIN_OF_ROW)
    likely = {min(cost, key=lambda rows: cost[rows]), LEAST_ROWS}
    return tuple(rows for rows in sorted(likely) if cost[1] - cost[rows] > least)


def measure_gain_of_mean(values: Floats, went_in: Floats, voltage: Floats, rows: int) -> float:
    """Measure how much likelier values (K,) are, by log likelihood, as means of so many rows of what went in, (K,).

    voltage: [V] from each row on, shape (K,). 0 where too few rows move to tell. Measured: below 0 of all 9 of 500
    simulated logs of plain counts that might be means of a few, -127 to -2; above 0 of all 241 that were, 1 to 860.
    """
    moving = mark_motion(values)[PAST:]
    count = int(np.count_nonzero(moving))
    if count < 2 * (2 * PAST + 2):
        return 0.0
    plain = _measure_cost(values, voltage, moving, 1)
    return count * (plain - _measure_cost(went_in, voltage, moving, rows))


def _undo(speed: Floats, rows: int, number: Integers | None) -> Floats:
    """Compute what went into a mean of so many rows, at all rows; numbers: of those that were logged, if not all."""
    return undo_mean(speed, rows) if number is None else SpeedFilter(MEAN, rows).undo_whole(speed, number)


def _mark_whole(moving: Bools, number: Integers) -> Bools:
    """Mark the rows in motion, of all, before which none is missing, without the first ones, shape (R − PAST,)."""
    logged = np.zeros(int(number[-1]) + 1, dtype=bool)
    whole = logged.copy()
    logged[number], whole[number] = True, moving
    return np.asarray(whole[PAST:] & sliding_window_view(logged, PAST + 1).all(axis=1))


def _measure_cost(values: Floats, voltage: Floats, moving: Bools, rows: int) -> float:
    """Measure minus the mean logarithm of the density of means of so many rows, into which values (K,) went.

    But for a constant. moving: those that count, without the first ones, shape (K − PAST,).
    """
    past = sliding_window_view(values[:-1], PAST)[moving]
    driven = sliding_window_view(voltage, PAST + 1)[: len(moving)][moving]
    columns, target = np.column_stack([np.ones(len(past)), past, driven]), values[PAST:][moving]
    beside = target - columns @ np.linalg.lstsq(columns, target, rcond=1e-10)[0]
    return log(sqrt(float(np.mean(beside**2))) + 1e-300) + log(measure_part(rows))
