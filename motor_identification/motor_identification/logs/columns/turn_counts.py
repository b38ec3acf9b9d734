"""How many counts a turn has, and whether they begin anew in every row, where a speed stands beside the counts."""

from dataclasses import dataclass, replace
from math import tau

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.movement import guess_speed_unit
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.columns.vocabulary import UNITS, Quantity
from motor_identification.logs.count_size import MOST_EDGES
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import Kind

Floats = NDArray[np.float64]

PARTS, FEWEST_PARTS = 40, 5  # of a log, over which both are summed up: a row's count and speed are both coarse
AGREE = 0.999  # correlation of the counts of a part with its angle: the speed was made of these counts
NEAR = 0.02  # from a whole number, relative to it, that the counts of a turn may be off


@dataclass(frozen=True)
class TurnCounts:
    """What a speed says of the counts beside it."""

    counts: int  # in a turn
    anew: bool  # whether a row's count is that since the row before
    column: str  # of the speed
    unit: str


def say_turn_counts(table: Table, pair: Pair, stamps: Floats | None, said: Said, notes: Notes) -> Said:
    """What the user said of a motor's counts; what he left open, a speed beside them tells, and the notes say so.

    Args:
        table: the log.
        pair: the motor's columns.
        stamps: times of the rows [s], shape (K,); None where rows have none.
        said: what the user said.
        notes: gets the finding.
    """
    heading = read_heading(pair.motion)
    open_kind = said.kind in (None, Kind.COUNT) and heading.quantity is Quantity.COUNT and said.unit in (None, "count")
    if not open_kind or said.edges_per_revolution is not None or stamps is None:
        return said
    found = find_turn_counts(table, heading, stamps)
    if found is None or (said.increments is not None and said.increments is not found.anew):
        return said
    since = "since the row before" if found.anew else "from the beginning"
    notes.findings.append(
        f"{pair.motion}: {found.counts} counts a turn, counted {since}, as {found.column} in {found.unit} says "
        "(otherwise: --edges-per-revolution)."
    )
    return replace(said, edges_per_revolution=found.counts, increments=found.anew)


def find_turn_counts(table: Table, count: Heading, stamps: Floats) -> TurnCounts | None:
    """Compare a column of counts with the speeds beside it, row times [s] of shape (K,); None where none agrees."""
    steps = np.diff(stamps)
    forward = steps > 0.0
    if not np.any(forward):
        return None
    period, values = float(np.median(steps[forward])), table.numbers(count.name)
    ways = ((np.where(forward, np.diff(values), 0.0), False), (np.where(forward, values[1:], 0.0), True))
    for name in table.names:
        heading = read_heading(name)
        if heading.quantity is not Quantity.SPEED or heading.side != count.side:
            continue
        speeds = table.numbers(name)
        unit = heading.unit or guess_speed_unit(speeds, period).name
        size = UNITS[unit][1] if unit else None
        if size is None:
            continue
        angle = np.where(forward, speeds[1:] * size * steps, 0.0)
        for way, anew in ways:
            counts = _counts_per_turn(way, angle)
            if counts is not None:
                return TurnCounts(counts, anew, name, unit)
    return None


def _counts_per_turn(way: Floats, angle: Floats) -> int | None:
    """Whole counts of a turn, of counts and angles [rad] of the rows, shape (K - 1,); None where they do not agree."""
    ends = np.unique(np.linspace(0, len(way), min(PARTS, len(way) // 3) + 1).astype(np.int64))
    if len(ends) <= FEWEST_PARTS:
        return None
    counted, turned = np.abs(np.add.reduceat(way, ends[:-1])), np.abs(np.add.reduceat(angle, ends[:-1]))
    if np.ptp(counted) == 0.0 or np.ptp(turned) == 0.0 or np.corrcoef(counted, turned)[0, 1] < AGREE:
        return None
    number = tau * float(counted @ turned) / float(turned @ turned)
    whole = round(number)
    return whole if 1 <= whole <= MOST_EDGES and abs(number - whole) <= NEAR * whole else None
