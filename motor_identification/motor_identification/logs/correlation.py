"""Correlate two columns of any size: what a file says may be as small or as large as numbers can be."""

from math import isfinite

import numpy as np
from numpy.typing import NDArray


def correlate(one: NDArray[np.float64], other: NDArray[np.float64]) -> float:
    """Correlate two columns, shape (K,), after Pearson; 0 where one of them does not change, or has no size.

    Both are scaled to their largest value first, so that no square overflows, or vanishes.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        both = [column - np.mean(column) for column in (one, other)]
    sizes = [float(np.max(np.abs(column), initial=0.0)) for column in both]
    if not all(isfinite(size) and size > 0.0 for size in sizes):
        return 0.0
    first, second = (column / size for column, size in zip(both, sizes, strict=True))
    return float(first @ second / np.sqrt((first @ first) * (second @ second)))
