"""Fills tables of several senders: a row has the values of one of them, and empty cells where the others said nothing.

So do programs write that merge topics by time. What was said holds until something else is; a motion is known only in
the rows that have one.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.vocabulary import Quantity
from motor_identification.logs.csv.table import GARBLED, Table

Bools = NDArray[np.bool_]

NO_VALUE = frozenset({"", "nan", "null", "none", "-", "na", "n/a"})  # cells in which nothing stands, in lower case


@dataclass(frozen=True)
class Filled:
    """A table whose empty cells hold what was said before; `told` are the rows, (K,), that each such column had."""

    table: Table
    told: Mapping[str, Bools]

    def rows_of(self, time: str | None, motion: str, voltage: str, supply: str | None) -> Table:
        """The rows that have a time and a motion of their own and come after the first value of the other columns."""
        rows = np.ones(len(self.table), np.bool_)
        for name in (time or "", motion):
            rows &= self.told.get(name, rows)
        held = [name for name in (voltage, supply or "") if name in self.told]
        rows[: max((int(np.argmax(self.told[name])) for name in held), default=0)] = False
        if rows.all():
            return self.table
        notes = [f"{name} has a value in {self._share(name)} rows: it holds until the next." for name in held]
        if motion in self.told:
            notes.insert(0, f"{motion} has a value in {self._share(motion)} rows: those rows are taken.")
        return replace(self.table.rows(rows, ""), notes=(*self.table.notes, *notes))

    def _share(self, name: str) -> str:
        return f"{int(self.told[name].sum())} of {len(self.table)}"


def fill_gaps(table: Table) -> Filled:
    """Hold the values of columns that are empty in more rows than a serial line garbles; leave out columns of none."""
    cells, told = dict(table.cells), {}
    for name in table.names:
        quantity = read_heading(name).quantity
        if quantity is Quantity.OTHER:
            continue
        readable = table.readable(name)
        empty = int((~readable).sum())
        if empty <= GARBLED * len(table) or not _are_empty(table, name, ~readable):
            continue
        if empty == len(table):
            del cells[name]
            continue
        values, row = table.rows(readable, "").numbers(name), np.arange(len(table))
        held = values[np.maximum(np.cumsum(readable) - 1, 0)]
        cells[name] = np.interp(row, row[readable], values) if quantity is Quantity.TIME else held
        told[name] = readable
    return Filled(replace(table, cells=cells), told)


def _are_empty(table: Table, name: str, rows: Bools) -> bool:
    return all(table.text(name, int(row)).strip().lower() in NO_VALUE for row in np.flatnonzero(rows))
