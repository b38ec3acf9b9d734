"""Divide counted speeds by the lengths that their rows had, where a program divided by the one they should have had.

`rpm = 60 * count / (N * T)` with a constant T is right for a loop that keeps its period. Where it does not, a row that
took longer has more counts, and its speed is too high by as much. The motion tells: speeds that are divided by their
own rows follow it more closely. A sensor that counts for a time of its own is made worse by that.
"""

from dataclasses import replace

import numpy as np

from motor_identification.logs.signals import Floats, Signals
from motor_identification.sensor.parabola_scatter import WINDOW, measure_scatter
from motor_identification.sensor.row_clock import LONGEST, measure_period
from motor_identification.sensor.value_lattice import find_lattice
from motor_identification.sensor.value_lattice import measure_scatter as measure_scatter_of_levels

LEAST_ROWS = 50
MOST_ROWS = 20_000  # that the motion is looked at in
IRREGULAR = 0.01  # of a row: standard deviation of the rows' lengths that matters
FASTEST = 0.5  # quantile of the speed, above which rows tell of their lengths
TRUSTED = 0.9  # quantile of the scatter that counts: where the voltage jumps no parabola follows
PARTS, FEWEST_A_PART, LONGER = 8, 5, 3.0  # of a log; rows of each; times as long as in another, no jitter but a change
COARSER, EXACT = 1.5, 0.01  # times the step without, and of a step that counts are beside whole ones: to the digit
BETTER = 0.85  # of the scatter that speeds leave as they are: less is left by those of their own rows


def divide_by_own_rows(signals: Signals, wanted: bool | None = None) -> tuple[Signals, list[str]]:
    """Divide speeds by the lengths of their own rows where they were divided by one for all; and say so.

    wanted: as somebody said; None as the motion shows.
    """
    steps = np.asarray(signals.steps() * 1e-9, np.float64)
    if wanted is False or len(steps) < LEAST_ROWS or not np.std(steps[steps > 0.0]) > IRREGULAR * np.median(steps):
        return signals, []
    period, motion, told = measure_period(steps), np.array(signals.motion, np.float64), []
    for run in signals.runs.values():
        rows = np.diff(signals.time[run]) * 1e-9
        lengths = np.append(period, np.where((rows > 0.0) & (rows < LONGEST * period), rows, period))
        motion[run] *= period / lengths
        stamps = np.asarray(signals.time[run] * 1e-9, np.float64)
        told.append(_compare(stamps, signals.motion[run], motion[run]))
    as_they_are, by_rows = np.sum(told, axis=0)
    if not (wanted or (as_they_are > 0.0 and by_rows < BETTER * as_they_are)):
        return signals, []
    said = (
        f"Speeds were computed as if every row took {1e3 * period:.4g} ms: they are divided by the rows' own lengths, "
        "which the motion follows (assumed; otherwise: --no-nominal-period)."
    )
    return replace(signals, motion=motion), [said]


def find_window(signals: Signals, period: float) -> tuple[float, str]:
    """Find the window [s] of speeds that nobody said: a row, if they are about as long in every part of a log.

    Else the shortest part's, and a caution: a device that measures speeds does it for a time of its own, which no row
    that has a new one is shorter than.

    Args:
        signals: the rows.
        period: the usual length of a row [s].
    """
    shortest, longest = np.inf, 0.0
    for run in signals.runs.values():
        steps = np.diff(signals.time[run]) * 1e-9
        usual = [float(np.median(part)) for part in np.array_split(steps, PARTS) if len(part) >= FEWEST_A_PART]
        if usual and max(usual) >= LONGER * min(usual):  # whole runs may have rows of their own: readers look at those
            shortest, longest = min(shortest, *usual), max(longest, *usual)
    if not longest:
        return period, ""
    return shortest, (
        f"Caution: rows take {1e3 * shortest:.4g} ms in one part of the log and {1e3 * longest:.4g} ms in another: no "
        "window of one row fits all speeds, and that of the shortest is assumed. Say for how long a speed is measured "
        "(--speed-window), or take a position (--position)."
    )


def divide_by_regular_rows(stamped: Signals, regular: Signals) -> tuple[Signals, list[str]]:
    """Divide speeds by regular rows where counts were divided by the steps of coarse stamps; and say so.

    Rows of 5 ms have 4, 5 or 6 ms between whole milliseconds, and 20 counts in each are three speeds: times those
    steps they are on a lattice again, and follow the motion more closely. Or on one to the digit, where they are on
    none otherwise, or on half of it: a few steps that are longer halve it.

    Args:
        stamped: rows as they were stamped.
        regular: the same rows at regular times, or others, which are left as they are.
    """
    if len(stamped) != len(regular) or np.array_equal(stamped.time, regular.time):
        return regular, []
    motion, known, told = np.array(regular.motion, np.float64), np.ones(len(regular), np.bool_), []
    for run in regular.runs.values():
        before, steps = (np.diff(one.time[run]).astype(np.float64) for one in (stamped, regular))
        if not np.all(before > 0.0):
            return regular, []
        motion[run][1:] *= before / steps
        known[run.start] = False  # nobody knows its step
        told.append(_compare(np.asarray(regular.time[run] * 1e-9, np.float64), regular.motion[run], motion[run]))
    as_they_are, by_rows = np.sum(told, axis=0)
    step, of_rows = find_lattice(motion[known]), find_lattice(regular.motion[known])
    follows = as_they_are > 0.0 and by_rows < BETTER * as_they_are
    exact = step > COARSER * of_rows and measure_scatter_of_levels(np.abs(motion[known]), step) < EXACT
    if not (step > 0.0 and (follows or exact)):
        return regular, []
    said = "Speeds are counts divided by the steps of those stamps: they are divided by the regular rows (found)."
    return replace(regular, motion=motion), [said]


def _compare(time: Floats, *motions: Floats) -> tuple[float, ...]:
    """Measure how far motions (K,) are beside parabolas over time [s], squared, where the first one is fast."""
    if len(time) < LEAST_ROWS:
        return (0.0,) * len(motions)
    some = slice(0, MOST_ROWS)
    middles = 0.5 * (time[some] + np.append(time[0], time[some][:-1]))
    scatters = [measure_scatter(middles, motion[some]) for motion in motions]
    size = np.abs(motions[0][some])[WINDOW // 2 : -(WINDOW // 2)]
    fast = (size >= np.quantile(size, FASTEST)) & (size > 0.0)
    fast &= scatters[0] <= np.quantile(scatters[0][fast], TRUSTED) if fast.any() else fast
    return tuple(float(np.sum(scatter[fast])) for scatter in scatters)
