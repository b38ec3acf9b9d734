"""Sum the normal equations of a slot table: passes of one visit per interval, whatever the disc.

`angle_noise.py` filters increments d_k = e_k − e_{k−1} of an angle error e into innovations ν with variance
S = 1/scale². Seen from the angle the same filter is

    ν_k = e_k − b_{k−1},   b_k = (1 − K_k) b_{k−1} + K_k e_k,   b = e where a run begins,

so that the row of the whitened table A for interval k is (unit(last_k) − w_{k−1})/√S_k, with w the weights that b gives
to the entries of the table: one vector, carried along. Rows are dense, their products are not needed: what all later
innovations say about b_k is the number

    h_k = Σ_{l>k} 1/S_l·Π_{k<m<l} (1 − K_m)²,   h_{k−1} = 1/S_k + (1 − K_k)² h_k   (0 where a run ends)

(de Jong, Biometrika 75, 1988), and with it AᵀA is a sum over intervals of one weighted copy of w, in row last_k, its
transpose, and a number on the diagonal. Exact, and as long as the recording, times the length of a copy.
"""

import numpy as np

from motor_identification.recording import Bools, Floats, Integers
from motor_model.compiled import compiled

SMALL = 1e-100  # common factor of the weights below which it is multiplied out


@compiled
def fill_foresight(fresh: Bools, gain: Floats, scale: Floats, foresight: Floats) -> None:
    """h_k [1/rad²] of every interval: what the rest of its run says about the filter's state after it."""
    known = 0.0
    for k in range(len(fresh) - 1, -1, -1):
        foresight[k] = known
        known = 0.0 if fresh[k] else scale[k] ** 2 + (1.0 - gain[k]) ** 2 * known


@compiled
def add_to_state(entry: int, amount: float, known: float, common: float, weights: Floats, half: Floats) -> None:
    """Let the filter's state depend on one more entry: all later innovations know of the product with the others."""
    for h in range(len(weights)):
        half[entry, h] += known * amount * common * weights[h]
    half[entry, entry] += 0.5 * known * amount**2
    weights[entry] += amount / common


@compiled
def fill_gram(fresh: Bools, gain: Floats, scale: Floats, first: Integers, last: Integers, half: Floats) -> None:
    """Half of AᵀA, of shape (2N + 1, 2N + 1), zeroed before: the whole is this and its transpose.

    The last row and column take what belongs to ends that are no edge (−1).
    """
    foresight = np.empty(len(fresh))
    fill_foresight(fresh, gain, scale, foresight)
    weights, common = np.zeros(len(half)), 1.0  # the state's weights are common·weights
    for k in range(len(fresh)):
        known = scale[k] ** 2 + (1.0 - gain[k]) ** 2 * foresight[k]  # of the state before this interval
        if fresh[k]:
            weights[:], common = 0.0, 1.0
            add_to_state(first[k], 1.0, known, common, weights, half)
        elif first[k] != last[k - 1]:  # the disc was renumbered within a run
            add_to_state(first[k], 1.0, known, common, weights, half)
            add_to_state(last[k - 1], -1.0, known, common, weights, half)
        shared = common * (scale[k] ** 2 - gain[k] * (1.0 - gain[k]) * foresight[k])
        for h in range(len(weights)):
            half[last[k], h] -= shared * weights[h]
        half[last[k], last[k]] += 0.5 * (scale[k] ** 2 + gain[k] ** 2 * foresight[k])
        common *= 1.0 - gain[k]
        if common < SMALL:
            weights *= common
            common = 1.0
        weights[last[k]] += gain[k] / common


@compiled
def fill_diagonal(fresh: Bools, gain: Floats, scale: Floats, first: Integers, last: Integers, diagonal: Floats) -> None:
    """About the diagonal of AᵀA, added to `diagonal` (2N + 1,): but for what an entry has in the state already."""
    foresight = np.empty(len(fresh))
    fill_foresight(fresh, gain, scale, foresight)
    for k in range(len(fresh)):
        if fresh[k]:
            diagonal[first[k]] += scale[k] ** 2 + (1.0 - gain[k]) ** 2 * foresight[k]
        diagonal[last[k]] += scale[k] ** 2 + gain[k] ** 2 * foresight[k]


@compiled
def fill_scores(
    fresh: Bools, gain: Floats, scale: Floats, first: Integers, last: Integers, white: Floats, sums: Floats
) -> None:
    """Aᵀz of whitened residuals z (I,), added to `sums` (2N + 1,); the last one belongs to ends that are no edge."""
    carried = 0.0
    for k in range(len(fresh) - 1, -1, -1):
        increment = scale[k] * white[k] + carried
        sums[last[k]] += increment
        sums[first[k]] -= increment
        carried = 0.0 if fresh[k] else (1.0 - gain[k - 1]) * increment


@compiled
def fill_explained(
    fresh: Bools, gain: Floats, scale: Floats, first: Integers, last: Integers, table: Floats, white: Floats
) -> None:
    """Take A·table, with a table of shape (2N + 1,) that ends on 0, from whitened residuals (I,)."""
    carried = 0.0
    for k in range(len(fresh)):
        innovation = table[last[k]] - table[first[k]] + (0.0 if fresh[k] else carried)
        white[k] -= innovation * scale[k]
        carried = (1.0 - gain[k]) * innovation
