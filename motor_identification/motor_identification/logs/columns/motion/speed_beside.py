"""What a position and a speed of the same shaft tell of each other: units, and which column without a name is one."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import tau

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.clock import read_clock
from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.motion.movement import ASKED, Unit, guess_position_unit
from motor_identification.logs.columns.names.quantity import AXES
from motor_identification.logs.columns.said import Pair
from motor_identification.logs.columns.vocabulary import UNITS, Quantity
from motor_identification.logs.correlation import correlate
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import Kind
from motor_model.errors import RecordingError

Floats = NDArray[np.float64]

PARTS, FEWEST_PARTS = 40, 5  # of a log, over which a way and a speed's integral are compared, as one row is coarse
TOGETHER = 0.95  # their correlation, from which on they are of one shaft
OF_ANOTHER = 0.6  # that correlation, below which they are not
FOLLOWS = 0.8  # a speed's correlation with what drives it, over such parts
MORE = 0.3  # than the position's way has
USUAL_SHARE, JUMP = 0.9, 5.0  # of the steps of a position, and times that, from which on it is a jump
SUMMED_UP = 0.9  # of the rows in motion: there a count goes on by just what another column says
FEWEST_CHANGES = 10  # of a motion: what changes in fewer rows is a drive, or nothing
TILTED = 0.25  # by which that of a gyro may be: its axis is tilted, or it is filtered. Measured: 0.1; units are 6 apart
NEAR = 0.07  # by which the ratio of a pair of units may be off; the nearest two pairs are 5 times apart


@dataclass(frozen=True)
class Counted:
    """A column without a telling name that is the position of which another one is the speed; `whole` if in counts."""

    column: str
    speed: str
    whole: bool = False


def find_counted_position(table: Table, pair: Pair, taken: frozenset[str], stamps: Floats) -> Counted | None:
    """Find the position, of a unit that its numbers tell, of which a motor's column of motion is the speed.

    A position was counted; its speed was computed from it, often filtered, and of a unit that nobody wrote down.

    Args:
        table: the log.
        pair: the motor's columns.
        taken: columns that are something else.
        stamps: times of the rows [s], shape (K,).
    """
    speed = read_heading(pair.motion)
    if speed.quantity not in (Quantity.SPEED, None):  # a system's output `y`, whose numbers go with the position's
        return None
    units = [speed.unit] if speed.unit else [*ASKED[Kind.SPEED], "rev/s"]
    sizes = [size for unit in units if (size := UNITS[unit][1]) is not None]
    for heading in _unnamed(table, taken | {pair.voltage, pair.motion}):
        if heading.side not in (speed.side, ""):
            continue
        ratio = _ratio(table.numbers(heading.name), table.numbers(speed.name), stamps)
        angle = UNITS[unit][1] if ratio and (unit := guess_position_unit(table.numbers(heading.name)).name) else None
        if ratio is not None and angle is not None and any(_is_near(ratio * angle / size) for size in sizes):
            return Counted(heading.name, speed.name)
    return None


def find_summed_counts(table: Table, pair: Pair, taken: frozenset[str]) -> Counted | None:
    """Find the counts, in a column whose name tells nothing, of which a motor's motion is what each row added.

    Args:
        table: the log.
        pair: the motor's columns.
        taken: columns that are something else.
    """
    speed = read_heading(pair.motion)
    if speed.quantity not in (Quantity.SPEED, None) or speed.unit or np.any(table.numbers(pair.motion) % 1.0):
        return None
    named = (heading.name for heading in _unnamed(table, taken | {pair.voltage, pair.motion}))
    sums = next((name for name in named if is_summed_up(table.numbers(name), table.numbers(pair.motion))), None)
    return Counted(sums, pair.motion, whole=True) if sums else None


def is_summed_up(sums: Floats, rows: Floats) -> bool:
    """Whether a column, shape (K,), is the sum of another one, such as counts of those since the row before."""
    ways = np.diff(sums)
    told = ways != 0.0
    return bool(np.count_nonzero(told) > FEWEST_CHANGES and np.mean(ways[told] == rows[1:][told]) > SUMMED_UP)


def find_driven_speed(table: Table, pair: Pair, headings: Sequence[Heading], time: str | None) -> str:
    """Find the speed that follows the drive where the position does not, and is not its integral; empty where none.

    The position is then of something that the motor moves by more than its shaft: the pendulum on a cart, the arm below
    a propeller. Without a column of times rows are taken for regular.
    """
    speeds = [one.name for one in headings if one.quantity is Quantity.SPEED and one.name != pair.motion]
    if len(speeds) != 1 or read_heading(pair.motion).quantity not in (Quantity.POSITION, Quantity.COUNT):
        return ""
    position, drive, speed = (table.numbers(name) for name in (pair.motion, pair.voltage, speeds[0]))
    stamps = np.arange(len(table), dtype=np.float64) if time is None else read_clock(table, time)
    ends = _ends(len(position))
    if len(ends) <= FEWEST_PARTS or len(stamps) != len(position):
        return ""
    went = (_without_jumps(position), *(_travel(values, stamps) for values in (speed, drive, position)))
    way, integral, driven, summed = (np.diff(values[ends]) for values in went)
    if read_heading(pair.motion).quantity is Quantity.COUNT and correlate(summed, integral) > OF_ANOTHER:
        return ""  # counts of each row
    follows, other = correlate(integral, driven), correlate(way, driven)
    apart = abs(correlate(way, integral)) < OF_ANOTHER
    return speeds[0] if apart and abs(follows) > max(FOLLOWS, abs(other) + MORE) else ""


def tell_position_unit(table: Table, position: Heading, stamps: Floats) -> Unit | None:
    """Tell the unit of a position by a speed of a known one beside it; stamps are times of the rows [s], shape (K,)."""
    for name in table.names:
        speed = read_heading(name)
        size = UNITS[speed.unit][1] if speed.quantity is Quantity.SPEED and speed.unit else None
        if size is None or speed.side != position.side:
            continue
        ratio = _ratio(table.numbers(position.name), table.numbers(name), stamps)
        for unit in ("rad", "deg", "rev"):
            if ratio is not None and _is_near(ratio * (UNITS[unit][1] or 1.0) / size):
                return Unit(unit, f"as {name} in {speed.unit} says; otherwise: --unit")
    return None


def tell_speed_unit(table: Table, speed: Heading, stamps: Floats) -> Unit | None:
    """Tell the unit of a speed by the angle beside it of which it is the derivative; stamps [s] of the rows, (K,)."""
    for name, unit in _list_angles(table, speed.side):
        size = UNITS[unit][1] or 1.0
        angle = np.unwrap(table.numbers(name) * size, period=tau) / size
        ratio = _ratio(np.asarray(angle, np.float64), table.numbers(speed.name), stamps)
        for own in (*ASKED[Kind.SPEED], "rev/s"):
            if ratio is not None and abs(ratio * size / (UNITS[own][1] or 1.0) - 1.0) < TILTED:
                return Unit(own, f"as {name} in {unit} says, whose derivative it is; otherwise: --unit")
    return None


def _list_angles(table: Table, side: str) -> Iterator[tuple[str, str]]:
    """The angles of a side in a table, and their units: by their names, or by their numbers."""
    for heading in map(read_heading, table.names):
        orientation = heading.quantity is Quantity.OTHER and heading.words[-1:] and heading.words[-1] in AXES
        if heading.side != side or not (orientation or heading.quantity is Quantity.POSITION):
            continue
        values = table.numbers(heading.name) if bool(table.readable(heading.name).all()) else np.zeros(1)
        unit = heading.unit or guess_position_unit(values).name
        if orientation and not unit and float(np.max(np.abs(values))) > tau:
            unit = "deg"  # as no body is turned by more than a turn
        if unit in ("rad", "deg", "rev"):
            yield heading.name, unit


def _unnamed(table: Table, taken: frozenset[str]) -> Iterator[Heading]:
    """The columns of numbers that change and whose names tell nothing."""
    for name in table.names:
        heading = read_heading(name)
        if name in taken or heading.quantity is not None:
            continue
        try:
            changes = np.ptp(table.numbers(name)) > 0.0
        except RecordingError:  # a column of words
            continue
        if changes:
            yield heading


def _is_near(ratio: float) -> bool:
    return abs(ratio - 1.0) < NEAR


def _ratio(position: Floats, speed: Floats, stamps: Floats) -> float | None:
    """How far a position, shape (K,), goes for a second of speed 1; None where they do not go together.

    As much of the position as of the speed is noise: the ratio of their sizes, and not a regression, tells it; of the
    part where it is furthest off none, as a position may begin again there.
    """
    ends = _ends(len(position))
    way, integral = np.diff(position[ends]), np.diff(_travel(speed, stamps)[ends])
    if len(way) < FEWEST_PARTS or correlate(way, integral) < TOGETHER:
        return None
    with np.errstate(over="ignore"):
        size = float(np.max(np.abs(integral)))
        way, integral = way / size, integral / size
        ratio = float(np.linalg.norm(way)) / float(np.linalg.norm(integral))
        usual = np.arange(len(way)) != np.argmax(np.abs(np.abs(way) - ratio * np.abs(integral)))
        left = float(np.linalg.norm(integral[usual]))
        return float(np.linalg.norm(way[usual])) / left if left > 0.0 else None


def _ends(count: int) -> NDArray[np.int64]:
    """The rows in which the parts of a log of so many rows begin and end."""
    return np.unique(np.linspace(0, count - 1, min(PARTS, count // 3) + 1).astype(np.int64))


def _without_jumps(position: Floats) -> Floats:
    """A position, shape (K,), without the steps by which it begins again somewhere else."""
    steps = np.diff(position, prepend=position[0])
    sizes = np.abs(steps[steps != 0.0])
    usual = np.quantile(sizes, USUAL_SHARE) if len(sizes) else 0.0
    return np.asarray(np.cumsum(np.where(np.abs(steps) > JUMP * usual, 0.0, steps)), dtype=np.float64)


def _travel(speed: Floats, stamps: Floats) -> Floats:
    """The integral of values, shape (K,), over their times, shape (K,), which may begin again."""
    steps = np.diff(stamps, append=stamps[-1:])
    steps[steps < 0.0] = 0.0
    with np.errstate(over="ignore", invalid="ignore"):  # a column of anything
        return np.concatenate(([0.0], np.cumsum(speed[1:] * steps[:-1])))
