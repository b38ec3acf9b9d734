"""Tell the times of edges beside their count from positions beside the numbers of rows: one column goes on by 1.

Under one voltage a motor that stood gets going: in its first rows it turns by less, or its first edges are far apart.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.columns.clock import FIRST_ROWS, SLOW, runs_forward
from motor_identification.logs.columns.heading import Heading
from motor_identification.logs.columns.notes import ask_column
from motor_identification.logs.columns.said import Said
from motor_identification.logs.csv.table import Table
from motor_identification.logs.rows.drive.constant_voltage import CONSTANT
from motor_identification.logs.rows.row_times import ROW_TIMES

Floats = NDArray[np.float64]

MOSTLY_ON = 0.9  # of the rows, by which a column that counts goes on by 1: a few edges, or rows, are lost
AT_ONCE = 0.1  # of the rows, which may have the time of the one before: two edges within a tick of the clock


EDGE_TIMES = (
    "{0} says when each count in {1} came, as its steps are longest at first, where a motor gets going (assumed; "
    "otherwise: --time {1})."
)


def find_edge_times(table: Table, headings: Sequence[Heading], said: Said) -> tuple[str, str] | None:
    """Find the times of edges and their count, where two columns without names are all that there is at one voltage.

    None where there is none, or one of them numbers the rows in which the other was measured.

    Raises:
        RecordingError: either may be so.
    """
    others = [one for one in headings if one.name not in (CONSTANT, ROW_TIMES, said.supply)]
    if CONSTANT not in table.names or said.motion or any(one.quantity is not None for one in others):
        return None
    columns = {one.name: table.numbers(one.name) for one in others}
    moving = {name: values for name, values in columns.items() if np.any(values != values[0])}
    counting = [name for name, values in moving.items() if counts_on(values)]
    if len(moving) != 2 or len(counting) != 1 or not table.numbers(CONSTANT).any():
        return None
    (count,), (other,) = counting, (name for name in moving if name not in counting)
    steps = np.diff(moving[other])
    if np.any(steps < 0.0) or np.mean(steps == 0.0) > AT_ONCE:
        return None
    first, usual = float(np.mean(steps[:FIRST_ROWS])), float(np.median(steps))
    if first < SLOW * usual:
        return None
    if usual < SLOW * first:
        return other, count
    if not runs_forward(moving[other]):
        return None
    raise ask_column(
        table, f"time ({count} goes on by 1, as counts do, and as rows are numbered)", "--time", (other, count)
    )


def counts_on(values: Floats) -> bool:
    """Whether values, shape (K,), go on by 1 in nearly every row, and by whole numbers in the others."""
    steps = np.diff(values)
    return bool(np.all(steps >= 1.0) and np.all(steps % 1.0 == 0.0) and np.mean(steps == 1.0) > MOSTLY_ON)
