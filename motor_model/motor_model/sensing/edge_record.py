"""Record edges as a board does: count, stamp of the latest, period, one after the other as they come in a sample.

Two channels: where the shaft comes out of the hole at which it went in, the edge is taken back. Counted two- or
fourfold, a period is the mean from edge to edge over the latest period of channel A, as far as the shaft went one way.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled

POWER_UP = 1_000_000_000  # [ns] the board's clock at the first sample: no edge can be at its 0, which means "none yet"
LATEST = 5  # stamps that a period is averaged over: four edges, from flank to flank

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


class EdgeRecord(NamedTuple):
    """What a board remembers of its edges."""

    edges: int  # two channels: up and down
    time: int  # [ns] of the latest; 0: none yet
    period: float  # [s] 0: not known
    direction: int  # of the latest
    entered: int  # two channels: how A's rising edge was passed, 0 while A is low
    undone: bool  # the latest edge took one back
    passed: int  # edges passed one way whose stamps are kept


NO_EDGES = EdgeRecord(0, 0, 0.0, 0, 0, False, 0)


@compiled
def stamp_edge(time: float, tick: float) -> int:
    """Stamp an edge at a time [s] on the board's clock [ns], whose timer counts ticks [s]; 0: it is exact."""
    exact = time // tick * tick * 1e9 if tick > 0.0 else time * 1e9
    return int(np.rint(exact)) + POWER_UP


@compiled
def record_edges(
    record: EdgeRecord,
    stamps: Integers,
    times: Floats,
    directions: Integers,
    tick: float,
    single: bool,
    quadrature: int,
) -> EdgeRecord:
    """Record edges at times [s] in directions (±1, falling edges ±2); stamps [ns], of shape (LATEST,), are kept."""
    edges, latest, period, direction, entered, undone, passed = record
    for k in range(len(times)):
        sign, falls = (1 if directions[k] > 0 else -1), abs(directions[k]) == 2
        undoes = falls and entered == -sign
        entered = 0 if falls else sign
        if falls and not undoes:
            continue
        stamp = stamp_edge(times[k], tick)
        known = latest > 0 and not undoes and not undone  # the same flank twice is no travel
        period = (stamp - latest) * 1e-9 if known else 0.0
        if quadrature > 1:
            kept = 0 if sign != direction else min(passed, quadrature)
            for j in range(kept, 0, -1):
                stamps[j] = stamps[j - 1]
            stamps[0], passed = stamp, kept + 1
            span = 4 if kept >= 4 else 2 if kept >= 2 else kept  # 1, 2 or 4, as on the board
            period = (stamp - stamps[span]) * 1e-9 / span if span > 0 else 0.0
        latest, undone, direction = stamp, undoes, sign
        edges += 1 if single else sign
    return EdgeRecord(edges, latest, period, direction, entered, undone, passed)
