"""Recognise speeds that are running means: counts of the last W rows, of which each row brings one new and drops one.

Of such values n (whole counts) the counts of single rows can be had back, row by row: c(k) = n(k) − n(k−1) + c(k−W),
from a standstill on. With the right W they stay what a motor can do in a row, about n/W; with a wrong one they are the
sum of unrelated changes and walk away at random. A window of one row explains everything, and nothing is learned of it.
"""

from math import ceil

import numpy as np
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from motor_identification.recording import Floats, Integers
from motor_identification.sensor.value_lattice import FINEST, find_lattice

LONGEST = 256  # rows of a window
FEWEST_WINDOWS = 10  # in the motion: a random walk of so many steps leaves the bounds
FEWEST_CHANGES = 20  # each way: a value that only rises fits any window
# Rows of a window of which the lattice is looked for that single rows have, so many times as fine. Measured: 0.6 rpm of
# up to 6,671 where 1,000 edges a turn were counted over ten rows of 10 ms.
MOST_ROWS = 64
MOST_COUNTS = round(FINEST * MOST_ROWS)  # in a window
# Counts that a row may have above the largest mean of a window; and times that mean, in a multiple of a window that
# fits, for a quick motor turns faster within one. Measured: 34 of -31.3 to 32.1 of a motor of 1.7 rows under a command
# that changed more often than its window of 10. Where that is enough, 31 of 1,500 logs of plain counts are such means.
ROOM, PEAK = 1, 1.5
NEAR_MEAN = 0.95  # of the rows in motion have nearly the mean of their window; by jitter and ripple not all
OFF_GRID = 0.2  # of a count: what is farther beside is no count


def find_running_mean(values: Floats) -> int:
    """Find over how many rows speeds (K,) at regular rows are running means of whole counts; 0 where they are none.

    The motor has to stand at first: a first value of 0 says that it did for as long as the window.
    """
    step = _find_step(values, MOST_ROWS)
    if step <= 0.0:
        return 0
    exact = values / step
    counts = np.rint(exact).astype(np.int64)
    change = np.diff(counts)
    stands = len(counts) > 1 and counts[0] == 0
    few = not stands or min(np.count_nonzero(change > 0), np.count_nonzero(change < 0)) < FEWEST_CHANGES
    if few or np.max(np.abs(exact - counts)) > OFF_GRID or np.max(np.abs(counts)) > MOST_COUNTS:
        return 0
    moving = np.flatnonzero(counts)
    longest = min(LONGEST, (len(counts) - int(moving[0])) // FEWEST_WINDOWS)
    # What fits a window fits its divisors, and no neighbours of it; one that is too long here shows as a divisor, too.
    found = _find_longest(counts, longest, 1.0)
    wider = _find_longest(counts, longest, PEAK) if found else 0
    return wider if wider and wider % found == 0 else found


def _find_longest(counts: Integers, longest: int, peak: float) -> int:
    """Find the longest window that counts fit, in rows up to so many times as fast as any mean; 0 of none for sure."""
    fitting = [window for window in range(2, 2 * longest + 2) if _fits(counts, window, peak)]
    sure = fitting and fitting[-1] <= longest and not {fitting[-1] - 1, fitting[-1] + 1} & set(fitting)
    return fitting[-1] if sure else 0


def take_single_rows(values: Floats, window: int) -> Floats | None:
    """Compute what single rows counted, in the values' unit (K,), of running means of whole counts over so many rows.

    What the rows before the first counted is what lies nearest to the means around theirs; nothing, where the first is
    0: the motor stood. None where values are no counts, or no such means from the first to the last.
    """
    step = _find_step(values, window)
    if step <= 0.0 or len(values) < 2 * window:
        return None
    counts = np.rint(values / step).astype(np.int64)
    step = _fit_step(values, counts)
    single = _single_rows(counts, window)
    if counts[0] != 0:
        row = np.arange(len(counts))
        around = np.interp(row + 0.5 * (window - 1), row, counts / window)
        before = np.bincount(row % window, around - single) / np.bincount(row % window)
        single = single + np.rint(before).astype(np.int64)[row % window]
        if int(single[:window].sum()) != counts[window - 1]:
            return None
    return np.asarray(single * (step * window)) if _is_near_mean(single, counts, window) else None


def size_of_count(values: Floats, window: int) -> float:
    """Size what one count is in a single row, in the unit of values (K,) that are running means over so many rows."""
    return _fit_step(values, np.rint(values / _find_step(values, window)).astype(np.int64)) * window


def _find_step(values: Floats, window: int) -> float:
    """Find the step of values (K,) that are counts within so many rows; 0 without.

    Single rows have as fine a one at most as matters to anybody: their mean over N rows has N times as many levels.
    """
    return find_lattice(values) or find_lattice(values, FINEST * min(window, MOST_ROWS))


def _fit_step(values: Floats, counts: Integers) -> float:
    """Fit the step of values that are these counts, each of shape (K,): firmware rounds, and adds to all of them."""
    beside = counts - np.mean(counts)
    return float(beside @ values / (beside @ beside))


def _fits(counts: Integers, window: int, peak: float) -> bool:
    """Whether the counts of single rows, if the window has so many, are what a motor can do."""
    most, least = int(counts.max(initial=0)), int(counts.min(initial=0))
    high = ceil(peak * most / window) + ROOM if most else 0
    low = -ceil(-peak * least / window) - ROOM if least else 0
    single = _single_rows(counts, window)
    return bool(low <= single.min() and single.max() <= high) and _is_near_mean(single, counts, window)


def _is_near_mean(single: Integers, counts: Integers, window: int) -> bool:
    """Whether rows are no farther from the mean than windows near by are from each other: a walk has much room."""
    reach, moving = 2 * window + 1, counts != 0
    change = maximum_filter1d(counts, reach) - minimum_filter1d(counts, reach)
    near = np.abs(single - counts / window) <= change + ROOM
    return bool(np.mean(near[moving]) >= NEAR_MEAN)


def _single_rows(counts: Integers, window: int) -> Integers:
    """Counts of single rows (K,) from those of windows: c(k) = n(k) − n(k−1) + c(k−W), 0 before the first."""
    change = np.diff(counts, prepend=0)
    padded = np.zeros(-(-len(change) // window) * window, np.int64)
    padded[: len(change)] = change
    return np.asarray(np.cumsum(padded.reshape(-1, window), axis=0).ravel()[: len(change)])
