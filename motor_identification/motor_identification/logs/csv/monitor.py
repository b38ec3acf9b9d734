"""Takes apart the lines of serial monitors: a stamp before each line, and cells that carry their names."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.vocabulary import MOVES, SHARES, UNIT_BY_SPELLING, UNITS, Quantity

RECEIVED = "received time"  # the column of a monitor's stamps: the last, so that a board's own clock goes before
MOSTLY = 0.8  # of the first lines: others are the program's greetings
_LOOKED_AT = 100  # lines
_STAMPS = (
    re.compile(r"\s{0,8}\[?(\d{1,2}:\d\d:\d\d[.,]\d{1,6})\]?\s{0,8}(?:->|>)\s*(.*)$"),
    re.compile(r"(?:\x1b\[[\d;]{1,8}m)?[EWIDV] \((\d{1,10})\) [^:]{1,40}: ?([^\x1b]*)"),  # an ESP32's log, in ms
    re.compile(r"(\d{4}-\d\d-\d\d[ T]\d\d:\d\d:\d\d[.,]\d{3,6}) - (?:[^-=:]{1,40} - ){0,3}(.*)$"),  # Python's
)
_CELL = (
    r"\s{0,8}(?P<name>[^\W\d][\w /%°\[\]()]{0,40}?)\s{0,8}[:=]"
    r"\s{0,8}(?P<value>[+-]?(?:\d+(?:[.,]\d+|\.)?|\.\d+)(?:[eE][+-]?\d+)?)"
    # A tab parts cells: what stands behind one is a unit only where it is all of its cell.
    r"(?:\s{0,8}(?=[^\s,;|:=]{1,9}[^\S\t]{0,8}(?:[\t,;|]|$))|[^\S\t]{0,8})"
    r"(?P<unit>[^\W\d_][\w/]{0,7}(?![\w/]*\s{0,8}[:=])|%|°)?\s{0,8}"
)
_NAME, _NUMBER = re.compile(r"[^\W\d][\w /%°\[\]()]{0,40}"), re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_NAMED_CELL = re.compile(_CELL + r"(?:[,;|\t ]|$)")
_TWO_WORDS = re.compile(
    r"(?P<unit>[^\W\d_][\w/]{0,7}|%|°)[^\S\t]{1,8}(?P<name>[^\W\d][\w /%°\[\]()]{0,40}?)\s{0,8}[:=]"
)


@dataclass(frozen=True)
class Lines:
    """The lines of a table, as many as before; `names` of its columns where every cell carried its own."""

    lines: Sequence[str]
    names: tuple[str, ...] = ()
    stamped: bool = False


def take_apart(lines: Sequence[str]) -> Lines:
    """Move the stamps of a serial monitor behind its lines, and the names of cells before all of them."""
    delimiter = ""
    begin = [line for line in lines[: 2 * _LOOKED_AT] if line.strip()][:_LOOKED_AT]
    stamp = next((one for one in _STAMPS if _mostly(begin, [bool(one.match(line)) for line in begin])), None)
    stamped = stamp is not None
    if stamp is not None:
        delimiter = _delimiter([match[2] for match in map(stamp.match, begin) if match])
        lines = [_stamp_last(line, stamp, delimiter) for line in lines]
        begin = [line.rpartition(delimiter)[0] for line in lines[:_LOOKED_AT] if line.strip()]
    pairs = _Pairs.find(begin) if not stamped else None
    if pairs is not None:
        return Lines([pairs.values(line) for line in lines], pairs.names)
    named = [_named_cells(line) for line in begin]
    names = max((tuple(row) for row in named), key=len, default=())
    if len(names) < 2 or not _mostly(begin, [tuple(row) == names for row in named]):
        return Lines(lines, stamped=stamped)
    rows = [_values(line, names, delimiter if stamped else "") for line in lines]
    return Lines(rows, (*names, RECEIVED) if stamped else names, stamped)


@dataclass(frozen=True)
class _Pairs:
    """Rows in which a name stands before each number, as cells of their own: `t,1023,PWM,50,speed,3.2`."""

    names: tuple[str, ...]
    delimiter: str

    @staticmethod
    def find(begin: Sequence[str]) -> "_Pairs | None":
        """The names that most of the first lines have; None where they are written in another way."""
        delimiter = _delimiter(begin)
        rows = [tuple(cell.strip() for cell in line.split(None if delimiter == " " else delimiter)) for line in begin]
        names = max((row[::2] for row in rows if len(row) % 2 == 0), key=len, default=())
        told = len(set(names)) == len(names) > 1 and all(map(_NAME.fullmatch, names))
        if not told or not _mostly(begin, [_is_pairs(row, names) for row in rows]):
            return None
        return _Pairs(names, delimiter)

    def values(self, line: str) -> str:
        """The cells of a line without their names, by semicolons; a line of other names as it is."""
        row = tuple(cell.strip() for cell in line.split(None if self.delimiter == " " else self.delimiter))
        return ";".join(row[1::2]) if _is_pairs(row, self.names) else line


def _is_pairs(row: Sequence[str], names: Sequence[str]) -> bool:
    return tuple(row[::2]) == tuple(names) and all(map(_NUMBER.fullmatch, row[1::2]))


def _mostly(lines: Sequence[str], which: Sequence[bool]) -> bool:
    return len(lines) > 1 and sum(which) >= MOSTLY * len(lines)


def _delimiter(lines: Sequence[str]) -> str:
    """What separates the cells behind the stamps."""
    return next((sign for sign in "\t;,|" if sum(sign in line for line in lines) >= MOSTLY * len(lines)), " ")


def _stamp_last(line: str, stamp: re.Pattern[str], delimiter: str) -> str:
    match = stamp.match(line)
    if match is None:
        return line
    rest = match[2].rstrip()
    if not any(sign.isdigit() for sign in rest):
        return f"{rest}{delimiter}{RECEIVED.replace(' ', '_')}"  # column names
    return f"{rest}{delimiter}{match[1].replace(',', '.').replace(' ', 'T')}"


def _named_cells(line: str) -> dict[str, str]:
    """Values by name; none where something else is in the line."""
    found: dict[str, str] = {}
    place = 0
    while place < len(line):
        match = _NAMED_CELL.match(line, place)
        if match is None or match["name"] in found:
            return {}
        place = match.end()
        spelt = match["unit"] or ""
        if not spelt and "\t" in line[match.end("value") : place] and (behind := _find_unit(match)):
            spelt, place = behind["unit"], behind.start("name")
        unit = UNIT_BY_SPELLING.get(spelt.lower(), spelt)
        if unit and unit not in UNITS and _stands_apart(match):
            return {}
        found[f"{match['name']} [{unit}]" if unit else match["name"]] = match["value"]
    return found


def _find_unit(cell: re.Match[str]) -> re.Match[str] | None:
    """The unit behind a cell's tab, and the name behind a blank: one that people know, of what the cell's name tells.

    What follows has to tell something without it: `PWM: 236<tab>V motor: 5` begins a name.
    """
    words = _TWO_WORDS.match(cell.string, cell.end())
    unit = UNIT_BY_SPELLING.get(words["unit"].lower()) if words else None
    return words if words and unit and _parts(cell["name"], unit, words["name"]) else None


@lru_cache(maxsize=1000)
def _parts(before: str, unit: str, behind: str) -> bool:
    """Whether a unit may be that of what the name before it tells, and the name behind it tells something, too."""
    kinds = (MOVES, frozenset({Quantity.VOLTAGE, Quantity.SUPPLY}))
    told, of_unit = read_heading(before), UNITS[unit][0]
    if read_heading(behind).quantity is None:
        return False
    if told.quantity in (None, Quantity.REFERENCE, Quantity.OTHER, of_unit):
        return True
    if told.quantity is Quantity.DUTY:  # a command may be in volts, a share of the supply is not
        return of_unit is Quantity.VOLTAGE and not SHARES & set(told.words)
    return any(told.quantity in kind and of_unit in kind for kind in kinds)


def _stands_apart(cell: re.Match[str]) -> bool:
    """Whether a blank is before what follows a number, of which nobody knows that it is a unit: `0.03 lbs`, `3 ok`."""
    return cell.string[cell.end("value")].isspace()


def _values(line: str, names: Sequence[str], before_stamp: str) -> str:
    """The cells of a line without their names, by semicolons; a line of other names as it is."""
    text, _, stamp = line.rpartition(before_stamp) if before_stamp else (line, "", "")
    found = _named_cells(text.rstrip(",;| \t"))
    if list(found) != list(names):
        return line
    return ";".join([*found.values(), *([stamp] if before_stamp else [])])
