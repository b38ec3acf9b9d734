"""Times of rows that have none: so many seconds from row to row, where the user says so."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.csv.table import Table

ROW_TIMES = "(row times)"  # column: where a row stands, and then when it was


def number_rows(table: Table) -> Table:
    """Add a column of where each row stands, before any is left out."""
    return replace(table, cells={**table.cells, ROW_TIMES: np.arange(len(table), dtype=np.int64)})


def give_times(table: Table, period: float) -> Table:
    """Turn the places of rows into times [ns], `period` [s] apart; the first row left is at 0."""
    place: NDArray[np.int64] = np.asarray(table.column(ROW_TIMES), dtype=np.int64)
    time = np.rint(np.abs(place - place[:1]) * (period * 1e9)).astype(np.int64)
    return replace(table, cells={**table.cells, ROW_TIMES: time})
