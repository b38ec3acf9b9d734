"""Measure the share of edges that a sensor misses, where it stamps each sample's latest two and counts the others.

Between those two there is one slot, however many edges are missed elsewhere, so that their time tells the speed; of the
edges from one pair to the next the same share is missed all the time. No model sees that, for which it is a slower
motor; the pairs around show how many there were. A pair itself spans two slots as often as an edge within it is missed.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np

from motor_identification.recording import Bools, Floats, Integers

EVEN = 0.2  # of their mean: what the times of the pairs before and after differ by, at most
# Times what its edges take at the speed of those pairs, and the reverse: beyond, both pairs span two slots, or a stamp
# is wrong.
LONGEST = 1.5
TWICE = (1.5, 2.7)  # slots that a pair spans where an edge within it was missed
# Of all edges, the least share: a disc whose flanks are off by a twentieth of a slot, as none is, makes pairs that come
# just before a sample shorter by the square of that. Measured: 0.0015 ± 0.0002 of a disc that is off by 1 %.
LEAST_SHARE = 0.005
# Edges that are missed from pair to pair, usually: of fewer most such ways lack none, and the others are seen by whole
# slots. Measured: every tenth way that is false costs a motor with friction nothing, and many ways say more than pairs.
OFTEN = 0.2
CERTAIN = 5.0  # standard errors that it is, at least
LIKELY = 3.0  # standard deviations by which fewer pairs may span two slots than that share of them


@dataclass(frozen=True)
class MissedShare:
    """The share of all edges that was missed, and its standard error."""

    share: float
    error: float


def measure_missed_share(time: Floats, count: Integers, one_way: Bools) -> MissedShare | None:
    """Measure it from edges (E,) at `time` [s], and between which the disc turned one way (E − 1,).

    None where none are missed, or few from pair to pair.
    """
    slots, length = np.abs(np.diff(count)), np.diff(time)
    if len(slots) < 3:
        return None
    between, lasted = slots[1:-1], length[1:-1]
    sure = one_way[:-2] & one_way[1:-1] & one_way[2:]
    around = 0.5 * (length[:-2] + length[2:])
    even = sure & (np.abs(length[:-2] - length[2:]) < EVEN * around)
    paired = np.flatnonzero(even & (slots[:-2] == 1) & (slots[2:] == 1) & (between > 1))
    passed = lasted[paired] / around[paired]
    kept = (between[paired] * LONGEST > passed) & (between[paired] < LONGEST * passed)
    passed, counted = passed[kept] - 1.0, between[paired][kept] - 1  # the edge at the end was not missed
    if not len(counted):
        return None
    share = 1.0 - float(counted.sum() / passed.sum())
    error = float(np.sqrt(np.sum((counted - (1.0 - share) * passed) ** 2)) / passed.sum())
    if share < max(LEAST_SHARE, CERTAIN * error) or share * float(np.median(counted)) < OFTEN:
        return None
    return MissedShare(share, error) if _are_pairs_long(slots, length, sure, share) else None


def _are_pairs_long(slots: Integers, length: Floats, sure: Bools, share: float) -> bool:
    """Whether as many pairs span two slots as edges are missed: no unevenness of a disc makes any so long."""
    before, after = length[:-2] / np.maximum(slots[:-2], 1), length[2:] / np.maximum(slots[2:], 1)
    even = np.abs(before - after) < EVEN * 0.5 * (before + after)
    alone = sure & even & (slots[1:-1] == 1) & (slots[:-2] > 1) & (slots[2:] > 1)
    long = int(np.count_nonzero(mark_long_pairs(slots, length)[1:-1][alone]))
    expected = share * np.count_nonzero(alone)
    return long > 0 and expected - long < LIKELY * sqrt(expected)


def mark_long_pairs(slots: Integers, length: Floats) -> Bools:
    """Mark the intervals of one slot that span two at the speed before and after, whichever is nearer; shapes (I,)."""
    long = np.zeros(len(slots), dtype=bool)
    usual = length / np.maximum(slots, 1)  # [s] of one slot
    around = np.maximum(usual[:-2], usual[2:])
    spans = (length[1:-1] > TWICE[0] * around) & (length[1:-1] < TWICE[1] * around)
    long[1:-1] = (slots[1:-1] == 1) & spans
    return long


def average_shares(shares: Sequence[MissedShare | None]) -> MissedShare | None:
    """Average what was measured of one sensor in several recordings; None where it was in none of them."""
    known = [one for one in shares if one is not None]
    if not known:
        return None
    weights = np.array([one.error**-2.0 for one in known])
    return MissedShare(float(weights @ [one.share for one in known] / weights.sum()), float(weights.sum()) ** -0.5)
