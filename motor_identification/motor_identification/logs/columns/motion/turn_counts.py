"""How many counts a turn has, and whether they begin anew in every row, where a speed stands beside the counts."""

from dataclasses import dataclass, replace
from math import inf, tau

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.motion.movement import guess_speed_unit
from motor_identification.logs.columns.notes import Notes
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.columns.vocabulary import UNITS, Quantity
from motor_identification.logs.correlation import correlate
from motor_identification.logs.count_size import MOST_EDGES
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import Kind

Floats = NDArray[np.float64]

PARTS, FEWEST_PARTS = 40, 5  # of a log, over which both are summed up: a row's count and speed are both coarse
AGREE = 0.999  # correlation of the counts of a part with its angle: the speed was made of these counts
NEAR = 0.02  # from a whole number, relative to it, that the counts of a turn may be off; of few
MOST_PLACES = 7  # behind the point, of a digit
FEWEST_LEVELS = 5  # of counts in a row: what is cut off of fewer grows with them
TINY, HUGE = 1e-100, 1e100  # [rad] of a part: a speed of less, or more, is none
SENSOR_TURNS = (1024, 4096, 16384)  # counts of magnetic sensors: 10, 12, 14 bits
NEARLY, FEWEST_WRAPS = 0.97, 3  # of a turn that is reached; jumps that tell
ALIKE, TOLD = 1.1, 0.01  # times what fits the rows best; share of the counts that does not matter then


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
    open_kind = said.kind in (None, Kind.COUNT) and said.unit in (None, "count")
    counts = heading.quantity is Quantity.COUNT
    if (
        not open_kind
        or not (counts or _is_whole_position(table, heading))
        or said.edges_per_revolution is not None
        or stamps is None
    ):
        return said
    found = find_turn_counts(table, heading, stamps)
    turn = None if found or said.wrap else _find_turn(table.numbers(pair.motion), heading)
    if turn is not None and said.increments is not True:
        notes.findings.append(
            f"{pair.motion}: {turn} counts a turn, where they begin again (assumed; otherwise: --edges-per-revolution)."
        )
        return replace(said, edges_per_revolution=turn, kind=Kind.COUNT)
    if (
        found is None
        or (found.anew and not counts)
        or (said.increments is not None and said.increments is not found.anew)
    ):
        return said
    since = "since the row before" if found.anew else "from the beginning"
    notes.findings.append(
        f"{pair.motion}: {found.counts} counts a turn, counted {since}, as {found.column} in {found.unit} says "
        "(otherwise: --edges-per-revolution)."
    )
    kind = said.kind if counts else Kind.COUNT
    return replace(said, edges_per_revolution=found.counts, increments=found.anew, kind=kind)


def _find_turn(values: Floats, heading: Heading) -> int | None:
    """Find the counts of a turn of a magnetic sensor, whose numbers, shape (K,), begin again at 0 after the last."""
    angles = heading.quantity is Quantity.POSITION or bool({"raw", "angle"} & set(heading.words))
    largest = float(np.max(values, initial=0.0))
    for turn in SENSOR_TURNS:
        if angles and NEARLY * turn < largest < turn and np.min(values) >= 0.0:
            jumps = np.abs(np.diff(values)) > 0.5 * turn
            return turn if int(np.count_nonzero(jumps)) >= FEWEST_WRAPS else None
    return None


def _is_whole_position(table: Table, heading: Heading) -> bool:
    """Whether a position of an unknown unit is in whole numbers: those of its counts, or degrees."""
    if heading.quantity is not Quantity.POSITION or heading.unit:
        return False
    return not np.any(table.numbers(heading.name) % 1.0)


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
        unit = heading.unit or guess_speed_unit(speeds, period, stamps).name
        size = UNITS[unit][1] if unit else None
        if size is None:
            continue
        angle = np.where(forward, speeds[1:] * size * steps, 0.0)
        digit = np.where(forward, _find_last_digit(speeds) * size * steps, 0.0)
        for way, anew in ways:
            counts = _counts_per_turn(way, angle, digit)
            if counts is not None:
                return TurnCounts(counts, anew, name, unit)
    return None


def _counts_per_turn(way: Floats, angle: Floats, step: Floats) -> int | None:
    """Whole counts of a turn, of counts and angles [rad] of the rows, shape (K - 1,); None where they do not agree.

    step: [rad] of one digit of the speed in each row. Firmware rounds, or cuts what is behind the digit off: what fits
    the rows better; None where both fit alike and differ.
    """
    told = angle != 0.0  # less than a digit may be cut off
    as_it_is = _fit_counts(way[told], np.abs(angle[told]))
    if as_it_is is None:
        return None
    as_cut = _fit_counts(way[told], np.abs(angle[told]) + 0.5 * step[told]) or (as_it_is[0], inf)
    (rounded, off), (cut, off_cut) = as_it_is, as_cut
    number = rounded if off <= off_cut else cut
    few = len(np.unique(np.abs(way[told]))) < FEWEST_LEVELS
    alike = few or max(off, off_cut) < ALIKE * min(off, off_cut)
    whole = round(number)
    if not 1 <= whole <= MOST_EDGES or abs(number - whole) > NEAR * whole:
        return None
    return None if alike and abs(rounded - cut) > max(TOLD * number, 0.5) else whole


def _find_last_digit(values: Floats) -> float:
    """Find the largest 1, 2 or 5 of a decimal place that all values are multiples of, to tens; 0 where none is."""
    digits = (10.0**place * unit for place in range(0, -MOST_PLACES, -1) for unit in (10.0, 5.0, 2.0, 1.0))
    return next((one for one in digits if np.allclose(values / one, np.rint(values / one), rtol=0.0, atol=1e-6)), 0.0)


def _fit_counts(way: Floats, angle: Floats) -> tuple[float, float] | None:
    """Counts of a turn that fit sizes of angles [rad] (K,), and what they leave in the rows, RMS [rad]."""
    ends = np.unique(np.linspace(0, len(way), min(PARTS, len(way) // 3) + 1).astype(np.int64))
    if len(ends) <= FEWEST_PARTS:
        return None
    counted, turned = np.add.reduceat(np.abs(way), ends[:-1]), np.add.reduceat(angle, ends[:-1])
    if correlate(counted, turned) < AGREE or not TINY < float(np.max(turned)) < HUGE:
        return None
    number = tau * float(counted @ turned) / float(turned @ turned)
    return number, float(np.sqrt(np.mean((angle - tau / number * np.abs(way)) ** 2)))
