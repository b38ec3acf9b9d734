"""Find the most likely path of slips: how far each counted run is off, at a price for every step of slip.

The most likely path is found by dynamic programming (A. Viterbi, IEEE Trans. Inf. Theory 13(2), 1967).
"""

import numpy as np

from motor_identification.recording import Floats, Integers
from motor_model.compiled import compiled


@compiled
def fill_path(scores: Floats, price: float, slips: Integers) -> float:
    """Fill the best slip of every run (B,), in steps from the middle of scores (B, W); returns what the path scores.

    A price that grows by the step makes the best way to every slip one look from either side (a distance transform).
    """
    runs, width = scores.shape
    origin = np.zeros((runs, width), dtype=np.int64)
    best = -price * np.abs(np.arange(width) - width // 2) + scores[0]
    for b in range(1, runs):
        origin[b] = np.arange(width)
        for k in range(1, width):
            if best[k - 1] - price > best[k]:
                best[k], origin[b, k] = best[k - 1] - price, origin[b, k - 1]
        for k in range(width - 2, -1, -1):
            if best[k + 1] - price > best[k]:
                best[k], origin[b, k] = best[k + 1] - price, origin[b, k + 1]
        best += scores[b]
    last = int(np.argmax(best))
    k = last
    for b in range(runs - 1, -1, -1):
        slips[b] = k - width // 2
        k = origin[b, k]
    return float(best[last])
