"""Mends quotes: around rows as a whole, as a program leaves them that takes a row for a text, and over line breaks."""

import re
from collections.abc import Sequence

MOSTLY = 0.8  # of the first lines: a line of names may stand without
_LOOKED_AT = 100  # lines
_CLOSES = re.compile(r'\s*"\s*([,;\t|]|$)')  # a line that begins with the end of a cell
_ROW = re.compile(r'\s*"([^"]*[,;\t|][^"]*)"\s*$')


def unquote_rows(lines: Sequence[str]) -> Sequence[str]:
    """The lines without the quotes around each, where nearly all have them: `"10, 0.02, 0, 1520"`."""
    lines = _join_broken_rows(lines)
    begin = [line for line in lines[: 2 * _LOOKED_AT] if line.strip()][:_LOOKED_AT]
    if not begin or sum(bool(_ROW.match(line)) for line in begin) < MOSTLY * len(begin):
        return lines
    return [match[1] if (match := _ROW.match(line)) else line for line in lines]


def _join_broken_rows(lines: Sequence[str]) -> Sequence[str]:
    """Join rows with a cell that took its line break into quotes, where most rows do: `2.5,"0` and `",7` below it.

    So does a program write what it read from a serial port, to the end of each line. An empty line stays below.
    """
    begin = lines[:_LOOKED_AT]
    broken = sum(bool(line.count('"') % 2 and _CLOSES.match(line)) for line in begin)
    if 3 * broken < len(begin) or broken < 2:
        return lines
    joined = list(lines)
    for place in range(len(joined) - 1):
        if joined[place].count('"') % 2 and _CLOSES.match(joined[place + 1]):
            joined[place], joined[place + 1] = joined[place].rstrip() + joined[place + 1].strip(), ""
    return joined
