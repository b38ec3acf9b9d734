"""Find where the rows of a text table end, and something else begins behind them: another table, settings."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.csv.cells import COMMENT, is_number, split_line
from motor_identification.logs.csv.dialect import LOOKED_AT, Dialect
from motor_identification.logs.csv.sparse import NO_VALUE
from motor_identification.logs.csv.table import Table

NEARLY_ALL = 0.95  # of the first rows: there a column has numbers that no row lacks
FEWEST_ROWS = 10  # whose numbers tell how many decimals a number has
LINE_BREAKS = ("\n", "\r")


def cut_at_end(lines: Sequence[str], dialect: Dialect) -> tuple[Sequence[str], list[str]]:
    """Cut off the lines behind the rows; what is said of them stands beside the lines."""
    notes = []
    end = _end_of_table(lines, dialect)
    if end < len(lines):
        notes.append(f"Left out: the lines from {end + 1} on, which have fewer than half of the cells of those before.")
        lines = lines[:end]
    end = _end_of_rows(lines, dialect)
    if end < len(lines):
        notes.append(f"Left out: the lines from {end + 1} on, which lack numbers that all rows before have.")
        lines = lines[:end]
    return lines, notes


def _end_of_table(lines: Sequence[str], dialect: Dialect) -> int:
    """Where another table begins behind the rows, with at most half of their cells; the number of lines where none."""
    first, short = len(lines), 0
    for place in range(len(lines) - 1, dialect.first_row, -1):
        cells = split_line(lines[place], dialect.delimiter)  # empty ones too: those of other senders
        if 2 * len(cells) > len(dialect.header):
            break
        if any(is_number(cell, dialect.decimal_comma) for cell in cells):
            first, short = place, short + 1
    return first if short > 1 else len(lines)  # one alone is the last, cut off


def _end_of_rows(lines: Sequence[str], dialect: Dialect) -> int:
    """Where, behind all rows, lines begin that lack numbers which rows have, such as a controller's settings.

    One line alone is a last row that was cut off, or a garbled one.
    """
    begin = [line for line in lines[dialect.first_row :][:LOOKED_AT] if line.strip()]
    begin = begin[: (len(begin) + 1) // 2]  # of a short table, the others may be no rows
    rows = [split_line(line, dialect.delimiter) for line in begin]
    places = [
        place
        for place in range(len(dialect.header))
        if sum(_says_number(row, place, dialect.decimal_comma) for row in rows) >= NEARLY_ALL * len(rows)
    ]
    first, others = len(lines), 0
    for place in range(len(lines) - 1, max(dialect.first_row, len(lines) - LOOKED_AT), -1):
        if not lines[place].strip():
            continue
        cells = split_line(lines[place], dialect.delimiter)
        if all(_says_number(cells, one, dialect.decimal_comma) or _is_empty(cells, one) for one in places):
            return first if others > 1 and places else len(lines)
        first = place
        others += any(is_number(cell, dialect.decimal_comma) for cell in cells) and not COMMENT.match(lines[place])
    return len(lines)


def _says_number(cells: Sequence[str], place: int, comma: bool) -> bool:
    return place < len(cells) and is_number(cells[place], comma)


def _is_empty(cells: Sequence[str], place: int) -> bool:
    """Whether a cell says that there is no value."""
    return place < len(cells) and cells[place] in NO_VALUE


def leave_out_cut_number(table: Table, text: str) -> Table:
    """Leave out the last row of a table whose file ends in fewer decimals than any row before has there; and say so.

    A number with as many decimals may be whole, as is one before a line break; where rows have numbers without
    decimals, none tells anything.

    Args:
        table: what was read of the text.
        text: that of the whole file.
    """
    if text.endswith(LINE_BREAKS) or len(table) <= FEWEST_ROWS or not text.endswith(table.text(table.names[-1], -1)):
        return table
    decimals = _count_decimals([table.text(table.names[-1], row) for row in range(len(table))])
    if decimals[-1] >= np.min(decimals[:-1]):
        return table
    said = f"Line {table.lines[-1]}, the last, is cut off within its last number and left out."
    return table.rows(np.arange(len(table)) < len(table) - 1, said)


def _count_decimals(cells: Sequence[str]) -> NDArray[np.int64]:
    """Count the digits behind the point, or the comma, of each cell, shape (K,)."""
    return np.array([len(cell.replace(",", ".").partition(".")[2]) for cell in cells], np.int64)
