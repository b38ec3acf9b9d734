"""Restore the clock of a board whose rows a computer stamped when they came, as the motion shows.

A board writes a row every 10 ms, and each is stamped on arrival: late by a link's and a scheduler's whims, which makes
of an exact position a noise that grows with the speed. Steps between stamps that are white lateness, each on its own,
have a covariance of neighbours of −σ², where those of a loop whose periods vary have none: a random walk with white
noise, whose best smoother follows (J. Muth, J. Am. Stat. Assoc. 55, 1960). Whether the white part is lateness or a loop
that waits for its next turn only the motion tells: positions go on with the stamps, or with the clock.
"""

from dataclasses import replace
from math import log10, sqrt

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.linalg import solveh_banded

from motor_identification.logs.signals import Floats, Signals
from motor_identification.sensor.parabola_scatter import WINDOW, measure_scatter, subtract_parabolas
from motor_identification.sensor.value_lattice import find_lattice

LEAST_ROWS = 50
MOST_ROWS = 20_000  # that the motion is looked at in
LEAST_JITTER = 0.01  # of a row: standard deviation of lateness that matters
# Rows that a stamp may lie beside the clock at most, in multiples of its standard deviation: an exponential lateness
# has 12 once in 80,000 rows; beyond, rows are lacking or stamps are wrong.
MOST_LATE = 12.0
MOST_JITTER = 1.0  # rows: standard deviation of what stamps are off a clock; beyond, it is none
NEIGHBOURS = 10  # rows before and after which a row is lacking between, where all of these are later
LACKING = 0.6  # of a row: so much later
MOST_LACKING = 0.02, 300  # of the rows, and rows
LEAST_RUN_AWAY = 1e-4  # of a row: less is an even clock
FASTEST = 0.5  # quantile of the travel within a window, above which motion tells of its times
ODD = 3.0  # times the median of what is left: windows where the voltage jumps, or a position wraps, tell nothing
# Of what a clock was estimated to run away, beside none: lateness that is not white looks like running away.
RUN_AWAY = (0.25, 0.5, 1.0)
# Standard errors of the scatter that the best of these clocks leaves in the motion: within, the most even one is taken.
AS_GOOD = 1.0
ITS_OWN = 0.5  # share of a row's lateness that the motion goes on with: less is lateness of the stamp
SURE = 2.0  # standard errors
MOSTLY = 0.9  # of rows: as many that go as far as each other are one for every flank
# Of a count squared, what sums of counts are beside a parabola by the right clock: a twelfth is rounding. Noise that is
# summed up leaves more, a converter that has none less. Measured: 0.09 to 0.2, and 1.0 and more of tachogenerators.
COUNTED = (0.05, 0.3)
PRINTED = 1e-4  # decades: a step so near to a power of ten is a printed decimal


def restore_even_clock(
    signals: Signals, wanted: bool | None = None, is_speed: bool = False
) -> tuple[Signals, list[str]]:
    """Put the rows of runs onto the clock that their stamps were late on; and say so.

    wanted: as somebody said; None as the motion shows. is_speed: of counted speeds the counts are looked at.
    """
    if wanted is False:
        return signals, []
    time, jitters, periods = signals.time.copy(), [], []
    for run in signals.runs.values():
        stamps = (signals.time[run] - signals.time[run.start]) * 1e-9
        clocks = _lay_clocks(stamps)
        motion = signals.motion[run]
        position = _count_travel(clocks, stamps, motion) if is_speed and clocks else motion
        clock = _choose_clock(clocks, stamps, position, wanted is True)
        if clock is None:
            continue
        time[run] = signals.time[run.start] + np.round(clock * 1e9).astype(np.int64)
        jitters.append(float(np.std(stamps - clock)))
        periods.append(float(np.median(np.diff(clock))))
    if not jitters:
        return signals, []
    said = (
        f"Stamps are off an even clock of {1e3 * np.median(periods):.5g} ms by {1e3 * max(jitters):.3g} ms, and the "
        "motion fits that clock: rows are put on it (assumed; otherwise: --no-even-clock)."
    )
    return replace(signals, time=time), [said]


def _lay_clocks(stamps: Floats) -> list[Floats]:
    """Lay clocks [s] through stamps [s], shape (K,), the most even first; none where they are on one, or late on none.

    The first is even, but for rows that are lacking, where stamps look like that; a loop that runs away does, too.
    """
    if len(stamps) < LEAST_ROWS:
        return []
    row = np.arange(len(stamps), dtype=np.float64)
    slope, begin = np.polyfit(row, stamps, 1)
    late, run_away = _split_jitter(stamps, slope)
    if slope <= 0.0 or late < LEAST_JITTER * slope:
        return []
    even = begin + slope * row
    lacking = _count_lacking(stamps - even, slope)
    sizes = [share * run_away for share in RUN_AWAY if run_away > LEAST_RUN_AWAY * slope]
    clocks = [even, *(even + _smooth(stamps - even, (late / size) ** 2) for size in sizes)]
    if lacking[-1] > 0.0:
        clocks.insert(0, np.polyval(np.polyfit(row + lacking, stamps, 1), row + lacking))
    return [clock for clock in clocks if np.min(np.diff(clock)) > 0.0 and _is_near(clock, stamps, late, slope)]


def _is_near(clock: Floats, stamps: Floats, late: float, slope: float) -> bool:
    """Decide whether stamps [s] (K,) are near a clock [s], for the lateness and the length of a row [s]."""
    off = stamps - clock
    jitter = float(np.std(off))
    return jitter < MOST_JITTER * slope and float(np.max(np.abs(off))) < MOST_LATE * max(late, jitter)


def _split_jitter(stamps: Floats, slope: float) -> tuple[float, float]:
    """Split the jitter of stamps [s] into what each is late on its own and what the clock runs away in a row."""
    steps = np.clip(np.diff(stamps) - slope, -2.0 * slope, 2.0 * slope)  # a row that is lacking is neither
    steps -= steps.mean()
    late = max(-float(np.mean(steps[1:] * steps[:-1])), 0.0)
    return sqrt(late), sqrt(max(float(np.mean(steps**2)) - 2.0 * late, 0.0))


def _count_lacking(off: Floats, slope: float) -> Floats:
    """Count the rows that are lacking before each, shape (K,), by stamps [s] that are off a clock for long."""
    lacking = np.zeros(len(off))
    share, most = MOST_LACKING
    for _ in range(min(int(share * len(off)), most)):
        rest = off - slope * lacking
        middles = np.median(sliding_window_view(rest, NEIGHBOURS), axis=1)
        jumps = middles[NEIGHBOURS:] - middles[:-NEIGHBOURS]
        at = int(np.argmax(jumps)) if len(jumps) else 0
        if not len(jumps) or jumps[at] < LACKING * slope:
            break
        early, later = (
            np.square(rest[at : at + 2 * NEIGHBOURS] - middles[place]) for place in (at, at + NEIGHBOURS)
        )  # from which row on: where early rows are nearer to the one, and later rows to the other
        begin = at + int(np.argmin(np.cumsum(early - later))) + 1
        lacking[begin:] += max(round(float(jumps[at]) / slope), 1)
    return lacking


def _smooth(off: Floats, ratio: float) -> Floats:
    """Smooth a random walk with white noise (K,), of variances of noise and step in that ratio."""
    bands = np.zeros((2, len(off)))
    bands[0, 1:] = -ratio
    bands[1] = 1.0 + 2.0 * ratio
    bands[1, [0, -1]] -= ratio
    return np.asarray(solveh_banded(bands, off))


def _choose_clock(clocks: list[Floats], stamps: Floats, position: Floats | None, wanted: bool) -> Floats | None:
    """Choose the clock [s] that positions (K,) go on with, whatever the stamps [s] say; None where they go by those."""
    if not clocks:
        return None
    if position is None or _is_row_a_flank(position):
        return clocks[0] if wanted else None
    some = slice(0, MOST_ROWS)
    clock = _find_best_clock([one[some] for one in clocks], position[some])
    return clocks[clock] if wanted or _goes_by_clock(clocks[clock][some], stamps[some], position[some]) else None


def _find_best_clock(clocks: list[Floats], position: Floats) -> int:
    """Find the number of the clock [s] over which positions (K,) scatter least, the most even one of equals."""
    left = [_measure_fast_scatter(clock, position) for clock in clocks]
    most = (1.0 + AS_GOOD / sqrt(FASTEST * len(position) / WINDOW)) * min(left)
    return next(number for number, scatter in enumerate(left) if scatter <= most)


def _is_row_a_flank(position: Floats) -> bool:
    """Decide whether rows came when the motor had gone so far: their positions (K,) are even whatever the time was."""
    travel, rows = np.unique(np.abs(np.diff(position)), return_counts=True)
    return bool(travel[np.argmax(rows)] > 0.0 and np.max(rows) > MOSTLY * np.sum(rows))


def _measure_fast_scatter(clock: Floats, position: Floats) -> float:
    """Measure the usual scatter of positions (K,) beside parabolas over a clock [s], where they tell of their times."""
    travel = np.abs(position[WINDOW - 1 :] - position[: 1 - WINDOW])
    return float(np.median(measure_scatter(clock, position)[travel >= np.quantile(travel, FASTEST)]))


def _goes_by_clock(clock: Floats, stamps: Floats, position: Floats) -> bool:
    """Decide whether positions (K,) go on with a clock [s], whatever their stamps [s] say.

    A position at e + β·(s − e), clock e and stamp s, lies beside a parabola over e by β times its speed times what s is
    off, less what a parabola takes of that; so says a regression over short windows.
    """
    times, offs, values = (
        sliding_window_view(column, WINDOW)[::WINDOW] for column in (clock, stamps - clock, position)
    )
    centred = times - times.mean(axis=1, keepdims=True)
    slopes = np.einsum("wi,wi->w", centred, values) / np.einsum("wi,wi->w", centred, centred)
    expected, left = (subtract_parabolas(times, rows) for rows in (slopes[:, None] * offs, values))
    power = np.einsum("wi,wi->w", expected, expected)
    told = power > 0.0
    if not told.any():
        return False
    expected, left, power = expected[told], left[told], power[told]
    rest = np.sum((left - _find_share(expected, left, power) * expected) ** 2, axis=1)
    usual = rest <= ODD**2 * np.median(rest)
    expected, left, power = expected[usual], left[usual], power[usual]
    share = float(np.sum(expected * left) / np.sum(power))
    scores = np.einsum("wi,wi->w", expected, left - share * expected)
    return share + SURE * float(np.sqrt(np.sum(scores**2)) / np.sum(power)) < ITS_OWN


def _find_share(expected: Floats, left: Floats, power: Floats) -> float:
    """Find the share of what is expected, shape (W, 7), that windows have left: the median, by their power (W,)."""
    each = np.einsum("wi,wi->w", expected, left) / power
    order = np.argsort(each)
    return float(each[order][np.searchsorted(np.cumsum(power[order]), 0.5 * power.sum())])


def _count_travel(clocks: list[Floats], stamps: Floats, speeds: Floats) -> Floats | None:
    """Sum up the counts of speeds (K,), of one period or of rows' own; None where they are not counted.

    Counts that were summed up are a position to one count. A converter's steps, or printed decimals, are not.
    """
    for values in (speeds, speeds * np.diff(stamps, prepend=stamps[0])):
        step = find_lattice(values[1:])
        if step == 0.0 or abs(log10(step) - round(log10(step))) < PRINTED:
            continue
        counts = np.cumsum(values / step)
        left = min(_measure_fast_scatter(clock, counts) for clock in clocks) / (WINDOW - 3)
        if COUNTED[0] < left < COUNTED[1]:
            return np.asarray(counts)
    return None
