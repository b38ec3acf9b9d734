"""Single rows far beyond all others, between two that are alike: what a serial line lost a character of, or gained.

No motor and no controller goes away and comes back to where it was within one row. A point is lost most often: 1902
between 190.4 and 190.12.
"""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

FEWEST_ROWS = 50  # by which it is known how far the others go
MOST = 0.01  # of the rows, or one: more are no accident
FAR = 2.0  # times the size of all other rows
ALIKE = 0.05  # of their size, within which the rows on both sides are, and a number without its point
LONGEST = 3  # digits behind a point that was lost


def find_stray_rows(values: Floats) -> Bools:
    """Which rows, shape (K,), are far beyond all others, and between two that are alike and not 0."""
    size = np.abs(values)
    stray = np.zeros(len(values), np.bool_)
    if len(values) < FEWEST_ROWS:
        return stray
    beside = np.maximum(size[:-2], size[2:])
    with np.errstate(over="ignore"):  # a damaged cell may be any number
        alike = (np.abs(values[2:] - values[:-2]) <= ALIKE * beside) & (beside > 0.0)
    stray[1:-1] = alike & (size[1:-1] / FAR > beside)
    stray &= size / FAR > float(np.max(size[~stray]))
    return stray if np.count_nonzero(stray) <= max(1.0, MOST * len(values)) else np.zeros(len(values), np.bool_)


def restore_points(values: Floats) -> tuple[Floats, Bools]:
    """Give stray rows back a point that they lost: the numbers, shape (K,), and which were mended.

    Whole numbers have none, and a number that is not whole has its own. A row that comes back to the very number before
    it is a kick that somebody gave.
    """
    stray = find_stray_rows(values)
    if not stray.any() or not np.any(values[~stray] % 1.0):
        return values, np.zeros(len(values), np.bool_)
    mended = values.copy()
    for row in np.flatnonzero(stray & (values % 1.0 == 0.0)):
        if values[row - 1] == values[row + 1]:
            continue
        beside = 0.5 * values[row - 1] + 0.5 * values[row + 1]
        for digits in range(1, LONGEST + 1):
            if abs(values[row] / 10.0**digits - beside) <= ALIKE * abs(beside):
                mended[row] = values[row] / 10.0**digits
    return mended, mended != values
