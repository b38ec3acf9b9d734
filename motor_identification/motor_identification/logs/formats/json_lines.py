"""JSON lines: an object of numbers a line, as loggers of messages write them."""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np

from motor_identification.logs.csv.dialect import read_text
from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError

_WORDS = re.compile(r"\b(?:True|False|None)\b(?!\")")
MOST_NAMES = 1000  # columns


def are_json_lines(head: str) -> bool:
    """Whether a file that begins so has an object in every line; `head` ends anywhere."""
    first, end, _ = head.lstrip("\ufeff \r\n\t").partition("\n")
    return bool(end) and isinstance(_load(first), dict)


def read_json_lines(path: Path) -> Table:
    """The objects' members as columns; those of a member that is an object itself are named `outer inner`.

    Raises:
        RecordingError: a line is no object, or there are fewer than 2.
    """
    text, _ = read_text(path)
    numbers, rows = [], []
    names: dict[str, None] = {}
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.strip():
            continue
        members = _load(line)
        if not isinstance(members, dict):
            raise RecordingError(f"{path}, line {number} is no JSON object: correct or remove that line.")
        rows.append(flatten_members(members))
        numbers.append(number)
        names.update(dict.fromkeys(rows[-1]))
        if len(names) > MOST_NAMES:
            raise RecordingError(f"{path}, line {number}: more than {MOST_NAMES} names: export fewer of them.")
    if len(rows) < 2:
        raise RecordingError(f"{path} has {len(rows)} lines: at least 2 samples are needed.")
    cells = {name: np.array([row.get(name, "") for row in rows], np.str_) for name in names}
    return Table(path, np.array(numbers, np.int64), cells)


def _load(line: str) -> Any:
    try:
        return json.loads(line if '"' in line else _of_python(line))
    except (ValueError, RecursionError):
        return None


def _of_python(line: str) -> str:
    """A dictionary as Python prints it: `{'t': 0.1, 'on': True}`."""
    quoted = line.replace("'", '"')
    return _WORDS.sub(lambda match: {"True": "true", "False": "false", "None": "null"}[match[0]], quoted)


def flatten_members(members: dict[str, Any]) -> dict[str, str]:
    """Flatten an object to numbers and texts by name; what is a list or lies deeper is left out."""
    found: dict[str, str] = {}
    for name, value in members.items():
        inner = value.items() if isinstance(value, dict) else [("", value)]
        for key, one in inner:
            if isinstance(one, (int, float, str)):
                found[f"{name} {key}".strip()] = str(int(one)) if isinstance(one, bool) else str(one)[:100]
    return found
