"""Which column is which: those that were named by the user, then by their names, then by how their numbers behave."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from shlex import quote

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.behaviour.edge_times import EDGE_TIMES, find_edge_times
from motor_identification.logs.columns.behaviour.error_beside import measured_beside_error
from motor_identification.logs.columns.behaviour.following import follows
from motor_identification.logs.columns.behaviour.motors import named_motors, numbered_motors, share_one_drive
from motor_identification.logs.columns.behaviour.parameters import leave_out_parameters
from motor_identification.logs.columns.behaviour.position import find_position
from motor_identification.logs.columns.behaviour.second_reading import (
    commands_beside_control,
    ends_of_a_loop,
    present_values,
    pulses_that_drive,
    references_beside,
    speeds_called_v,
)
from motor_identification.logs.columns.clock import find_clock, read_clock, runs_forward, since_1970
from motor_identification.logs.columns.drive import drives, leave_out_idle_efforts
from motor_identification.logs.columns.heading import Heading, read_heading, words_besides
from motor_identification.logs.columns.motion.speed_beside import find_driven_speed, is_summed_up
from motor_identification.logs.columns.roles.candidates import is_numeric
from motor_identification.logs.columns.roles.drive_column import find_drive_column, find_supply_column
from motor_identification.logs.columns.roles.motion_column import find_motion_column
from motor_identification.logs.columns.roles.row_numbers import (
    FEWEST_ROWS,
    SAME_CLOCK,
    leave_out_numbers,
    tell_duration,
    tell_number,
)
from motor_identification.logs.columns.roles.structs import keep_struct, times_of_struct
from motor_identification.logs.columns.roles.without_names import pair_by_behaviour, pair_channels
from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.columns.vocabulary import MOVES, Quantity
from motor_identification.logs.correlation import correlate
from motor_identification.logs.csv.table import Table

Floats = NDArray[np.float64]

SAME_COLUMN = 0.99  # of the rows in motion, in which two columns of one signal are equal
UNEVEN = 0.2  # of their mean: steps of a column that may be a motor's way


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
    named = [read_heading(name) for name in table.names if is_numeric(table, name)]
    headings = [tell_duration(table, tell_number(table, heading)) for heading in named]
    edges = None if said.time or said.steady else find_edge_times(table, headings, said)
    time = said.time or (edges[0] if edges else None)
    if not time and not said.steady:
        time = _time_of(table, headings, said) or _clock_left(table, headings, said)
    if said.time:
        table.column(said.time)
    others = [heading for heading in headings if heading.name not in (time, said.supply)]
    numbered = leave_out_numbers(table, others, time, timed=bool(said.time or edges))
    free = measured_beside_error(table, numbered) or ends_of_a_loop(numbered)
    free = references_beside(free)
    free = free if said.motion else leave_out_parameters(table, free)
    free = commands_beside_control(table, leave_out_idle_efforts(table, free))
    free = share_one_drive(
        table, numbered_motors(speeds_called_v(table, present_values(pulses_that_drive(table, free))))
    )
    free, unlike = (free, ()) if said.motors or said.motion or said.voltage else named_motors(free)
    free, undriven = ([*free], ()) if said.motors or said.motion or said.voltage else _driven_sides(free)
    pairs = said.motors or _pairs(table, free, said, time)
    pairs, findings = _of_one_shaft(table, pairs, free, said, time)
    supply = said.supply or find_supply_column(table, free, pairs)
    taken = {pair.voltage for pair in pairs} | {pair.motion for pair in pairs} | {supply}
    currents = [one.name for one in free if one.quantity is Quantity.CURRENT and one.name not in taken]
    return Roles(
        time,
        pairs,
        supply,
        currents[0] if len(currents) == 1 and len(pairs) == 1 else None,
        (*unlike, *undriven),
        (*([EDGE_TIMES.format(*edges)] if edges else []), *findings),
    )


def _time_of(table: Table, headings: Sequence[Heading], said: Said) -> str | None:
    named = [heading.name for heading in headings if heading.quantity is Quantity.TIME]
    named = times_of_struct(named, said.motion or said.voltage or "")
    if len(named) > 1:
        times = {name: read_clock(table, name) for name in named}
        forward = [name for name in named if runs_forward(times[name])]
        # A computer's clock says when rows came to it, the board's when they were made.
        named = sorted(forward, key=lambda name: bool(since_1970(times[name]))) or named
    if named:
        return named[0]
    said_else = (said.voltage, said.motion)
    unnamed = {
        one.name: table.numbers(one.name) for one in headings if one.quantity is None and one.name not in said_else
    }
    clock = find_clock({name: values for name, values in unnamed.items() if not _is_way(table, name, unnamed)})
    dates = _find_dates(table)
    if dates and clock and correlate(table.numbers(clock), read_clock(table, dates)) > SAME_CLOCK:
        return clock
    return dates or clock


def _clock_left(table: Table, headings: Sequence[Heading], said: Said) -> str | None:
    """The only column that the user left, where he named drive and motion: times, if it goes on in every row.

    However unevenly it does: rows come as a busy board sends them.
    """
    left = [one for one in headings if one.name not in (said.voltage, said.motion, said.supply)]
    if not (said.voltage and said.motion) or len(left) != 1 or left[0].quantity is not None:
        return None
    values = table.numbers(left[0].name)
    return left[0].name if len(values) > FEWEST_ROWS and bool(np.all(np.diff(values) > 0.0)) else None


def _find_dates(table: Table) -> str | None:
    """Find the column of dates or times of day that go on, where no name tells it; None without one."""
    words = (name for name in table.names if not is_numeric(table, name))
    return next((name for name in words if runs_forward(read_clock(table, name))), None)


def _is_way(table: Table, name: str, columns: Mapping[str, Floats]) -> bool:
    """Whether a column goes on by what another one is, and not evenly: the way of a motor, and no clock."""
    steps = np.diff(columns[name])
    with np.errstate(over="ignore", invalid="ignore"):  # a column of anything
        even = not np.std(steps) >= UNEVEN * np.mean(steps)
    if even:
        return False
    return any(find_position(table, (name, other), None) == name for other in columns if other != name)


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
        found.append(
            Pair(side, find_drive_column(table, own, side, ()), find_motion_column(table, own, side, None, said.unit))
        )
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
        return pair_by_behaviour(table, rest, time)
    if not voltage and not motion and (channels := pair_channels(table, rest)):
        return channels
    side = read_heading(motion or voltage).side  # of two motors, the one that was named
    if motion or voltage:
        rest = _of_its_name(keep_struct(rest, motion or voltage), read_heading(motion or voltage))
    motion = motion or find_motion_column(table, rest, side, time, said.unit)
    if not voltage:
        steps = _steps_of(table, rest, motion)
        beside = [one for one in _besides(table, rest, motion) if one.name not in steps]
        # Where somebody computed what is beside the motion, a column without a telling name is no drive by that alone.
        voltage = find_drive_column(table, beside, side, () if steps else ("",))
    return Pair("", voltage, motion)


def _of_its_name(headings: Sequence[Heading], named: Heading) -> list[Heading]:
    """The columns without the drives or motions of others, where one has the words of the one that was named."""
    wanted = (Quantity.VOLTAGE, Quantity.DUTY) if named.quantity in MOVES else tuple(MOVES)
    words, able = words_besides(named), [one for one in headings if one.quantity in wanted]
    own = [one for one in able if words and words_besides(one) == words]
    return [one for one in headings if one in own or one not in able] if own else list(headings)


def _besides(table: Table, headings: Sequence[Heading], motion: str) -> list[Heading]:
    """The columns but for that of the motion, also under a name that tells nothing: `motor 2` of a matrix."""
    moved = table.numbers(motion)
    again = {one.name for one in headings if one.quantity is None and _is_again(table.numbers(one.name), moved)}
    return [one for one in headings if one.name not in again | {motion}]


def _steps_of(table: Table, headings: Sequence[Heading], motion: str) -> set[str]:
    """Columns without telling names that are what a position went by since the row before: `Delta`."""
    moved = table.numbers(motion)
    return {one.name for one in headings if one.quantity is None and is_summed_up(moved, table.numbers(one.name))}


def _is_again(values: Floats, others: Floats) -> bool:
    """Whether columns, shape (K,), are the same but for a few rows, as where somebody took out what was wrong."""
    told = (values != 0.0) | (others != 0.0)
    return bool(told.any() and np.mean((values == others)[told]) > SAME_COLUMN)


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
        f"{pair.voltage} (otherwise: --position {quote(pair.motion)}).",
    )
