"""Which column is which: those that were named by the user, then by their names, then by how their numbers behave."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.behaviour import (
    commands_beside_control,
    ends_of_a_loop,
    find_position,
    follows,
    named_motors,
    numbered_motors,
    present_values,
    pulses_that_drive,
    share_one_drive,
    speeds_called_v,
)
from motor_identification.logs.columns.clock import find_clock, read_clock, runs_forward, since_1970
from motor_identification.logs.columns.drive import drives, is_supply, leave_out_idle_efforts
from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.notes import ask_column, ask_drive, ask_motion, miss_drive, miss_motion
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.columns.speed_beside import find_driven_speed
from motor_identification.logs.columns.vocabulary import FILTERED, MEASURED, MOVES, RAW, UNITS, Quantity
from motor_identification.logs.correlation import correlate
from motor_identification.logs.csv.table import Table
from motor_identification.logs.rows.constant_voltage import CONSTANT
from motor_model.errors import RecordingError

Floats = NDArray[np.float64]

SAME_MOTION = 0.9995  # correlation of a motion with itself in another unit, which is rounded
SAME_CLOCK = 0.9999  # correlation of two columns of times
MOSTLY = 0.5  # of its cells are numbers: else it holds notes beside the table, whatever its name
SUMMED_UP = 0.9  # of the rows in motion: there a count goes on by just what another column says
STEADY = 0.7  # of its largest value: a battery stays above
UNEVEN = 0.2  # of their mean: steps of a column that may be a motor's way
BOTH_WAYS = 0.2  # of the largest speed, which a motor has the other way
FEWEST_CHANGES = 10  # of a motion: what changes in fewer rows is a drive, or nothing
_BEST_FIRST = (Quantity.COUNT, Quantity.POSITION, Quantity.SPEED)  # what was counted is exact; a speed was computed


@dataclass(frozen=True)
class Roles:
    """Names of columns; None where there is none, or where every row is a steady state."""

    time: str | None
    pairs: tuple[Pair, ...]
    supply: str | None
    current: str | None
    left_out: tuple[str, ...] = ()  # motions that nothing drives, beside motors that something does
    findings: tuple[str, ...] = ()  # what was found of them by their numbers


def find_roles(table: Table, said: Said) -> Roles:
    """Find the columns of the motors in a table.

    Raises:
        RecordingError: a column is not there, or which one is meant cannot be told: the sentence asks for it.
    """
    headings = [read_heading(name) for name in table.names if _is_numeric(table, name)]
    time = said.time or (None if said.steady else _time_of(table, headings))
    if said.time:
        table.column(said.time)
    others = [heading for heading in headings if heading.name not in (time, said.supply)]
    free = ends_of_a_loop(
        [one for one in others if one.quantity is not None or not _numbers_rows(table, one.name, time)]
    )
    free = commands_beside_control(table, leave_out_idle_efforts(table, free))
    free = share_one_drive(
        table, numbered_motors(speeds_called_v(table, present_values(pulses_that_drive(table, free))))
    )
    free, unlike = (free, ()) if said.motors or said.motion or said.voltage else named_motors(free)
    free, undriven = ([*free], ()) if said.motors or said.motion or said.voltage else _driven_sides(free)
    pairs = said.motors or _pairs(table, free, said, time)
    pairs, findings = _of_one_shaft(table, pairs, free, said, time)
    supply = said.supply or _supply_of(table, free, pairs)
    named = {pair.voltage for pair in pairs} | {pair.motion for pair in pairs} | {supply}
    currents = [one.name for one in free if one.quantity is Quantity.CURRENT and one.name not in named]
    return Roles(
        time,
        pairs,
        supply,
        currents[0] if len(currents) == 1 and len(pairs) == 1 else None,
        (*unlike, *undriven),
        findings,
    )


def _is_numeric(table: Table, name: str) -> bool:
    try:
        table.numbers(name)
    except RecordingError:
        # Garbage in a column of numbers is told when it is used; a column of words or times of day is none of ours.
        heading = read_heading(name)
        return heading.quantity not in (None, Quantity.OTHER) and (
            heading.quantity is Quantity.TIME or float(np.mean(table.readable(name))) > MOSTLY
        )
    return True


def _time_of(table: Table, headings: Sequence[Heading]) -> str | None:
    named = [heading.name for heading in headings if heading.quantity is Quantity.TIME]
    if len(named) > 1:
        times = {name: read_clock(table, name) for name in named}
        forward = [name for name in named if runs_forward(times[name])]
        # A computer's clock says when rows came to it, the board's when they were made.
        named = sorted(forward, key=lambda name: bool(since_1970(times[name]))) or named
    if named:
        return named[0]
    unnamed = {one.name: table.numbers(one.name) for one in headings if one.quantity is None}
    return find_clock({name: values for name, values in unnamed.items() if not _is_way(table, name, unnamed)})


def _is_way(table: Table, name: str, columns: Mapping[str, Floats]) -> bool:
    """Whether a column goes on by what another one is, and not evenly: the way of a motor, and no clock."""
    steps = np.diff(columns[name])
    with np.errstate(over="ignore", invalid="ignore"):  # a column of anything
        even = not np.std(steps) >= UNEVEN * np.mean(steps)
    if even:
        return False
    return any(find_position(table, (name, other), None) == name for other in columns if other != name)


def _numbers_rows(table: Table, name: str, time: str | None) -> bool:
    """Whether a column is another clock's times of the same rows, as where each channel has an X of its own.

    Or their numbers, as programs write before each row.
    """
    if time is None:
        return False
    values, times = table.numbers(name), read_clock(table, time)
    if len(table) > FEWEST_CHANGES and np.array_equal(values, values[0] + np.arange(len(values))):
        return True
    if len(times) != len(values) or not runs_forward(values) or np.ptp(times) <= 0.0:
        return False
    return correlate(values, times) > SAME_CLOCK and bool(abs(np.ptp(values) / np.ptp(times) - 1.0) < 0.01)


def _driven_sides(headings: Sequence[Heading]) -> tuple[list[Heading], tuple[str, ...]]:
    """Leave out a side's motions that nothing drives, where every drive is another side's: they are named."""
    sides = {one.side for one in headings if drives(one)}
    if not sides or "" in sides:
        return list(headings), ()
    undriven = [one for one in headings if one.quantity in MOVES and one.side and one.side not in sides]
    if all(one in undriven for one in headings if one.quantity in MOVES and one.side):
        return list(headings), ()  # pwm_left beside speed 2: no sides of one machine
    return [one for one in headings if one not in undriven], tuple(one.name for one in undriven)


def _pairs(table: Table, headings: Sequence[Heading], said: Said, time: str | None) -> tuple[Pair, ...]:
    """The motors: one for each side that has a motion, or the only one."""
    moving = [one for one in headings if one.quantity in MOVES]
    sides = sorted({one.side for one in moving if one.side})
    if said.motion or said.voltage or len(sides) < 2:
        return (_single(table, headings, said, time),)
    found = []
    for side in sides:
        own = [one for one in headings if one.side in (side, "")]
        found.append(Pair(side, _driving(table, own, side, ()), _moving(table, own, side, None, said.unit)))
    return tuple(found)


def _single(table: Table, headings: Sequence[Heading], said: Said, time: str | None) -> Pair:
    if said.motion:
        table.column(said.motion)
    if said.voltage:
        table.column(said.voltage)
    motion = said.motion or ""
    voltage = said.voltage or ""
    rest = [one for one in headings if one.name not in (motion, voltage)]
    if not voltage and not motion and not any(map(drives, rest)) and not any(one.quantity in MOVES for one in rest):
        return _by_behaviour(table, rest, time)
    if not voltage and not motion and (channels := _two_channels(table, rest)):
        return channels
    side = read_heading(motion or voltage).side  # of two motors, the one that was named
    motion = motion or _moving(table, rest, side, time, said.unit)
    voltage = voltage or _driving(table, [one for one in rest if one.name != motion], side, ("",))
    return Pair("", voltage, motion)


def _two_channels(table: Table, headings: Sequence[Heading]) -> Pair | None:
    """Of two voltages, as an oscilloscope records them, the drive and the tachogenerator's that follows it."""
    volts = [one.name for one in headings if one.quantity is Quantity.VOLTAGE]
    others = [one for one in headings if one.quantity in MOVES or one.quantity in (None, Quantity.DUTY)]
    if len(volts) != 2 or others:
        return None
    return next((Pair("", one, other) for one, other in (volts, volts[::-1]) if follows(table, other, one)), None)


def _of_one_shaft(
    table: Table, pairs: tuple[Pair, ...], headings: Sequence[Heading], said: Said, time: str | None
) -> tuple[tuple[Pair, ...], tuple[str, ...]]:
    """The motor with its speed instead of a position that is not its own, and what is said of columns without names."""
    if said.motion or said.motors or len(pairs) != 1:
        return pairs, ()
    (pair,) = pairs
    kinds = {one.quantity for one in headings if one.name in (pair.voltage, pair.motion)}
    alike = kinds in ({None}, {Quantity.VOLTAGE})
    if alike and not said.voltage and follows(table, pair.motion, pair.voltage):
        return pairs, (
            f"{pair.voltage} drives and {pair.motion} moves, as that follows it (assumed; otherwise: --voltage).",
        )
    speed = "" if said.unit else find_driven_speed(table, pair, headings, time)
    if not speed:
        return pairs, ()
    return (replace(pair, motion=speed),), (
        f"Left out: {pair.motion}, which is not the angle of what turns with {speed}, and does not follow "
        f"{pair.voltage} (otherwise: --position {pair.motion}).",
    )


def _by_behaviour(table: Table, headings: Sequence[Heading], time: str | None) -> Pair:
    """Columns without telling names: a drive beside a motion, or beside a position and its speed."""
    unnamed = _unnamed(table, headings)
    changes = {name: np.count_nonzero(np.diff(table.numbers(name))) for name in unnamed}
    drive, *others = sorted(unnamed, key=lambda name: changes[name]) or [""]
    fewest = min((changes[name] for name in others), default=0)
    position = (find_position(table, others, time) if len(others) == 2 else others[0]) if len(others) in (1, 2) else ""
    if not position or fewest < max(2 * changes[drive] + 1, FEWEST_CHANGES):
        for one, other in ((drive, *others), (*others, drive)) if len(others) == 1 else ():
            if follows(table, other, one):
                return Pair("", one, other)
        still = [one.name for one in headings if one.quantity is None and not np.any(table.numbers(one.name))]
        if still and len(unnamed) == 1:
            raise miss_motion(table, still[0], unnamed[0])
        if len(unnamed) == 1 or (len(unnamed) == 2 and find_position(table, unnamed, time)):
            raise miss_drive(table)
        raise ask_drive(table, unnamed or table.names)
    return Pair("", drive, position)  # what drives changes in fewer rows, and to fewer values


def _unnamed(table: Table, headings: Sequence[Heading]) -> list[str]:
    """Columns whose names tell nothing, without those of nothing but zeros: a log of one step has a constant drive."""
    return [one.name for one in headings if one.quantity is None and np.any(table.numbers(one.name))]


def _moving(
    table: Table, headings: Sequence[Heading], side: str, time: str | None = None, unit: str | None = None
) -> str:
    """Name the column of motion; a unit that was said is one of its kind, if there is one."""
    told = UNITS[unit][0] if unit in UNITS else None
    for quantity in sorted(_BEST_FIRST, key=lambda one: one is not told):
        found = [one.name for one in headings if one.quantity is quantity and one.side == side]
        found = found or [one.name for one in headings if one.quantity is quantity]
        if len(found) > 1:  # what was made of another one comes later, and is smoother than the motor
            found = [name for name in found if not FILTERED & set(read_heading(name).words)] or found
            found = [name for name in found if RAW & set(read_heading(name).words)] or found
            found = [name for name in found if _is_summed_up(table, name, found)] or found
            found = _in_one_unit(table, _each_once(table, found))
            with_unit = [name for name in found if read_heading(name).unit]
            found = with_unit if quantity is Quantity.SPEED and len(with_unit) == 1 else found
        if len(found) > 1:
            raise ask_motion(table, headings, quantity, found)
        if found:
            return found[0]
    unnamed = [one.name for one in headings if one.quantity is None and np.ptp(table.numbers(one.name)) > 0.0]
    measured = [one.name for one in headings if one.name in unnamed and MEASURED & set(one.words)]
    if not measured and {one.name for one in headings if drives(one)} == {"u"}:
        measured = [name for name in unnamed if name == "y"]  # a system's input and output, as textbooks call them
    if len(unnamed) == 1 or len(measured) == 1:
        return (measured or unnamed)[0]
    if len(unnamed) == 2 and (position := find_position(table, unnamed, time)):
        return position
    still = [one.name for one in headings if one.quantity is None and one.name != CONSTANT]
    if still and not unnamed:
        raise miss_motion(table, still[0])
    if len(unnamed) > 1:
        raise ask_motion(table, headings, None, unnamed)
    names = [name for name in table.names if name != time] or table.names
    raise ask_column(table, "motion", "--speed, --position or --count", names)


def _each_once(table: Table, names: Sequence[str]) -> list[str]:
    """Leave out columns with the name and the numbers of one before, as where a program lists a signal twice."""
    kept: list[str] = []
    for name in names:
        alike = [one for one in kept if name.partition(" #")[0] == one]
        if not any(np.array_equal(table.numbers(name), table.numbers(one)) for one in alike):
            kept.append(name)
    return kept


def _in_one_unit(table: Table, names: Sequence[str]) -> list[str]:
    """Keep one of several columns that are the same in other units, `rpm` beside `rad/s`: one whose unit has a size."""
    units = {name: read_heading(name).unit for name in names}
    first, *others = sorted(names, key=lambda name: not units[name] or UNITS[units[name]][1] is None)
    values = table.numbers(first)
    for name in others:
        same = units[name] != units[first] and correlate(values, table.numbers(name)) > SAME_MOTION
        if not same or not units[first]:
            return list(names)
    return [first]


def _driving(table: Table, headings: Sequence[Heading], side: str, others: tuple[str, ...]) -> str:
    duties = [one.name for one in headings if one.quantity is Quantity.DUTY]
    for quantity in (Quantity.VOLTAGE, Quantity.DUTY):
        found = [one.name for one in headings if one.quantity is quantity]
        own = [one.name for one in headings if one.quantity is quantity and one.side == side and side]
        found = own or found
        if quantity is Quantity.VOLTAGE and duties:
            found = [name for name in found if not is_supply(table.numbers(name), table.numbers(duties[0]))]
        if quantity is Quantity.VOLTAGE and not duties:
            found = [name for name in found if not _is_battery(table, name)]
        if len(found) > 1:
            raise ask_column(table, quantity.value, "--voltage", found)
        if found:
            return found[0]
    swinging = [one.name for one in headings if one.quantity is Quantity.SUPPLY and _swings(table.numbers(one.name))]
    if len(swinging) == 1:
        return swinging[0]  # Vin, which is no supply then
    unnamed = [one.name for one in headings if one.quantity is None and np.ptp(table.numbers(one.name)) > 0.0]
    if len(unnamed) == 1 and others:
        return unnamed[0]
    candidates = _unnamed(table, headings)
    if not candidates:
        raise miss_drive(table)
    raise ask_drive(table, candidates)


def _is_summed_up(table: Table, name: str, others: Sequence[str]) -> bool:
    """Whether a column is the sum of another one, such as counts of those since the row before."""
    ways = np.diff(table.numbers(name))
    told = ways != 0.0
    return np.count_nonzero(told) > FEWEST_CHANGES and any(
        np.mean(ways[told] == table.numbers(other)[1:][told]) > SUMMED_UP for other in others if other != name
    )


def _is_battery(table: Table, name: str) -> bool:
    """Whether a voltage is a battery's: it stays, of one sign, once it is there, while a motor turns both ways."""
    volts = table.numbers(name)
    there = volts[volts != 0.0]
    beside = [read_heading(one) for one in table.names if _is_numeric(table, one)]
    speeds = [table.numbers(one.name) for one in beside if one.quantity is Quantity.SPEED]
    both = any(np.min(speed) < -BOTH_WAYS * np.max(speed) < 0.0 for speed in speeds)
    turned = any({"dir", "direction"} & set(one.words) for one in beside)  # by a pin of its own
    steady = len(there) > 0 and np.min(there) > STEADY * np.max(there) > 0.0
    told = any(one.quantity is Quantity.REFERENCE and len(np.unique(table.numbers(one.name))) > 1 for one in beside)
    if not both or turned or not steady:
        return False
    return told or bool(np.count_nonzero(np.diff(volts)) > FEWEST_CHANGES)  # few may be those of a drive


def _swings(values: Floats) -> bool:
    """Whether voltages, shape (K,), come to 0 or change their sign, as no supply's do."""
    return bool(np.min(values) <= 0.0 < np.max(np.abs(values)))


def _supply_of(table: Table, headings: Sequence[Heading], pairs: Sequence[Pair]) -> str | None:
    taken = {pair.voltage for pair in pairs} | {pair.motion for pair in pairs}
    free = [one for one in headings if one.name not in taken]
    named = [one.name for one in free if one.quantity is Quantity.SUPPLY]
    duty = table.numbers(pairs[0].voltage)
    volts = [one.name for one in free if one.quantity is Quantity.VOLTAGE and is_supply(table.numbers(one.name), duty)]
    return next(iter(named + volts), None)
