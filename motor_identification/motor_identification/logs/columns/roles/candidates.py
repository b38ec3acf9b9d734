"""Tell which columns of a table may have a role at all."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.vocabulary import Quantity
from motor_identification.logs.csv.sparse import LOOKED_AT
from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError

MOSTLY = 0.5  # of its cells are numbers: else it holds notes beside the table, whatever its name


def is_numeric(table: Table, name: str) -> bool:
    """Whether a column holds numbers, or is called one that should."""
    try:
        table.numbers(name)
    except RecordingError:
        # Garbage in a column of numbers is told when it is used; a column of words or times of day is none of ours.
        heading = read_heading(name)
        return heading.quantity not in (None, Quantity.OTHER) and (
            heading.quantity is Quantity.TIME or float(np.mean(table.readable(name))) > MOSTLY
        )
    return True


def list_readable(table: Table) -> list[Heading]:
    """List the headings of columns of which every cell is a number, as before gaps are filled not all are."""
    return [read_heading(name) for name in table.names if _is_readable(table, name)]


def _is_readable(table: Table, name: str) -> bool:
    begin = replace(table, lines=table.lines[:LOOKED_AT], cells={name: table.column(name)[:LOOKED_AT]})
    if not begin.readable(name).all():  # which is quick
        return False
    try:
        table.numbers(name)
    except RecordingError:
        return False
    return True


def list_unnamed(table: Table, headings: Sequence[Heading]) -> list[str]:
    """Columns whose names tell nothing, without those of nothing but zeros: a log of one step has a constant drive."""
    return [one.name for one in headings if one.quantity is None and np.any(table.numbers(one.name))]


def stays(table: Table, name: str) -> bool:
    """Whether a column is the same in every row."""
    return bool(np.ptp(table.numbers(name)) == 0.0)
