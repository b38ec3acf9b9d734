"""Paths of slips: how far each counted run is off, where a slip from one run to the next has a price for every step.

The most likely path is found by dynamic programming (A. Viterbi, IEEE Trans. Inf. Theory 13(2), 1967). A price that
grows by the step makes the best way to every slip one look from either side (a distance transform).
"""

from motor_identification.recording import Floats, Integers
from motor_model.compiled import compiled


@compiled
def spread(best: Floats, origin: Integers, price: float) -> None:
    """Let the score of the best way to every slip (W,) come from any slip of the run before, which goes to `origin`."""
    width = len(best)
    for k in range(width):
        origin[k] = k
    for k in range(1, width):
        if best[k - 1] - price > best[k]:
            best[k], origin[k] = best[k - 1] - price, origin[k - 1]
    for k in range(width - 2, -1, -1):
        if best[k + 1] - price > best[k]:
            best[k], origin[k] = best[k + 1] - price, origin[k + 1]


@compiled
def trace(origin: Integers, last: int, path: Integers) -> None:
    """Fill the path (B,) that ends on a slip, from where every run's came, (B, W)."""
    k = last
    for b in range(len(origin) - 1, -1, -1):
        path[b] = k
        k = origin[b, k]
