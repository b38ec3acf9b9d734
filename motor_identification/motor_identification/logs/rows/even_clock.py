"""Restore the clock of a board whose rows a computer stamped when they came, as the motion shows.

A board writes a row every 10 ms, and each is stamped on arrival: late by a link's and a scheduler's whims, which makes
of an exact position a noise that grows with the speed. Stamps alone do not tell lateness from a loop that waits for its
next turn; the motion does: positions go on with the stamps, or with one of the clocks through them.
"""

from dataclasses import replace
from math import log10, sqrt

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from motor_identification.logs.signals import Floats, Signals
from motor_identification.sensor.parabola_scatter import WINDOW, measure_scatter, subtract_parabolas
from motor_identification.sensor.row_clock import lay_clocks
from motor_identification.sensor.speed_sensor import are_blurred
from motor_identification.sensor.value_lattice import find_lattice

MOST_ROWS = 20_000  # that the motion is looked at in
FASTEST = 0.5  # quantile of the travel within a window, above which motion tells of its times
ODD = 3.0  # times the median of what is left: windows where the voltage jumps, or a position wraps, tell nothing
# Standard errors of the scatter that the best of these clocks leaves in the motion: within, the most even one is taken.
AS_GOOD = 1.0
# Rows whose means are looked at, too: what a clock runs away within seven is less than an encoder's step. Measured: of
# a loop whose periods vary by 6 %, at 1.5 counts a row, an even clock is 1.9 ms off, and its stamps are 0.3 ms late.
BLOCKS = 32, 8
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
        clocks = [clock.time for clock in lay_clocks(stamps)]
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


def _choose_clock(clocks: list[Floats], stamps: Floats, position: Floats | None, wanted: bool) -> Floats | None:
    """Choose the clock [s] that positions (K,) go on with, whatever the stamps [s] say; None where they go by those."""
    if not clocks:
        return None
    if position is None or not np.any(np.diff(position)) or _is_row_a_flank(position):
        return clocks[0] if wanted else None
    some = slice(0, MOST_ROWS)
    clock = _find_best_clock([one[some] for one in clocks], position[some])
    return clocks[clock] if wanted or _goes_by_clock(clocks[clock][some], stamps[some], position[some]) else None


def _find_best_clock(clocks: list[Floats], position: Floats) -> int:
    """Find the number of the clock [s] over which positions (K,) scatter least, the most even one of equals.

    First of the clocks that means of rows go on with, over many rows; of these, over few.
    """
    numbers = list(range(len(clocks)))
    for rows in BLOCKS:
        means = _average_rows(position, rows)
        if len(means) >= WINDOW:
            numbers = _list_as_good([_average_rows(clock, rows) for clock in clocks], means, numbers)
    return _list_as_good(clocks, position, numbers)[0]


def _list_as_good(clocks: list[Floats], position: Floats, numbers: list[int]) -> list[int]:
    """List the numbers of those clocks [s], of some, over which positions (K,) scatter as little as over the best."""
    left = [_measure_fast_scatter(clocks[number], position) for number in numbers]
    most = (1.0 + AS_GOOD / sqrt(FASTEST * len(position) / WINDOW)) * min(left)
    return [number for number, scatter in zip(numbers, left, strict=True) if scatter <= most]


def _average_rows(values: Floats, rows: int) -> Floats:
    """Average so many rows each of values (K,), of shape (K / rows,)."""
    whole = len(values) // rows * rows
    return np.asarray(values[:whole].reshape(-1, rows).mean(axis=1))


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

    Counts that were summed up are a position to one count. A converter's steps, or printed decimals, are not. Nor are
    quotients by lengths of rows that nobody logged, of which the few alone lie near to whole ones: summed up, any rows
    would be even.
    """
    for values in (speeds, speeds * np.diff(stamps, prepend=stamps[0])):
        step = find_lattice(values[1:])
        if step == 0.0 or abs(log10(step) - round(log10(step))) < PRINTED:
            continue
        if are_blurred(values[1:], step):
            continue
        counts = np.cumsum(values / step)
        left = min(_measure_fast_scatter(clock, counts) for clock in clocks) / (WINDOW - 3)
        if COUNTED[0] < left < COUNTED[1]:
            return np.asarray(counts)
    return None
