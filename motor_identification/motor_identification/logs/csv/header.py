"""Names of a text table's columns: the line above its rows, a line of units below it, names over their cells."""

import re
from collections.abc import Sequence
from itertools import zip_longest

from motor_identification.logs.columns.vocabulary import UNIT_BY_SPELLING
from motor_identification.logs.csv.cells import COMMENT, SPACES, is_number, split_line

_APART = re.compile(r"\s{2,}|\t")  # names of several words
_WORDS = re.compile(r"\S+(?: \S+)*")  # those names, where they stand
_BRACKETS = "[]()<>{}"
_UNIT_ROW = re.compile(r"[\[(]?[A-Za-zµμ°%/²\d.^_-]{1,10}[\])]?$")
_SURE = frozenset({"s", "ms", "V"})  # of what may be units: these are none of a column's names
ALIGNED = 2  # characters that a cell may end before or behind its name


def find_header(
    before: Sequence[str], first: str, delimiter: str, comma: bool, width: int, most: int
) -> tuple[str, ...]:
    """Find the names of columns in the lines before the first row; empty where there are none.

    They are the last line that has as many cells as the rows; one of units below it is put behind the names.

    Args:
        before: the lines above the first row that are not blank.
        first: that row.
        delimiter: what separates cells.
        comma: whether the decimal sign is one.
        width: cells of most rows, without empty ones at their end.
        most: cells of most rows.
    """
    lines = [COMMENT.sub("", line) for line in before]
    cells = [_without_empty_end(_names(line, first, delimiter, width)) for line in lines]
    fit = [width <= len(row) <= most and not any(is_number(one, comma) for one in row) for row in cells]
    if len(cells) > 1 and fit[-2] and _are_units(cells[-1], cells[-2]):
        units = (unit.strip(_BRACKETS) for unit in cells[-1])
        pairs = zip_longest(cells[-2], units, fillvalue="")
        return tuple(f"{name} [{unit}]" if name and unit else name or unit for name, unit in pairs)
    return tuple(next((row for row, fits in zip(cells[::-1], fit[::-1], strict=True) if fits), ()))


def _are_units(row: Sequence[str], above: Sequence[str]) -> bool:
    """Whether a line is one of units, of which some columns have none, below a line of names."""
    units = [cell for cell in row if cell]
    if not units or len(row) > len(above):
        return False
    known = [cell.strip(_BRACKETS).strip().lower() in UNIT_BY_SPELLING for cell in units]
    if all(known) and len(units) > 1:
        return not all(name.strip(_BRACKETS).strip().lower() in UNIT_BY_SPELLING for name in above if name)
    alike = all(one or _UNIT_ROW.match(cell) for cell, one in zip(units, known, strict=True))
    return alike and any("[" in cell or "/" in cell or cell in _SURE for cell in units)


def _names(line: str, first: str, delimiter: str, width: int) -> list[str]:
    """The cells of a line of names; between blanks, names of several words stand apart by two blanks."""
    names = split_line(line, delimiter)
    if delimiter != SPACES or len(names) <= width:
        return names
    apart = _APART.split(line.strip())
    if len(apart) == width:
        return apart
    return _above(line, first) if len(apart) > width else names


def _above(line: str, first: str) -> list[str]:
    """The names that stand above the cells of a row, whose last columns may be empty; empty where they do not."""
    names = list(_WORDS.finditer(line))
    cells = list(re.finditer(r"\S+", first))
    pairs = zip(names, cells, strict=False)
    aligned = all(
        min(abs(name.end() - cell.end()), abs(name.start() - cell.start())) <= ALIGNED for name, cell in pairs
    )
    return [name[0] for name in names[: len(cells)]] if aligned and len(names) > len(cells) else []


def _without_empty_end(cells: list[str]) -> list[str]:
    while cells and not cells[-1]:
        cells = cells[:-1]
    return cells
