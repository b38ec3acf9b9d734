"""Tell columns that number the rows, as programs write before each, or say how long each took, from a motor's."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from motor_identification.logs.columns.clock import read_clock, runs_forward
from motor_identification.logs.columns.heading import Heading, read_heading
from motor_identification.logs.columns.names.path import find_field
from motor_identification.logs.columns.names.quantity import may_be_duration, may_number_rows
from motor_identification.logs.columns.vocabulary import Quantity
from motor_identification.logs.correlation import correlate
from motor_identification.logs.csv.table import Table
from motor_identification.logs.rows.drive.constant_voltage import CONSTANT
from motor_identification.logs.rows.row_times import ROW_TIMES

SAME_CLOCK = 0.9999  # correlation of two columns of times
FEWEST_ROWS = 10  # that numbers of rows are told by
MOSTLY_ON = 0.9  # of the rows, by which such a number goes on by 1: a few rows are lost


def tell_number(table: Table, heading: Heading) -> Heading:
    """A heading, of OTHER where its column numbers the rows by its name and goes on by 1: that is no clock's rate."""
    if heading.quantity is not None or not may_number_rows(heading.words):
        return heading
    steps = np.diff(table.numbers(heading.name))
    return replace(heading, quantity=Quantity.OTHER) if np.mean(steps == 1.0) > MOSTLY_ON else heading


def tell_duration(table: Table, heading: Heading) -> Heading:
    """A heading, of OTHER where its column is how long each row took by its name: `dt`, `Ts`, and `MotorDC.delay`.

    What goes on from row to row are times under such a name.
    """
    words = read_heading(find_field(heading.name) or heading.name).words
    if heading.quantity not in (None, Quantity.TIME) or not may_be_duration(words):
        return heading
    values = read_clock(table, heading.name)
    goes_on = len(values) > 1 and bool(np.all(np.diff(values) >= 0.0)) and values[-1] > values[0]
    return heading if goes_on or runs_forward(values) else replace(heading, quantity=Quantity.OTHER)


def leave_out_numbers(table: Table, headings: Sequence[Heading], time: str | None, timed: bool) -> list[Heading]:
    """Leave out the columns that number the rows; not the only one left beside times of what it counts (`timed`)."""
    left = [one for one in headings if one.name not in (CONSTANT, ROW_TIMES)]
    if timed and len(left) == 1:
        return list(headings)
    return [one for one in headings if one.quantity is not None or not _numbers_rows(table, one.name, time)]


def _numbers_rows(table: Table, name: str, time: str | None) -> bool:
    """Whether a column is another clock's times of the same rows, as where each channel has an X of its own.

    Or their numbers, as programs write before each row.
    """
    if time is None:
        return False
    values, times = table.numbers(name), read_clock(table, time)
    if len(table) > FEWEST_ROWS and np.array_equal(values, values[0] + np.arange(len(values))):
        return True
    if len(times) != len(values) or not runs_forward(values) or np.ptp(times) <= 0.0:
        return False
    return correlate(values, times) > SAME_CLOCK and bool(abs(np.ptp(values) / np.ptp(times) - 1.0) < 0.01)
