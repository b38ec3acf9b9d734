"""Turn blocks of lines, a `name: value` each, into rows: what `ros2 topic echo` shows, or a program reports."""

import re
from collections.abc import Iterator, Sequence

SEPARATOR = ";"
NOTE = "The file has a block of lines for each sample: they are taken for rows."
MOST_NAMES = 1000
_LOOKED_AT, _MOSTLY, _FEWEST = 400, 0.9, 3  # lines at the beginning, the share that is of blocks, blocks
_END = re.compile(r"\s*([-=*_#])\1{2,}\s*$")  # ---
_LINE = re.compile(
    r"(?P<indent>[ \t]*)(?P<item>(?:- )*)(?P<name>[^\W\d][\w .%°/()\[\]]{0,40}?)\s{0,8}[:=](?:\s+|$)(?P<value>.*)$"
)
_ITEM = re.compile(r"(?P<indent>[ \t]*)- (?P<value>[^:]*)$")
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?$")
_LIST = re.compile(r"\[(.*)\]$")


def turn_blocks_into_rows(lines: Sequence[str]) -> tuple[Sequence[str], tuple[str, ...]]:
    """Turn a file of blocks into a line of names and a row for each, and what has to be said; others as they are."""
    begin = [line for line in lines[:_LOOKED_AT] if line.strip()]
    told = [line for line in begin if _END.match(line) or _ITEM.match(line) or _is_named(line)]
    if len(told) < _MOSTLY * len(begin) or sum(map(_is_named, begin)) < 2 * _FEWEST:
        return lines, ()
    rows = [row for block in _blocks(lines) if (row := dict(_values(block)))]
    names = list(dict.fromkeys(name for row in rows for name in row))
    if len(rows) < _FEWEST or not 2 <= len(names) <= MOST_NAMES:
        return lines, ()
    return [SEPARATOR.join(names), *(SEPARATOR.join(row.get(name, "") for name in names) for row in rows)], (NOTE,)


def _is_named(line: str) -> bool:
    """Whether a line has one name, and behind it one value, a list of them, or nothing."""
    match = _LINE.match(line)
    value = match["value"].strip() if match else ","
    return match is not None and bool(_LIST.match(value) or not re.search(r"[,;|\t]|\S\s+\S+\s*[:=]", value))


def _blocks(lines: Sequence[str]) -> Iterator[list[str]]:
    """The blocks: between lines of `---`, else from each line of the first name on."""
    parted = any(_END.match(line) for line in lines)
    named = next((match for match in map(_LINE.match, lines) if match), None)
    first = (named["indent"], named["name"]) if named else ("", "")
    block: list[str] = []
    for line in lines:
        match = None if parted else _LINE.match(line)
        if _END.match(line) or (match and (match["indent"], match["name"]) == first):
            yield block
            block = []
        if line.strip() and not _END.match(line):
            block.append(line)
    yield block


def _values(block: Sequence[str]) -> Iterator[tuple[str, str]]:
    """The numbers of a block by the names that lead to them; those of a list of several by their place."""
    above: list[tuple[int, str]] = []
    items: dict[str, list[str]] = {}
    for line in block:
        match = _LINE.match(line)
        item = None if match else _ITEM.match(line)
        if item:
            while above and above[-1][0] > len(item["indent"]):
                above.pop()
            items.setdefault(" ".join(name for _, name in above), []).append(item["value"].strip())
        elif match:
            indent = len(match["indent"]) + len(match["item"])
            while above and above[-1][0] >= indent:
                above.pop()
            above.append((indent, match["name"].strip()))
            listed = _LIST.match(match["value"].strip())
            values = listed[1].split(",") if listed else [match["value"]] if match["value"].strip() else []
            items.setdefault(" ".join(name for _, name in above), []).extend(value.strip() for value in values)
    for name, found in items.items():
        for place, value in enumerate(found, start=1):
            number = value.split()[0] if value.split() else ""
            if _NUMBER.match(number):
                yield name if len(found) == 1 else f"{name} {place}", number
