"""Lay the rows of a log onto all rows that its program made, of which some were not logged.

A filter runs on the board, where no row is missing: what went into it is computed on whole rows. A value that was not
logged is first what lies between its neighbours. By how much that is off shows behind the filter, in a pattern of its
own, and is found by least squares: what went in is near to what came out so much later as the filter is late.
"""

from collections.abc import Callable

import numpy as np

from motor_identification.recording import Bools, Floats, Integers

FADED = 1e-3  # of a pattern's largest part: what is less is left out
# Rounds of conjugate gradients, after which the normal equations are solved, nearly banded as they are. Measured: 40 to
# 400 of means; as many as there are unknowns, some minutes of 30,000, of a Butterworth filter's two zeros beside.
ROUNDS = 500
TINY = 1e-12  # of the largest sum of squares, by which no pattern is without one


def undo_on_whole_rows(
    undo: Callable[[Floats], Floats], values: Floats, number: Integers, delay: float, first: int
) -> Floats:
    """Undo a filter on whole rows (R,), of values (K,) that were logged of the rows of these numbers.

    undo: linear but for a constant. delay: [rows] how late it makes values. first: so many rows hold what was in the
    filter before the log, which is found as what is missing is.
    """
    every = np.arange(int(number[-1]) + 1)
    whole = np.interp(every, number, values)
    went_in = undo(whole)
    impulse: Floats = np.zeros(len(every))
    impulse[1] = 1.0
    pattern = undo(impulse)[1:]
    unknown = np.union1d(every[1 : first + 1], np.setdiff1d(every, number))
    logged = np.isin(every, number)
    beside = went_in - np.interp(every + delay, every, whole)
    return np.asarray(went_in - _fit_patterns(pattern, unknown, np.where(logged, beside, 0.0), logged))


def _fit_patterns(pattern: Floats, begin: Integers, values: Floats, counted: Bools) -> Floats:
    """Fit a pattern that begins at each of some rows to values (R,) at rows that count, and return what it comes to."""
    from scipy.sparse import coo_matrix, diags, identity
    from scipy.sparse.linalg import lsqr, splu

    lasting = np.flatnonzero(np.abs(pattern) > FADED * np.max(np.abs(pattern)))
    row, column = (part.ravel() for part in np.meshgrid(lasting, np.arange(len(begin)), indexing="ij"))
    at, size = row + begin[column], pattern[row]
    inside = at < len(values)
    patterns = coo_matrix((size[inside], (at[inside], column[inside])), shape=(len(values), len(begin))).tocsr()
    seen = diags(counted.astype(np.float64)) @ patterns
    sizes, _, rounds, *_ = lsqr(seen, values, iter_lim=ROUNDS)
    if rounds == ROUNDS:
        products = (seen.T @ seen).tocsc()
        products += TINY * products.diagonal().max() * identity(len(begin), format="csc")
        sizes = splu(products, "NATURAL", 0.0, options={"SymmetricMode": True}).solve(seen.T @ values)
    return np.asarray(patterns @ sizes)
