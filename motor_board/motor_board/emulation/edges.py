"""What the encoder's two lines do, and when: edges as the emulated chip takes them, in cycles of its clock."""

from dataclasses import dataclass
from enum import IntFlag

import numpy as np
from numpy.typing import NDArray


class Line(IntFlag):
    """What the encoder's two lines do at an edge."""

    B_HIGH = 1  # channel B is high there
    A_STAYS = 2  # channel A rises and stays high; without it, it is high for a moment
    A_FALLS = 4
    B_ALONE = 8  # channel A stays as it is


@dataclass(frozen=True)
class Edges:
    """Edges to come: chip cycles, and what the lines do there (`Line`), both of shape (K,) and contiguous."""

    cycle: NDArray[np.uint64]
    what: NDArray[np.uint8]

    @classmethod
    def alike(cls, cycle: NDArray[np.uint64], what: Line) -> "Edges":
        """The same at each of these cycles."""
        return cls(cycle, np.full(len(cycle), what, dtype=np.uint8))

    def joined(self, other: "Edges") -> "Edges":
        """Both, in the order of their cycles."""
        cycle, what = np.concatenate([self.cycle, other.cycle]), np.concatenate([self.what, other.what])
        order = np.argsort(cycle, kind="stable")
        return Edges(cycle[order], what[order])

    def after(self, count: int) -> "Edges":
        """Without the first `count`."""
        return self if count == 0 else Edges(self.cycle[count:], self.what[count:])


NO_EDGES = Edges(np.empty(0, dtype=np.uint64), np.empty(0, dtype=np.uint8))


# What the lines do at A's rising flank, B's, A's falling flank, B's; passed forward and backward.
A_UP, A_DOWN, B_ALONE, B_HIGH = Line.A_STAYS, Line.A_FALLS, Line.B_ALONE, Line.B_HIGH
FORWARD = np.array([A_UP, B_ALONE | B_HIGH, A_DOWN | B_HIGH, B_ALONE], dtype=np.uint8)
BACKWARD = np.array([A_DOWN, B_ALONE, A_UP | B_HIGH, B_ALONE | B_HIGH], dtype=np.uint8)
LEVELS = np.array([A_UP, A_UP | B_HIGH, A_DOWN | B_HIGH, A_DOWN], dtype=np.uint8)  # between that flank and the next
# The same at A's flanks alone, falling and rising backward (-2, -1), none, rising and falling forward (1, 2): of one
# channel, and of two. B is a quarter of a slot behind A.
CAPTURES = np.array([[A_DOWN, B_HIGH, 0, 0, A_DOWN | B_HIGH], [A_DOWN, A_UP | B_HIGH, 0, A_UP, A_DOWN | B_HIGH]])
CAPTURES = CAPTURES.astype(np.uint8)


def edges_at_captures(cycle: NDArray[np.uint64], directions: NDArray[np.int64], two: bool) -> Edges:
    """Describe edges of channel A, with B's level there, to a board that stamps A's edges only.

    Args:
        cycle: [cycle] ascending, shape (K,).
        directions: 1 or −1 where A rises with the shaft turning forward or backward, 2 or −2 where it falls.
        two: the encoder has two channels, so that A stays high until it falls.
    """
    return Edges(cycle, CAPTURES[int(two)][directions + 2])


def edges_at_flanks(cycle: NDArray[np.uint64], directions: NDArray[np.int64], first: int) -> Edges:
    """Describe every flank of both lines.

    Args:
        cycle: [cycle] ascending, shape (K,).
        directions: 1 or −1 as the shaft passes a flank forward or backward.
        first: number of the flank ahead of the shaft before any of these; 0 is A's rise.
    """
    after = first + np.cumsum(directions)
    what = np.where(directions > 0, FORWARD[(after - 1) % 4], BACKWARD[after % 4])
    return Edges(cycle, what.astype(np.uint8))


def level_before(first: int) -> Edges:
    """Set the lines, at power-up, to their levels before the flank of that number."""
    return Edges(np.array([1], dtype=np.uint64), LEVELS[[(first - 1) % 4]])
