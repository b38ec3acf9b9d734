"""A JSON document as a table: a list of objects or of rows, or a list for each column, wherever it stands in there."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from motor_identification.logs.csv.dialect import read_text
from motor_identification.logs.csv.table import Table
from motor_identification.logs.formats.json_lines import MOST_NAMES, flatten_members
from motor_model.errors import RecordingError

Columns: TypeAlias = "dict[str, list[Any]]"
DEEPEST = 4  # lists and objects around a table
MOST_TABLES = 1000  # that are looked at in one document
_NAMES = ("columns", "names", "header", "headers", "fields", "labels", "keys")  # of the columns, beside rows


def may_be_document(head: bytes) -> bool:
    """Whether a file that begins so may be a JSON document; a matrix in brackets may begin so, too."""
    return re.match(rb"(?:\xef\xbb\xbf)?\s*(?:\{|\[\s*[\[{])", head) is not None


def is_document(path: Path) -> bool:
    """Whether all of a file is one."""
    try:
        json.loads(read_text(path)[0])
    except (ValueError, RecursionError):
        return False
    return True


def read_json_table(path: Path) -> Table:
    """Read the table with the most values in a document.

    Raises:
        RecordingError: the document is damaged, or there is no table in it.
    """
    text, _ = read_text(path)
    try:
        document = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise RecordingError(f"{path} is no complete JSON: export it again.") from error
    best: Columns = {}
    for number, columns in enumerate(_tables(document, 0)):
        if _size(columns) > _size(best):
            best = columns
        if number >= MOST_TABLES:
            break
    if not best:
        raise RecordingError(f"{path} is JSON without a table of samples: export it as CSV.")
    rows = len(next(iter(best.values())))
    cells = {name: np.array([_as_cell(value) for value in column], np.str_) for name, column in best.items()}
    return Table(path, np.arange(1, rows + 1), cells)


def _size(columns: Columns) -> int:
    return sum(map(len, columns.values()))


def _tables(value: Any, depth: int) -> Iterator[Columns]:
    """The tables in a value of at least two rows and columns."""
    names: list[str] = []
    inner: list[Any] = []
    if isinstance(value, dict):
        yield from _of_columns({name: _in_order(column) for name, column in value.items()})
        names = next((value[name] for name in _NAMES if _are_texts(value.get(name))), [])
        inner = list(value.values())
    elif isinstance(value, list):
        inner = value
        if len(value) >= 2:
            yield from _of_rows(value, [])
    for one in inner if depth < DEEPEST and not _is_plain(value) else ():
        if names and isinstance(one, list) and len(one) >= 2:
            yield from _of_rows(one, names)
        if isinstance(one, dict | list):
            yield from _tables(one, depth + 1)


def _in_order(column: Any) -> Any:
    """A column's values; as pandas writes them, an object with a member for each row."""
    if isinstance(column, dict) and all(name.isdigit() for name in column):
        return list(column.values())
    return column


def _is_plain(value: Any) -> bool:
    """Whether a value holds nothing but numbers and texts, or rows of them."""
    return isinstance(value, list) and not any(isinstance(one, dict) for one in value[:2])


def _are_texts(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(one, str) for one in value)


def _of_columns(members: dict[str, Any]) -> Iterator[Columns]:
    """Members that are lists of values, those of the length that most have."""
    lists = {name: one for name, one in members.items() if isinstance(one, list) and len(one) >= 2 and _are_values(one)}
    lengths = [len(one) for one in lists.values()]
    if lengths:
        most = max(set(lengths), key=lambda length: (lengths.count(length), length))
        if 2 <= lengths.count(most) <= MOST_NAMES:
            yield {name: one for name, one in lists.items() if len(one) == most}


def _of_rows(rows: list[Any], names: list[str]) -> Iterator[Columns]:
    """Objects, or lists of one length, one below the other."""
    if all(isinstance(row, dict) for row in rows):
        flat = [flatten_members(row) for row in rows]
        known = dict.fromkeys(name for row in flat for name in row)
        if 2 <= len(known) <= MOST_NAMES:
            yield {name: [row.get(name, "") for row in flat] for name in known}
    elif all(isinstance(row, list) and len(row) == len(rows[0]) >= 2 and _are_values(row) for row in rows):
        width = len(rows[0])
        said = names if len(names) == width else [f"column {k + 1}" for k in range(width)]
        yield {name: [row[k] for row in rows] for k, name in enumerate(said)}


def _are_values(values: list[Any]) -> bool:
    return not any(isinstance(one, dict | list) for one in values)


def _as_cell(value: Any) -> str:
    if value is None:
        return ""
    return str(int(value)) if isinstance(value, bool) else str(value)[:100]
