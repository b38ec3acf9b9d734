"""Restore the even clock of a board whose rows a computer stamped when they came, as the motion shows.

A board writes a row every 10 ms, and each is stamped on arrival: late by a link's and a scheduler's whims, which makes
of an exact position a noise that grows with the speed. Where stamps stay beside an even clock, and a parabola through a
few rows fits the motion far better by that clock than by the stamps, rows are put on it. A loop that is irregular
itself has a motion that fits its stamps.
"""

from dataclasses import replace

import numpy as np

from motor_identification.logs.signals import Floats, Signals
from motor_identification.sensor.parabola_scatter import WINDOW, measure_scatter

LEAST_ROWS = 50
MOST_ROWS = 20_000  # that the motion is looked at in
LEAST_JITTER = 0.01  # of a row: standard deviation of stamps that matters
MOST_JITTER = 1.5  # rows that any stamp may lie beside the even clock: beyond, rows are lacking
# Variance of the stamps' steps in that of the stamps themselves: 2 where each is late on its own, little where a clock
# runs away row by row.
LEAST_STEPS = 0.5
FASTEST = 0.75  # quantile of the speed, above which motion tells of its times
BETTER = 0.5  # of the scatter that stamps leave, in the median: less is left by a clock that was there


def restore_even_clock(signals: Signals, wanted: bool | None = None) -> tuple[Signals, list[str]]:
    """Put the rows of runs onto an even clock where they were on one; and say so.

    wanted: as somebody said; None as the motion shows.
    """
    if wanted is False:
        return signals, []
    time, jitters, periods = signals.time.copy(), [], []
    for run in signals.runs.values():
        stamps = (signals.time[run] - signals.time[run.start]) * 1e-9
        even = _lay_clock(stamps)
        if even is None or not (wanted or _fits_better(even, stamps, signals.motion[run])):
            continue
        time[run] = signals.time[run.start] + np.round(even * 1e9).astype(np.int64)
        jitters.append(float(np.std(stamps - even)))
        periods.append(float(even[1] - even[0]))
    if not jitters:
        return signals, []
    said = (
        f"Stamps are off an even clock of {1e3 * np.median(periods):.5g} ms by {1e3 * max(jitters):.3g} ms, and the "
        "motion fits that clock: rows are put on it (assumed; otherwise: --no-even-clock)."
    )
    return replace(signals, time=time), [said]


def _lay_clock(stamps: Floats) -> Floats | None:
    """Lay an even clock [s] through stamps [s], both of shape (K,); None where they are on one, or on none."""
    if len(stamps) < LEAST_ROWS:
        return None
    row = np.arange(len(stamps))
    slope, begin = np.polyfit(row, stamps, 1)
    even = begin + slope * row
    off = stamps - even
    jitter = float(np.std(off))
    beside = jitter < LEAST_JITTER * slope or np.max(np.abs(off)) > MOST_JITTER * slope
    if beside or float(np.var(np.diff(off))) < LEAST_STEPS * jitter**2:
        return None
    return np.asarray(even)


def _fits_better(even: Floats, stamps: Floats, motion: Floats) -> bool:
    """Decide whether a motion (K,) follows parabolas over an even clock far better than over its stamps [s]."""
    some = slice(0, MOST_ROWS)
    by_clock, by_stamps = measure_scatter(even[some], motion[some]), measure_scatter(stamps[some], motion[some])
    rate = np.abs(motion[some][WINDOW - 1 :] - motion[some][: 1 - WINDOW])
    fast = (rate >= np.quantile(rate, FASTEST)) & (rate > 0.0) & (by_stamps > 0.0)
    return bool(fast.any()) and float(np.median(by_clock[fast] / by_stamps[fast])) < BETTER
