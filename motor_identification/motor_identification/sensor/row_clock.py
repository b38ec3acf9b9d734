"""Lay clocks through the stamps of rows, each of which is late on its own, of a loop that may run away.

Steps between stamps that are late on their own have a covariance of neighbours of −σ², where those of a loop whose
periods vary have none: a random walk with white noise, whose best smoother follows (J. Muth, J. Am. Stat. Assoc. 55,
1960). Which of a few clocks it was, the stamps alone do not tell.
"""

from math import ceil, log10, sqrt
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.linalg import solveh_banded

from motor_identification.recording import Floats, Integers

LEAST_ROWS = 50
LEAST_JITTER = 0.01  # of a row: standard deviation of lateness that matters
# Rows that a stamp may lie beside the clock at most, in multiples of its standard deviation: an exponential lateness
# has 12 once in 80,000 rows; beyond, rows are lacking or stamps are wrong.
MOST_LATE = 12.0
MOST_JITTER = 1.0  # rows: standard deviation of what stamps are off a clock; beyond, it is none
NEIGHBOURS = 10  # rows, at least, before and after which a row is lacking between, where all of these are later
LACKING = 0.6  # of a row: so much later
# Of a row: standard error of so much, which sets how many neighbours it takes. Measured: with ten of a lateness of 0.3
# rows six of 5,864 rows were said to be lacking of a log that lacked none.
SURE_LACKING = 0.1
MEDIAN_ERROR = 1.25  # standard errors of a mean that a median has
MOST_NEIGHBOURS = 100  # which a lateness of 0.56 rows takes; beyond, no lacking row is told
MOST_LACKING = 0.02, 300  # of the rows, and rows
# Rows that a step is longer than, as usual, and is a gap: what a board, or a link, did meanwhile no clock says, and
# nothing may have been counted. Rows that are a few times as long as others are those of an uneven loop.
LONGEST = 5.0
LEAST_RUN_AWAY = 1e-4  # of a row: less is an even clock
# Of what a clock was estimated to run away, beside none: lateness that is not white looks like running away.
RUN_AWAY = (0.25, 0.5, 1.0)
EVEN = 0.25  # of a row, within which most rows are a whole number of rows long: else nothing tells which are missing
MOST_EVEN = 0.99  # of the rows: of stamps that are late by chance one in 20,000 is then late by half a row
MOST_MISSING = 0.2  # of all rows: with more of them missing a row is no row
# Of the rows between longer steps, their scatter by which these come by a beat. Measured: 0 to 0.4 of loops a little
# longer than a tick of their clock, even ones and others; 0.9 of rows that are missing by chance.
BEAT = 0.5
ROUNDINGS = 5  # of stamps to the rows of a clock that is laid through them, until they stay
SAME_TICK = 1e-4  # of a tick, by which a step is whole ticks
# Times the middle deviation from the median row, and of that row, within which rows lack nothing: white noise is within
# 5 standard deviations, and a row whose neighbour is lacking is twice as long.
AROUND, HALF_A_ROW = 7.5, 0.5
LOPSIDED = 4.0  # standard errors of the mean, by which it is beside the median of rows some of which took longer


class Clock(NamedTuple):
    """A clock through stamps, and which of them it is."""

    run_away: float  # of what the stamps say that it runs away, this much; 0 of an even one
    time: Floats  # [s] of the rows, shape (K,)


def lay_clocks(stamps: Floats) -> list[Clock]:
    """Lay clocks through stamps [s], shape (K,), the most even first; none where they are on one, or late on none.

    Nor where more is missing in gaps than may be lacking: a clock through those smears them over the rows beside.

    The first is even, but for rows that are lacking, where stamps look like that; a loop that runs away does, too.
    """
    if len(stamps) < LEAST_ROWS or _is_torn(stamps):
        return []
    number = _number_by_steps(stamps)
    row = np.asarray(np.arange(len(stamps)) if number is None else number, dtype=np.float64)
    slope, begin = np.polyfit(row, stamps, 1)
    late, run_away = _split_jitter(stamps, row, slope)
    if slope <= 0.0 or late < LEAST_JITTER * slope:
        return []
    even = begin + slope * row
    sure = number is not None
    lacking = np.zeros(1) if sure else _count_lacking(stamps - even, slope, count_neighbours(late / slope))
    shares = RUN_AWAY if run_away > LEAST_RUN_AWAY * slope else ()
    laid = [(0.0, even)]
    laid += [(share, even + _smooth(stamps - even, (late / (share * run_away)) ** 2)) for share in shares]
    if lacking[-1] > 0.0:
        laid.insert(0, (0.0, np.polyval(np.polyfit(row + lacking, stamps, 1), row + lacking)))
    clocks = [Clock(share, np.asarray(time, np.float64)) for share, time in laid if np.min(np.diff(time)) > 0.0]
    return [clock for clock in clocks if _is_near(clock.time, stamps, late, slope)]


def measure_period(rows: Floats) -> float:
    """Measure the period [s] that a loop should keep, of the lengths [s] of its rows, shape (K,): their mean.

    Jitter of 5 % puts the median of a thousand rows 0.2 % beside it. Rows near the median count, so that no gap does;
    where more of these are longer than shorter, most kept the period, and the median is it.
    """
    middle = float(np.median(rows))
    off = rows - middle
    off = off[np.abs(off) <= min(AROUND * float(np.median(np.abs(off))), HALF_A_ROW * middle)]
    mean = float(np.mean(off)) if len(off) else 0.0
    lopsided = abs(mean) > LOPSIDED * float(np.std(off)) / sqrt(len(off)) if len(off) else True
    return middle if lopsided else middle + mean


def number_rows(time: Floats) -> Integers | None:
    """Number rows at times [s] (K,) among all that there were; None where none is missing, or nothing tells which.

    By the steps of even ones; by an even clock where each stamp is late on its own by less than half a row.
    """
    number = _number_by_steps(time)
    return _number_by_clock(time) if number is None else number


def _number_by_clock(stamps: Floats) -> Integers | None:
    """Number rows by an even clock that is laid through their stamps [s] (K,), each of which is nearest to its own row.

    None where no row is lacking, or stamps are half a row off. Measured: of 360 simulated logs in which stamps were
    late by 0.05 to 0.3 rows and up to 5 % were missing 32 that steps do not number are, each without a mistake; none of
    180 of which none was missing, nor of 180 whose loop ran away.
    """
    row = np.arange(len(stamps), dtype=np.float64)
    if len(stamps) < LEAST_ROWS or _is_torn(stamps):
        return None
    slope, begin = np.polyfit(row, stamps, 1)
    late, _ = _split_jitter(stamps, row, slope)
    if slope <= 0.0 or late < LEAST_JITTER * slope or _are_ticks(np.diff(stamps)):
        return None
    row += _count_lacking(stamps - begin - slope * row, slope, count_neighbours(late / slope))
    for _ in range(ROUNDINGS):
        before, (slope, begin) = row, np.polyfit(row, stamps, 1)
        row = np.rint((stamps - begin) / slope)
        row -= row[0]
        if np.array_equal(row, before):
            break
    lacks = np.array_equal(row, before) and np.min(np.diff(row)) > 0.0 and row[-1] >= len(row)
    return row.astype(np.int64) if lacks else None


def _number_by_steps(time: Floats) -> Integers | None:
    """Number rows at times [s] (K,) by steps that are nearly all whole rows long; None as for `number_rows`."""
    steps = np.diff(time)
    usual = float(np.median(steps)) if len(steps) else 0.0
    if usual <= 0.0:
        return None
    rows = steps / usual
    even = float(np.mean(np.abs(rows - np.maximum(np.rint(rows), 1.0)) < EVEN)) > MOST_EVEN
    for at in np.flatnonzero(rows[1:] < 1.0 - EVEN)[::-1]:  # what is stamped soon after a late row came with it
        rows[at] -= 1.0 - rows[at + 1]
    whole = np.maximum(np.rint(rows), 1.0)
    number = np.append(0, np.cumsum(whole)).astype(np.int64)
    missing = 1.0 - len(number) / float(number[-1] + 1)
    return number if even and 0.0 < missing < MOST_MISSING and not _are_ticks(steps) else None


def _are_ticks(steps: Floats) -> bool:
    """Decide whether steps [s] of stamps are those of a clock that ticks once a row, of rows a little longer.

    Then none is missing: some rows take a tick more, by a beat. A tick is a millisecond, or another last digit.
    """
    tick = 10.0 ** round(log10(float(np.median(steps))))
    ticks = np.rint(steps / tick)
    apart = np.diff(np.flatnonzero(ticks > 1.0))
    whole = float(np.median(ticks)) == 1.0 and bool(np.all(np.abs(steps / tick - ticks) < SAME_TICK))
    return whole and len(apart) > 1 and float(np.std(apart)) < BEAT * float(np.mean(apart))


def _is_torn(stamps: Floats) -> bool:
    """Decide whether stamps [s] (K,) have more time in gaps than rows may be lacking."""
    steps = np.diff(stamps)
    usual = float(np.mean(steps))
    return float(np.sum(steps[steps > LONGEST * usual] - usual)) > MOST_LACKING[0] * len(stamps) * usual


def _is_near(clock: Floats, stamps: Floats, late: float, slope: float) -> bool:
    """Decide whether stamps [s] (K,) are near a clock [s], for the lateness and the length of a row [s]."""
    off = stamps - clock
    jitter = float(np.std(off))
    return jitter < MOST_JITTER * slope and float(np.max(np.abs(off))) < MOST_LATE * max(late, jitter)


def _split_jitter(stamps: Floats, row: Floats, slope: float) -> tuple[float, float]:
    """Split the jitter of stamps [s] of these rows into what each is late on its own and a clock runs away in a row."""
    steps = np.clip(
        np.diff(stamps) - slope * np.diff(row), -2.0 * slope, 2.0 * slope
    )  # a row that is lacking is neither
    steps -= steps.mean()
    late = max(-float(np.mean(steps[1:] * steps[:-1])), 0.0)
    return sqrt(late), sqrt(max(float(np.mean(steps**2)) - 2.0 * late, 0.0))


def count_neighbours(late: float) -> int:
    """Count the rows on either side whose medians tell a lacking row, for the lateness in rows."""
    return max(NEIGHBOURS, ceil(2.0 * (MEDIAN_ERROR * late / SURE_LACKING) ** 2))


def _count_lacking(off: Floats, slope: float, neighbours: int) -> Floats:
    """Count the rows that are lacking before each, shape (K,), by stamps [s] that are off a clock for long."""
    lacking = np.zeros(len(off))
    share, most = MOST_LACKING
    if neighbours > MOST_NEIGHBOURS or len(off) < 2 * neighbours:
        return lacking
    rest = off.copy()
    middles = np.median(sliding_window_view(rest, neighbours), axis=1)
    for _ in range(min(int(share * len(off)), most)):
        jumps = middles[neighbours:] - middles[:-neighbours]
        at = int(np.argmax(jumps))
        if jumps[at] < LACKING * slope:
            break
        early, later = (
            np.square(rest[at : at + 2 * neighbours] - middles[place]) for place in (at, at + neighbours)
        )  # from which row on: where early rows are nearer to the one, and later rows to the other
        begin = at + int(np.argmin(np.cumsum(early - later))) + 1
        count = max(round(float(jumps[at]) / slope), 1)
        for shifted in (rest, middles):
            shifted[begin:] -= slope * count
        lacking[begin:] += count
        first = max(begin - neighbours + 1, 0)  # of the windows that have rows of either side
        middles[first:begin] = np.median(sliding_window_view(rest[first : begin + neighbours - 1], neighbours), axis=1)
    return lacking


def _smooth(off: Floats, ratio: float) -> Floats:
    """Smooth a random walk with white noise (K,), of variances of noise and step in that ratio."""
    bands = np.zeros((2, len(off)))
    bands[0, 1:] = -ratio
    bands[1] = 1.0 + 2.0 * ratio
    bands[1, [0, -1]] -= ratio
    return np.asarray(solveh_banded(bands, off))
