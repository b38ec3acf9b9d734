"""Takes the quotes off rows that stand in quotes as a whole, as a program leaves them that takes a row for a text."""

import re
from collections.abc import Sequence

MOSTLY = 0.8  # of the first lines: a line of names may stand without
_LOOKED_AT = 100  # lines
_ROW = re.compile(r'\s*"([^"]*[,;\t|][^"]*)"\s*$')


def unquote_rows(lines: Sequence[str]) -> Sequence[str]:
    """The lines without the quotes around each, where nearly all have them: `"10, 0.02, 0, 1520"`."""
    begin = [line for line in lines[: 2 * _LOOKED_AT] if line.strip()][:_LOOKED_AT]
    if not begin or sum(bool(_ROW.match(line)) for line in begin) < MOSTLY * len(begin):
        return lines
    return [match[1] if (match := _ROW.match(line)) else line for line in lines]
