"""Tables as programs print matrices: brackets and a semicolon around each row, a line for each column, arrays of C."""

import re
from collections.abc import Sequence

from motor_identification.logs.csv.cells import COMMENT, is_number

_IN_BRACKETS = re.compile(r"[\[(]+[^\[\]()]+[\])]+,?$")
# `pwm = [20, 40, 60]`, of a program's own language: the separator behind the first number is put behind the name, too.
_ASSIGNED = re.compile(r"(?P<name>[^\W\d]\w*)\s*[=:]\s*[\[({]\s*(?P<rest>[^\s,;]+(?P<first>[,;]|\s).*?)[\])}]\s*[;,]?$")
# `CH1_Data_OutPut[1707]={`, the beginning of an array of C.
_ARRAY = re.compile(
    r"^[^\S\n]*(?:[\w ]+[^\S\n])?(?P<name>[^\W\d]\w*)\s*\[\s*\d*\s*\]\s*=\s*\{(?P<cells>[^{}]*)\}", re.M
)
MOSTLY = 0.9  # of the first lines
_LOOKED_AT = 100  # lines
MOST_COLUMNS, FEWEST_ROWS, LONGER = 20, 40, 5  # of a table that lies on its side: so many lines, and cells in each
NOTE = "The file has a line for each column: they are taken for columns."


def take_off_brackets(lines: Sequence[str]) -> Sequence[str]:
    """Take the brackets and the semicolons off rows such as `[0 0.02 5;`, where nearly every line ends with one."""
    begin = [line.strip() for line in lines[: 2 * _LOOKED_AT] if line.strip() and not COMMENT.match(line)][:_LOOKED_AT]
    if begin and sum(bool(_IN_BRACKETS.match(line)) for line in begin) >= MOSTLY * len(begin):  # as Python prints
        return [line if COMMENT.match(line) else line.strip().strip("[(]),; ") for line in lines]
    if sum(line.count(";") == 1 and line[-1] == ";" for line in begin) < MOSTLY * len(begin) or not begin:
        return lines
    return [line if COMMENT.match(line) else _without_brackets(line) for line in lines]


def _without_brackets(line: str) -> str:
    before, bracket, row = line.partition("[")
    inside = row if bracket and (not before.strip() or before.rstrip().endswith("=")) else line
    return inside.rstrip(" \t];")


def join_arrays(lines: Sequence[str]) -> Sequence[str]:
    """Make a line, `name={1,2,3}`, of each array of C that has cells; other text is none of them, and stays alone."""
    if not any("={" in line.replace(" ", "") for line in lines[:_LOOKED_AT]):
        return lines
    arrays = [(one["name"], "".join(one["cells"].split()).strip(",")) for one in _ARRAY.finditer("\n".join(lines))]
    joined = [f"{name}={{{cells}}}" for name, cells in arrays if "," in cells]
    return joined if len(joined) > 1 else lines


def turn_lines_into_columns(lines: Sequence[str]) -> tuple[Sequence[str], tuple[str, ...]]:
    """Turn a table that has a line for each column, and what has to be said of it; other tables as they are."""
    filled = [line.strip() for line in lines[: 10 * MOST_COLUMNS] if line.strip()]
    assigned = [_ASSIGNED.match(line) for line in filled]
    if all(assigned):
        filled = [f"{one['name']}{one['first']}{one['rest'].rstrip(' ,;')}" for one in assigned if one]
    if not 2 <= len(filled) <= MOST_COLUMNS or len(lines) > 10 * MOST_COLUMNS:
        return lines, ()
    for delimiter in (",", ";", "\t", None):
        comma = delimiter != "," and not any("." in line for line in filled)
        rows = [[cell.strip() for cell in line.rstrip(delimiter).split(delimiter)] for line in filled]
        if len({len(row) for row in rows}) != 1 or len(rows[0]) < max(FEWEST_ROWS, LONGER * len(rows)):
            continue
        named = not any(is_number(row[0], comma) for row in rows)
        if all(is_number(cell, comma) for row in rows for cell in row[named:]):
            return [";".join(row) for row in zip(*rows, strict=True)], (NOTE,)
    return lines, ()
