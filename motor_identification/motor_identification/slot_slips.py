"""The disc as its own index pulse: irregular slots tell where on the disc every counted run of edges was.

Between two runs the shaft swung, and a simulated travel bridges the gap, off by some slots. Given the table of slots,
every run says how likely each place on the disc is, and the most likely path through all runs is taken; table and path
in turns.
"""

import numpy as np

from motor_identification.recording import Bools, Floats, Integers
from motor_identification.slip_path import spread, trace
from motor_identification.slots import SlotIndex, SlotTable
from motor_model.compiled import compiled

FARTHEST = 16  # slots
PRICE = 5.0  # of a slip by one slot from one run to the next, in natural logarithms of likelihood


def aligned(table: SlotTable, white: Floats, offsets: Floats) -> SlotIndex:
    """Where every run most likely was under a table's offsets [rad] (2N,), from whitened residuals (I,)."""
    index, whitening = table.index, table.whitening
    n = index.size // 2
    farthest = min(FARTHEST, (n - 1) // 2)
    run = np.cumsum(whitening.fresh) - 1
    scores = np.zeros((run[-1] + 1, 2 * farthest + 1))
    for k, slip in enumerate(range(-farthest, farthest + 1)):
        moved = np.append(np.roll(offsets.reshape(2, n), -slip, axis=1), 0.0)
        _fill_scores(
            whitening.fresh, whitening.gain, whitening.scale, index.first, index.last, moved, white, run, scores[:, k]
        )
    slips = np.zeros(len(scores), dtype=np.int64)
    _fill_path(scores, slips)
    return _moved(index, (slips - farthest)[run]) if np.any(slips != farthest) else index


def _moved(index: SlotIndex, slip: Integers) -> SlotIndex:
    """The index with every interval so many slots further on the disc."""
    n = index.size // 2

    def on(entry: Integers) -> Integers:
        there = np.where(entry >= n, n, 0) + (entry % n + slip) % n
        return np.asarray(np.where(entry >= 0, there, entry))

    return SlotIndex(on(index.first), on(index.last), index.size)


@compiled
def _fill_scores(
    fresh: Bools, gain: Floats, scale: Floats, first: Integers, last: Integers, table: Floats, white: Floats,
    run: Integers, scores: Floats,
) -> None:  # fmt: skip
    """Add the logarithmic likelihood of every run under a table of shape (2N + 1,) that ends on 0."""
    carried = 0.0
    for k in range(len(fresh)):
        innovation = table[last[k]] - table[first[k]] + (0.0 if fresh[k] else carried)
        scores[run[k]] -= 0.5 * (white[k] - innovation * scale[k]) ** 2
        carried = (1.0 - gain[k]) * innovation


@compiled
def _fill_path(scores: Floats, slips: Integers) -> None:
    """Fill the most likely column of every row, each slip from one row to the next at its price."""
    rows, width = scores.shape
    origin = np.zeros((rows, width), dtype=np.int64)
    best = scores[0] - PRICE * np.abs(np.arange(width) - width // 2)
    for r in range(1, rows):
        spread(best, origin[r], PRICE)
        best += scores[r]
    trace(origin, int(np.argmax(best)), slips)
