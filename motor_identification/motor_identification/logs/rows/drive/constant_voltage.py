"""The drive of a log of one step that has no column of it: so many volts in every row, where the user says so."""

from dataclasses import replace

import numpy as np

from motor_identification.logs.csv.table import Table

CONSTANT = "(constant voltage)"  # column


def give_voltage(table: Table, voltage: float) -> Table:
    """Add a column of one voltage [V]."""
    return replace(table, cells={**table.cells, CONSTANT: np.full(len(table), voltage)})
