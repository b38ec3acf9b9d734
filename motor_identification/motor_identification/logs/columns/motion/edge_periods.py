"""Make speeds of times between edges: `period_us`, as boards log that time what an encoder's last two edges took."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.clock import guess_time_unit
from motor_identification.logs.columns.drive import drives
from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.motion.direction import BACKWARD, NEITHER, is_backward
from motor_identification.logs.columns.said import Said
from motor_identification.logs.columns.vocabulary import DIRECTIONS, MOVES, Quantity, words_of
from motor_identification.logs.correlation import correlate
from motor_identification.logs.csv.table import Table
from motor_identification.logs.form import TIME_UNITS, Kind
from motor_model.errors import RecordingError

Floats = NDArray[np.float64]

PERIODS = words_of("period interval between periode periodo période")
OF_EDGES = words_of("edge edges pulse pulses tick ticks encoder enc hall speed motor wheel capture")
EDGES = words_of("edge edges pulse pulses encoder enc hall capture")  # of no program's own loop
OF_ROWS = words_of("sample sampling loop cycle row control pwm")  # whose periods are no motion
AS_ROWS, MOSTLY = 0.02, 0.8  # relative: periods that are so near to the times from row to row, in most rows, are those
GOES_WITH = 0.2  # correlation of 1 / period with |drive|, of a motor at least where a row is an edge; of a loop it is 0
CHANGES = 1.25  # where the drive stays: of the 5th of 100 parts of 1 / period, that the 95th is at least
EVERY = 0.99  # of the rows: then each is an edge


def read_edge_periods(table: Table, said: Said) -> tuple[Table, Said]:
    """Read a column of times between edges as speeds in counts a second, with the signs of a direction beside it.

    Only where that is all the motion that a log has, or the user said that it is; 0 is a motor that stands.
    """
    column = None if said.motors or (said.kind, said.unit) not in ((None, None), (Kind.SPEED, None)) else said.motion
    if said.motion and column is None:
        return table, said
    headings = [read_heading(name) for name in table.names]
    able = [one for one in headings if is_edge_period(one) and column in (None, one.name)]
    moves = any(one.quantity in MOVES or one.quantity is None and _varies(table, one) for one in headings)
    if len(able) != 1 or (moves and column is None):
        return table, said
    (heading,) = able
    try:
        period = table.numbers(heading.name)
    except RecordingError:  # told by whoever reads it
        return table, said
    if not np.ptp(period) > 0.0 or not _has_clock(headings, said):
        return table, said
    as_rows = _share_of_rows(table, headings, np.abs(period) * _seconds(heading), said)
    if as_rows > MOSTLY and not (said.motion or (_is_said(heading, said) and _moves(table, headings, period))):
        return table, said
    if as_rows > EVERY:
        return _count_rows(table, headings, heading, said, period)
    speed = np.divide(1.0, period * _seconds(heading), out=np.zeros(len(period)), where=period != 0.0)
    speed, signs = (speed, "") if np.any(period < 0.0) else _give_signs(table, headings, speed)
    name = f"1 / {heading.name} (count/s)"
    cells = {other: cell for other, cell in table.cells.items() if other != heading.name}
    note = (
        f"{heading.name} is the time between two edges: their number a second is the speed{signs} (assumed; otherwise "
        "say which column the motion is)."
    )
    made = replace(table, cells={**cells, name: speed}, notes=(*table.notes, note))
    return made, replace(said, motion=name if said.motion else None)


def _count_rows(
    table: Table, headings: list[Heading], heading: Heading, said: Said, period: Floats
) -> tuple[Table, Said]:
    """Count the edges of a log of one a row, whose times say when each came: exact, which 1 / period is of no mean."""
    ones = np.ones(len(period))
    ways, signs = (np.sign(period), "") if np.any(period < 0.0) else _give_signs(table, headings, ones)
    name = "edges of rows (count)"
    cells = {other: cell for other, cell in table.cells.items() if other != heading.name}
    note = (
        f"{heading.name} is the time from row to row, and that between two edges: a row is an edge, and they are "
        f"counted{signs} (assumed; otherwise say which column the motion is)."
    )
    counted = replace(table, cells={**cells, name: np.cumsum(ways) - ways[0]}, notes=(*table.notes, note))
    return counted, replace(said, motion=name, kind=None) if said.motion else said


def is_edge_period(heading: Heading) -> bool:
    """Tell whether a name is that of times between edges: `period_us`, `edge_interval_ms`, `pulsePeriod`."""
    words = set(heading.words)
    timed = heading.unit in TIME_UNITS
    return bool(timed and words & PERIODS and words <= PERIODS | OF_EDGES and not words & OF_ROWS)


def _varies(table: Table, heading: Heading) -> bool:
    """Whether a column, of whatever name, has numbers that differ: it may be the motion."""
    try:
        return bool(np.ptp(table.numbers(heading.name)) > 0.0)
    except RecordingError:
        return False


def _seconds(heading: Heading) -> float:
    """Give the unit of a column of times [s]."""
    return TIME_UNITS[heading.unit] * 1e-9


def _is_said(heading: Heading, said: Said) -> bool:
    """Whether an encoder's edges, or a name, say that times are those between edges, though rows are as long."""
    return bool(said.edges_per_revolution or set(heading.words) & EDGES)


def _moves(table: Table, headings: list[Heading], period: Floats) -> bool:
    """Whether 1 / period, shape (K,), goes with the drive, as that of no loop does; by much, where no drive changes."""
    turning = period != 0.0
    speed = 1.0 / np.abs(period[turning])
    driving = [one.name for one in headings if drives(one)]
    try:
        drive = np.abs(table.numbers(driving[0])[turning]) if len(driving) == 1 else np.zeros(1)
    except RecordingError:  # told by whoever reads it
        return True
    if np.ptp(drive) > 0.0:
        return correlate(drive, speed) > GOES_WITH
    low, high = np.quantile(speed, (0.05, 0.95))
    return bool(high > CHANGES * low)


def _clocks(headings: list[Heading], said: Said) -> list[Heading]:
    """Find the columns that may say when the rows were."""
    if said.time:
        return [one for one in headings if one.name == said.time]
    return [one for one in headings if one.quantity is Quantity.TIME and not is_edge_period(one)]


def _has_clock(headings: list[Heading], said: Said) -> bool:
    """Whether something else than the times between edges says when the rows were."""
    return said.sample_period is not None or len(_clocks(headings, said)) == 1


def _share_of_rows(table: Table, headings: list[Heading], period: Floats, said: Said) -> float:
    """Give the share of periods [s], shape (K,), that are the times from row to row."""
    if said.sample_period is not None:
        return 0.0
    (clock,) = _clocks(headings, said)
    try:
        time = table.numbers(clock.name)
    except RecordingError:  # times of day
        return 0.0
    unit = clock.unit if clock.unit in TIME_UNITS else guess_time_unit(time)[0]
    steps = np.diff(time) * TIME_UNITS[unit] * 1e-9
    rows = (period[1:], period[:-1])  # of the row before, or of its own
    return max(float(np.mean(np.abs(one - steps) <= AS_ROWS * steps)) for one in rows)


def _give_signs(table: Table, headings: list[Heading], speed: Floats) -> tuple[Floats, str]:
    """Give speeds, shape (K,), the signs of the one column that tells a direction; as they are where none does."""
    told = [one.name for one in headings if DIRECTIONS & set(one.words)]
    driving = [one.name for one in headings if drives(one)]
    if len(told) != 1 or len(driving) != 1:
        return speed, ""
    (column,), (drive,) = told, driving
    values = set(np.unique(np.asarray(table.column(column)).astype(np.str_)).tolist())
    backward = [one for one in values if one.lower() in BACKWARD and (len(values) < 3 or one.lower() not in NEITHER)]
    if len(backward) != 1 or len(values) > 3:
        return speed, ""
    signed = np.where(is_backward(table, column, backward), -speed, speed)
    signed = signed if float(np.sum(table.numbers(drive) * signed)) >= 0.0 else -signed
    return signed, f", with the sign of {column}"
