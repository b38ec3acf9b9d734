"""Names of a text table's columns: the line above its rows, a line of units below it, names over their cells."""

import re
from collections.abc import Sequence
from itertools import zip_longest

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.vocabulary import UNIT_BY_SPELLING
from motor_identification.logs.csv.cells import COMMENT, SPACES, is_number, split_line
from motor_identification.logs.csv.sparse import NO_VALUE

_APART = re.compile(r"\s{2,}|\t")  # names of several words
_WORDS = re.compile(r"\S+(?: \S+)*")  # those names, where they stand
_BRACKETS = "[]()<>{}"
_UNIT_ROW = re.compile(r"[\[(]?[A-Za-zµμ°%/²\d.^_-]{1,10}[\])]?$")
_NO_UNIT = frozenset({"#", "-", "–", "1"})  # of a number of something, in brackets
_SURE = frozenset({"s", "ms", "V"})  # of what may be units: these are none of a column's names
_OF_COLUMN = re.compile(
    r"\s*(?:col(?:umn)?\.?\s*)?(?P<places>\d{1,3}(?:\s+\d{1,3})*)\b[:.)=\s]\s*(?P<name>[^\W\d].*|\(.*)$", re.I
)
_VALUES = re.compile(r"(?<![\w.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?(?![\w.])|\b0x[0-9a-fA-F]+")  # of an example row
_UNIT = re.compile(r"[\[(][^\])]*[\])]")
ALIGNED = 2  # characters that a cell may end before or behind its name
FEWEST_NAMES = 4  # for each number among them
FEWEST_NAMED, MOST_WITHOUT_CELLS = 2, 2  # columns below, and names behind them


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
    if numbered := _numbered(before, width):
        return numbered
    lines = [COMMENT.sub("", line) for line in before]
    cells = [_without_empty_end(_names(line, first, delimiter, width)) for line in lines]
    cells = [row for row in cells if not row or not all(cell in NO_VALUE for cell in row)]  # nan,nan,nan
    cells[-2:-1] = [_name_channels(row, cells[-1], comma) for row in cells[-2:-1]]
    fit = [width <= len(row) <= most and not any(is_number(one, comma) for one in row) for row in cells]
    if len(cells) > 1 and fit[-2] and _are_units(cells[-1], cells[-2]):
        units = (unit.strip(_BRACKETS) for unit in cells[-1])
        pairs = zip_longest(cells[-2], units, fillvalue="")
        return tuple(f"{name} [{unit}]" if name and unit else name or unit for name, unit in pairs)
    found = next((row for row, fits in zip(cells[::-1], fit[::-1], strict=True) if fits), ())
    found = found or next((row for row in cells[-1:] if _holds_a_number(row, width, most, comma)), [])
    return tuple(found or next((row[:most] for row in cells[-1:] if _has_more(row, most, comma)), ()))


def _name_channels(names: list[str], units: Sequence[str], comma: bool) -> list[str]:
    """The names of an oscilloscope's channels that have numbers, above a line of their units: `x-axis,1,2`."""
    known = all(unit.strip(_BRACKETS).strip().lower() in UNIT_BY_SPELLING for unit in units)
    numbered = len(names) > 1 and not is_number(names[0], comma) and all(map(str.isdigit, names[1:]))
    if not (known and numbered and len(names) == len(units)):
        return names
    return [*names[:1], *(f"channel {name}" for name in names[1:])]


def find_header_below(rows: Sequence[Sequence[str]], width: int, comma: bool) -> tuple[str, ...]:
    """Find names of columns below the first rows, as where a capture began before its board did; empty where none.

    They are of the rows' width, each another one, and most of them are known: a greeting is none.
    """
    for row in rows:
        names = _without_empty_end(list(row))
        if len(names) != width or len(set(names)) < width or not all(names):
            continue
        if any(is_number(name, comma) or name in NO_VALUE for name in names):
            continue
        if 2 * sum(read_heading(name).quantity is not None for name in names) > width > 1:
            return tuple(names)
    return ()


def _has_more(row: Sequence[str], most: int, comma: bool) -> bool:
    """Whether a line of names, just above the rows, goes on behind their cells: what its program never wrote."""
    named = bool(row) and all(row) and not any(is_number(cell, comma) for cell in row)
    return named and FEWEST_NAMED < most < len(row) <= most + MOST_WITHOUT_CELLS


def say_names_without_cells(before: Sequence[str], delimiter: str, header: Sequence[str]) -> list[str]:
    """Say which names of the line above the rows stand over no cells."""
    above = [COMMENT.sub("", line) for line in before if line.strip()]
    names = split_line(above[-1], delimiter) if above else []
    if len(names) <= len(header) or names[: len(header)] != list(header):
        return []
    bare = [name for name in names[len(header) :] if name]  # a sheet ends with empty cells
    return [f"Left out: the names {', '.join(bare)}, below which no row has a cell."] if bare else []


def _holds_a_number(row: Sequence[str], width: int, most: int, comma: bool) -> bool:
    """Whether a line just above the rows has names but for a few cells, as a sheet has where somebody calculated."""
    words = [cell for cell in row if cell and not is_number(cell, comma)]
    numbers = sum(is_number(cell, comma) for cell in row)
    return width <= len(row) <= most and row[:1] == words[:1] and 0 < FEWEST_NAMES * numbers <= len(words)


def _numbered(before: Sequence[str], width: int) -> tuple[str, ...]:
    """Names from comments that say which column is what, `% 7  Motor voltage (V)`; empty where there are none.

    One of several columns has its first and its last, or all of them: `% 8 9 Motor voltage [V] left, right: 1.2 1.3`.
    """
    found = [match for line in before if COMMENT.match(line) and (match := _OF_COLUMN.match(COMMENT.sub("", line)))]
    places = [[int(place) for place in match["places"].split()] for match in found]
    first = [one[0] for one in places]
    if len(found) < 2 or first != sorted(set(first)) or first[0] > 1 or places[-1][-1] > width - 1 + first[0]:
        return ()
    names = [f"column {k + 1}" for k in range(width)]
    for place, match in zip(places, found, strict=True):
        for k, name in enumerate(_several(match["name"], place[-1] - place[0] + 1)):
            names[place[0] - first[0] + k] = name
    return tuple(names)


def _several(text: str, count: int) -> list[str]:
    """The names in a text about so many columns: `Pose x,y,h [m]: 0 0 1` without the values of its example."""
    text = " ".join(_VALUES.sub("", text).split())
    if count < 2:
        return [text.split(",")[0].rstrip(" :")]
    unit = next(iter(_UNIT.findall(text)), "")
    base, *others = _UNIT.sub(" ", text).split(":")[0].split(",")
    words = base.split()
    if not words:  # (mission 0), state 8: which is whose, is not said
        return []
    items = [*words[-1:], *(other.split()[0] for other in others if other.split())][:count]
    return [" ".join((*words[:-1], item, *(part for part in (unit,) if "," not in part))).strip() for item in items]


def _are_units(row: Sequence[str], above: Sequence[str]) -> bool:
    """Whether a line is one of units, of which some columns have none, below a line of names."""
    units = [cell for cell in row if cell]
    if not units or len(row) > len(above):
        return False
    known = [cell.strip(_BRACKETS).strip().lower() in UNIT_BY_SPELLING for cell in units]
    if all(known) and len(units) > 1:
        return not all(name.strip(_BRACKETS).strip().lower() in UNIT_BY_SPELLING for name in above if name)
    alike = all(one or _is_like_a_unit(cell) for cell, one in zip(units, known, strict=True))
    return alike and any("[" in cell or "/" in cell or cell in _SURE for cell in units)


def _is_like_a_unit(cell: str) -> bool:
    return bool(_UNIT_ROW.match(cell)) or ("[" in cell and cell.strip(_BRACKETS) in _NO_UNIT)


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
