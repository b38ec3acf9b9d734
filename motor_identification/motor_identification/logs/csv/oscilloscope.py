"""Tables of oscilloscopes whose rows are numbered, or have no times: their header says how far apart they are."""

import re
from collections.abc import Sequence

from motor_identification.logs.csv.cells import is_number, split_line

_STEP = re.compile(r"tInc\s*=\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)")
_FIRST = re.compile(r"t0\s*=\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)")


def give_times(lines: Sequence[str]) -> tuple[Sequence[str], list[str]]:
    """Give rows the times that the first lines say (`Start` and `Increment`, or `t0 = …, tInc = …`), and say so.

    Other tables stay as they are. Each row stays in its line.
    """
    begin = [place for place, line in enumerate(lines[:50]) if line.strip()][:2]
    if not begin:
        return lines, []
    names = split_line(lines[begin[0]], ",")
    lower = [name.lower() for name in names]
    if "increment" in lower and len(begin) == 2:
        return _numbered(lines, begin[1], names, lower)
    step, first = _STEP.search(lines[begin[0]]), _FIRST.search(lines[begin[0]])
    if step is None or first is None:
        return lines, []
    channels = [name for name in names[1:] if name and "=" not in name]
    made = _rows(lines, begin[0] + 1, len(channels), 0, float(first[1]), float(step[1]))
    header = ",".join(("time [s]", *channels))
    return [*lines[: begin[0]], header, *made], [_said(float(step[1]))]


def _numbered(
    lines: Sequence[str], units_in: int, names: Sequence[str], lower: Sequence[str]
) -> tuple[Sequence[str], list[str]]:
    """Turn the numbers of rows into times: below `Start` and `Increment` stand those of the first row, and the step."""
    units = split_line(lines[units_in], ",")
    place = lower.index("increment")
    start = lower.index("start") if "start" in lower else place
    if len(units) <= place or is_number(units[0], comma=False) or not is_number(units[place], comma=False):
        return lines, []  # another table, whose rows have increments
    if float(units[place]) <= 0.0:
        return lines, []
    first = float(units[start]) if start != place and is_number(units[start], comma=False) else 0.0
    channels = [k for k in range(1, min(start, place)) if names[k]]
    header = ",".join(("time [s]", *(f"{names[k]} [{units[k]}]" for k in channels)))
    made = _rows(lines, units_in + 1, len(channels), 1, first, float(units[place]))
    return [*([""] * units_in), header, *made], [_said(float(units[place]))]


def _rows(lines: Sequence[str], begin: int, count: int, skipped: int, first: float, step: float) -> list[str]:
    """The rows with their times, and without the number that some have in front."""
    made: list[str] = []
    number = 0
    for line in lines[begin:]:
        cells = split_line(line, ",")
        if not cells or not is_number(cells[0], comma=False):
            made.append("")
            continue
        place = float(cells[0]) if skipped else number
        made.append(",".join((f"{first + place * step:.12g}", *cells[skipped : skipped + count])))
        number += 1
    return made


def _said(step: float) -> str:
    return f"Rows are {step * 1e3:.6g} ms apart, as the oscilloscope's header says."
