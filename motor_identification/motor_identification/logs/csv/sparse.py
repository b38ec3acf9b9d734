"""Fills tables of several senders: a row has the values of one of them, and empty cells where the others said nothing.

So do programs write that merge topics by time. What was said holds until something else is; a motion is known only in
the rows that have one.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.clock import read_clock
from motor_identification.logs.columns.heading import is_direction, read_heading
from motor_identification.logs.columns.vocabulary import Quantity
from motor_identification.logs.csv.table import GARBLED, Cells, Table
from motor_model.errors import RecordingError

Bools = NDArray[np.bool_]
Integers = NDArray[np.int64]

NO_VALUE = ("", "nan", "NaN", "NAN", "null", "NULL", "none", "None", "-", "NA", "N/A", "n/a")  # nothing stands there
LOOKED_AT = 200  # cells that tell quickly that a column holds words


@dataclass(frozen=True)
class Filled:
    """A table whose empty cells hold what was said before; `told` are the rows, (K,), that each such column had."""

    table: Table
    told: Mapping[str, Bools]

    def rows_of(
        self, time: str | None, motion: str, voltage: str, supply: str | None, direction: str | None = None
    ) -> Table:
        """The rows that have a time and a motion of their own and come after the first value of the other columns."""
        rows = np.ones(len(self.table), np.bool_)
        for name in (time or "", motion):
            rows &= self.told.get(name, rows)
        held = [name for name in (voltage, supply or "", direction or "") if name in self.told]
        rows[: max((int(np.argmax(self.told[name])) for name in held), default=0)] = False
        if rows.all():
            return self.table
        if not rows.any():
            others = " and ".join(held)
            raise RecordingError(
                f"{self.table.path}: {motion} has no value in any row from the first of {others} on: check the columns."
            )
        notes = [f"{name} has a value in {self._share(name)} rows: it holds until the next." for name in held]
        if motion in self.told:
            notes.insert(0, f"{motion} has a value in {self._share(motion)} rows: those rows are taken.")
        kept = self.table.rows(rows, "")
        cells = dict(kept.cells)
        for name in held:
            cells[name] = np.asarray(self.table.column(name))[self._middles(time, np.flatnonzero(rows))]
        return replace(kept, cells=cells, notes=(*self.table.notes, *notes))

    def _middles(self, time: str | None, rows: Integers) -> Integers:
        """The rows, (F,), that came last before the middle between each of some rows and the next: what held mostly."""
        if time is None:
            return rows
        times = read_clock(self.table, time)
        if np.any(np.diff(times) < 0.0):
            return rows  # time begins again
        told: NDArray[np.float64] = times[rows]
        middles = told + 0.5 * np.diff(told, append=told[-1:])
        return np.asarray(np.maximum(np.searchsorted(times, middles, side="right") - 1, rows), dtype=np.int64)

    def _share(self, name: str) -> str:
        return f"{int(self.told[name].sum())} of {len(self.table)}"


def fill_gaps(table: Table) -> Filled:
    """Hold the values of columns that are empty in more rows than a serial line garbles; leave out columns of none."""
    cells, told = dict(table.cells), {}
    of_others = mark_rare_senders(table)
    for name in table.names:
        quantity = read_heading(name).quantity
        way, words = is_direction(name), np.asarray(table.column(name)).dtype.kind != "f"
        empty = _mark_blank(table.column(name)) if way and words else mark_empty(table.column(name))
        few = np.count_nonzero(empty) <= GARBLED * len(table)
        if (quantity is Quantity.OTHER and words and not way) or (few and not np.any(empty & of_others)):
            continue
        if empty.all():
            del cells[name]
            continue
        row = np.arange(len(table))
        own = row[~empty]
        last = np.maximum(np.cumsum(~empty) - 1, 0)
        if way and len(np.unique(np.asarray(table.column(name))[own])) < 2 and not _is_of_a_sender(table, name, empty):
            continue  # a mark of one way, and nothing of the other
        if way:  # whose values may be words
            cells[name], told[name] = np.asarray(table.column(name))[own][last], ~empty
            continue
        if not (_are_numbers(table, name, own[:LOOKED_AT]) and _are_numbers(table, name, own)):
            continue
        values = table.rows(own, "").numbers(name)
        held = values[last]
        cells[name] = np.interp(row, own, values) if quantity is Quantity.TIME else held
        told[name] = ~empty
    return Filled(replace(table, cells=cells), told)


def mark_rare_senders(table: Table) -> Bools:
    """Mark the rows, shape (K,), that one who seldom says anything sent: what others say all the time is empty there.

    A command that is given once or twice stands in so few rows that they look garbled.
    """
    rare = np.zeros(len(table), np.bool_)
    for name in table.names:
        empty = mark_empty(table.column(name))
        if read_heading(name).quantity is not Quantity.OTHER and 0.5 * len(table) < np.count_nonzero(empty):
            rare |= ~empty & table.readable(name)
    return rare & (np.count_nonzero(rare) <= GARBLED * len(table))


def mark_empty(cells: Cells) -> Bools:
    """Mark the cells, shape (K,), in which nothing stands."""
    array = np.asarray(cells)
    if array.dtype.kind not in "SU":
        return np.isnan(array) if array.dtype.kind == "f" else np.zeros(len(array), np.bool_)
    spelt = [word.encode() for word in NO_VALUE] if array.dtype.kind == "S" else sorted(NO_VALUE)
    return np.asarray(np.logical_or.reduce([array == word for word in spelt]))


def _is_of_a_sender(table: Table, name: str, empty: Bools) -> bool:
    """Whether another column is empty, too, in most rows in which one is, (K,): they are of another sender."""
    others = (mark_empty(table.column(one))[empty] for one in table.names if one != name)
    return any(2 * np.count_nonzero(one) > len(one) for one in others)


def _mark_blank(cells: Cells) -> Bools:
    """Mark the cells of words, shape (K,), without any: `none` is a direction as well."""
    array = np.asarray(cells)
    return np.asarray(np.char.str_len(array) == 0 if array.dtype.kind in "SU" else np.zeros(len(array), np.bool_))


def _are_numbers(table: Table, name: str, rows: NDArray[np.int64]) -> bool:
    return bool(table.rows(rows, "").readable(name).all())
