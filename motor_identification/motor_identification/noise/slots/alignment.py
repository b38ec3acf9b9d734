"""Align counted runs on the disc: its irregular slots tell where each was, as an index pulse would.

Between two runs the shaft swung, and a simulated travel bridges the gap, off by some slots. Given the table of slots,
every run says how likely each place on the disc is, and the most likely path through all runs is taken; table and path
in turns.
"""

import numpy as np

from motor_identification.noise.slots.slot_table import SlotIndex, SlotTable
from motor_identification.noise.viterbi import fill_path
from motor_identification.recording import Floats, Integers

FARTHEST = 16  # slots
PRICE = 5.0  # of a slip by one slot from one run to the next, in natural logarithms of likelihood


def align_slots(table: SlotTable, white: Floats, offsets: Floats) -> SlotIndex:
    """Align every run where it most likely was under a table's offsets [rad] (2N,), by whitened residuals (I,)."""
    index = table.index
    n = index.size // 2
    farthest = min(FARTHEST, (n - 1) // 2)
    run = np.cumsum(table.whitening.fresh) - 1
    scores = np.empty((run[-1] + 1, 2 * farthest + 1))
    for k, slip in enumerate(range(-farthest, farthest + 1)):
        moved = np.roll(offsets.reshape(2, n), -slip, axis=1).ravel()
        scores[:, k] = -0.5 * np.bincount(run, table.left(white, moved) ** 2)
    slips = np.zeros(len(scores), dtype=np.int64)
    fill_path(scores, PRICE, slips)
    return _moved(index, slips[run]) if np.any(slips) else index


def _moved(index: SlotIndex, slip: Integers) -> SlotIndex:
    """The index with every interval so many slots further on the disc."""
    n = index.size // 2

    def on(entry: Integers) -> Integers:
        there = np.where(entry >= n, n, 0) + (entry % n + slip) % n
        return np.asarray(np.where(entry >= 0, there, entry))

    return SlotIndex(on(index.first), on(index.last), index.size)
