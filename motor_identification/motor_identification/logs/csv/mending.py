"""Mends a table as loggers leave it.

A few garbled rows are left out, rows that come newest first are turned round, points that were lost are put back.
"""

import re
from dataclasses import replace

import numpy as np

from motor_identification.logs.columns.behaviour.stray_rows import restore_points
from motor_identification.logs.columns.clock import read_clock, runs_forward
from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.vocabulary import UNIT_BY_SPELLING, Quantity
from motor_identification.logs.csv.sparse import mark_empty, mark_rare_senders
from motor_identification.logs.csv.table import GARBLED, Table, name_column

WHOLE = ".0"  # which a program writes behind a whole number that it read
_MAY_LOSE_POINTS = (Quantity.VOLTAGE, Quantity.DUTY, Quantity.SUPPLY, Quantity.SPEED, Quantity.REFERENCE)
_WITH_UNIT = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?) ?([^\W\d_][\w/]{0,9}|%|°)$")
_LOOKED_AT = 200  # cells that tell whether a column holds numbers at all


def take_off_units(table: Table) -> Table:
    """Take the unit off the cells of a column that all have one, `0.01 sec`, and put it behind the column's name."""
    cells = dict(table.cells)
    for name in table.names:
        column = table.column(name)
        matches = [_WITH_UNIT.match(table.text(name, row)) for row in range(min(len(table), _LOOKED_AT))]
        units = {UNIT_BY_SPELLING.get(match[2].lower(), "") if match else "" for match in matches}
        if len(units) != 1 or "" in units:
            continue
        (unit,) = units
        bare = [match[1] if (match := _WITH_UNIT.match(table.text(name, row))) else "" for row in range(len(column))]
        cells = {f"{name} [{unit}]" if one == name else one: other for one, other in cells.items()}
        cells[f"{name} [{unit}]"] = bare
    return replace(table, cells=cells)


def mend_table(table: Table) -> Table:
    """Leave out garbled rows, where they are few, put the rows in the order of their times, and lost points back."""
    return _restore_points(_turn_round(_leave_out_garbled(table)))


def _leave_out_garbled(table: Table) -> Table:
    good, of_others = np.ones(len(table), np.bool_), mark_rare_senders(table)
    first: tuple[int, str] | None = None
    for name in filter(lambda one: _holds_numbers(table, one), table.names):
        readable = table.readable(name) | (of_others & mark_empty(table.column(name)))
        if not 0 < int((~readable).sum()) <= GARBLED * len(table):
            continue
        good &= readable
        row = int(np.argmin(readable))
        first = min(first or (row, name), (row, name))
    lost = int((~good).sum())
    if first is None or lost > GARBLED * len(table):
        return table
    row, name = first
    where = f"line {table.lines[row]}, {name_column(name)}: '{table.text(name, row)[:20]}'"
    rows = f"1 row with a cell that is no number ({where})"
    if lost > 1:
        rows = f"{lost} rows with a cell that is no number (the first is {where})"
    return table.rows(good, f"Left out: {rows}.")


def _holds_numbers(table: Table, name: str) -> bool:
    if read_heading(name).quantity is Quantity.OTHER:
        return False
    begin = table.rows(np.arange(min(len(table), _LOOKED_AT)), "")
    return bool(np.mean(begin.readable(name)) > 0.5)


def _turn_round(table: Table) -> Table:
    for name in table.names:
        if read_heading(name).quantity is not Quantity.TIME or not table.readable(name).all():
            continue
        times = read_clock(table, name)  # in any unit
        if len(times) and runs_forward(times[::-1]) and times[0] > times[-1]:
            return table.rows(np.arange(len(table))[::-1], f"The rows come newest first ({name}): turned round.")
    return table


def _may_have_lost_point(text: str) -> bool:
    """Whether a number has no point, or only that which a program gave it after another one had been lost."""
    return text.removesuffix(WHOLE).lstrip("+-").isdigit()


def _restore_points(table: Table) -> Table:
    cells, notes = dict(table.cells), list(table.notes)
    for name in table.names:
        if read_heading(name).quantity not in _MAY_LOSE_POINTS or not table.readable(name).all():
            continue
        values = table.numbers(name)
        mended, which = restore_points(values)
        which[which] = [_may_have_lost_point(table.text(name, int(row))) for row in np.flatnonzero(which)]
        if which.any():
            cells[name], row = np.where(which, mended, values), int(np.argmax(which))
            more = f", and {which.sum() - 1} more" if which.sum() > 1 else ""
            beside = f"between {values[row - 1]:g} and {values[row + 1]:g}"
            notes.append(
                f"Line {table.lines[row]}, {name_column(name)}: {values[row]:g} {beside} lost its point, and is taken "
                f"for {mended[row]:g} (assumed){more}."
            )
    return replace(table, cells=cells, notes=tuple(notes)) if len(notes) > len(table.notes) else table
