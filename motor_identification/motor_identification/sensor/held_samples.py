"""Find held samples: a slow sensor in a fast log repeats its value until it has a new one.

A value that repeats because the motor turns evenly changes whenever it likes; one that is held changes no sooner than
after the sensor's own period, row for row. Where the two clocks slip, as a robot's loop and its bus do, there is no
even grid: values that stay for several rows and then change by many of their steps are held all the same
(`slipping_frames`).
"""

from dataclasses import dataclass

import numpy as np

from motor_identification.recording import Floats, Integers
from motor_identification.sensor.own_clock import lay_own_clock
from motor_identification.sensor.slipping_frames import add_standstill, find_slipping_frames

QUANTILES = (0.05, 0.25, 0.5)  # of the times between changes: one of them is a frame, the longer ones skip some
EARLY = 0.12  # share of changes that may come after less than LEAST_GAP of a frame: rows are late now and then
LEAST_GAP = 0.7
LEAST_ROWS = 1.5  # in a frame: fewer are rows that jitter
OFF_GRID = 0.65  # rows beside an even grid that a change may be: half a row either way, and jitter
LATE = 0.03  # share of changes that may be further off
CHANCE = 1e-4  # that changes at random rows would be so near a grid
MOST, SURE = 0.5, 4.0  # of the rows in motion that hold values, and standard errors of how many stay for twice as long


@dataclass(frozen=True)
class Frames:
    """The frames of a sensor that is slower than its log; arrays of shape (F,)."""

    row: Integers  # the row at which each frame is first seen
    time: Floats  # [s] even, in the middle of when rows show it first
    period: float  # [s]


def find_frames(time: Floats, values: Floats, position: bool = False) -> Frames | None:
    """Find the frames of held values (K,) at times (K,) [s]; None where every row has a value of its own.

    position: whether the values are positions.
    """
    changed = np.flatnonzero(np.diff(values)) + 1
    if len(changed) < 2:
        return None
    seen, row = time[changed], float(np.median(np.diff(time)))
    gaps = np.diff(seen)
    for guess in np.unique(np.quantile(gaps, QUANTILES, method="lower")):
        if guess > LEAST_ROWS * row and np.mean(gaps < LEAST_GAP * guess) <= EARLY:
            grid = _fit_grid(seen, float(np.mean(gaps[np.abs(gaps - guess) < 1.5 * row])), row)
            slipping = None if grid else find_slipping_frames(time, values, changed, float(guess))
            if grid is None and slipping is None:
                continue
            if position and (own := _find_own_clock(time, values, changed, float(guess), grid)):
                return own
            return _make_frames(time, *grid, row) if grid else Frames(*slipping) if slipping else None
    return None


def _find_own_clock(
    time: Floats, positions: Floats, changed: Integers, guess: float, grid: tuple[float, float] | None
) -> Frames | None:
    """Find frames by the sensor's clock that ways tell; None where they tell none, or the grid is as good."""
    even = time[:0]
    if grid is not None:
        period, begin = grid
        even = begin + period * np.rint((time[changed] - begin) / period)
        if np.any(np.diff(even) <= 0.0):
            even = time[:0]
    own = lay_own_clock(time, positions, changed, guess, even)
    return Frames(*add_standstill(time, *own)) if own else None


def _fit_grid(seen: Floats, guess: float, row: float) -> tuple[float, float] | None:
    """Period [s] and begin [s] of an even grid; None where changes are not on it, or may be by chance.

    By least squares, counted by a guess first, then by the period; the middle of the rows at which changes show.
    """
    number = np.concatenate([[0.0], np.rint(np.diff(seen) / guess).cumsum()])
    period, begin = np.polyfit(number, seen, 1)
    period, begin = np.polyfit(np.rint((seen - begin) / period), seen, 1)
    if not period > LEAST_ROWS * row:
        return None
    beside = (seen - begin + 0.5 * period) % period - 0.5 * period
    first, last = np.quantile(beside, (0.5 * LATE, 1.0 - 0.5 * LATE))
    chance = len(seen) * min(2.0 * OFF_GRID * row / period, 1.0) ** (len(seen) - 1)
    even = last - first <= 2.0 * OFF_GRID * row and chance < CHANCE
    return (float(period), float(begin + 0.5 * (first + last))) if even else None


def _make_frames(time: Floats, period: float, begin: float, row: float) -> Frames:
    ticks = np.arange(np.ceil((time[0] - 0.5 * row - begin) / period), np.floor((time[-1] - begin) / period) + 1.0)
    made = begin + period * ticks
    # Where the sensor has a clock of its own rows show it up to one row late. A delay of the model can make up for half
    # a row on average, but not for a time before that of a log which reads its sensor itself.
    shown = np.minimum(np.searchsorted(time, made + 0.5 * row), len(time) - 1)
    return Frames(shown.astype(np.int64), made, period)


def count_held_rows(values: Floats) -> int:
    """Count the rows for which most of the values (K,) are held, where a buffer gave others too soon; 0 where none are.

    Two values in a row are the same by chance: then they stay for twice as long, and more seldom for any time between.
    Where each row has a value of its own, or one stays for as long as it likes, longer times are ever more seldom.
    """
    gaps = np.diff(np.flatnonzero(np.diff(values)))
    times: Integers = np.bincount(gaps, minlength=3)
    held = 2 + int(np.argmax(times[2:]))
    if len(times) <= 2 * held:
        return 0
    between, twice = float(np.max(times[held + 1 : 2 * held])), float(times[2 * held])
    short = gaps[gaps <= 2 * held]
    mostly = np.sum(short[short % held == 0]) > MOST * np.sum(short)
    return held if mostly and times[held] > twice > between + SURE * np.sqrt(between + twice) else 0
