"""A JSON document as a table: a list of objects or of rows, or a list for each column, wherever it stands in there."""

import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from motor_identification.logs.csv.dialect import read_text
from motor_identification.logs.csv.table import Table
from motor_identification.logs.formats.json_lines import MOST_NAMES, flatten_members
from motor_model.errors import RecordingError

Columns: TypeAlias = "dict[str, list[Any]]"
RUN = "run in the file"  # the column by which the runs of one list are split
FEWEST_ROWS = 5  # of a run: of fewer, members are a vector's
DEEPEST = 4  # lists and objects around a table
MOST_TABLES = 1000  # that are looked at in one document
_NAMES = ("columns", "names", "header", "headers", "fields", "labels", "keys")  # of the columns, beside rows


@dataclass(frozen=True)
class _Found:
    """A table, the names and places that lead to it, and what a text beside it calls it."""

    columns: Columns
    path: tuple[str | int, ...]
    called: str = ""

    @property
    def size(self) -> int:
        """Values."""
        return sum(map(len, self.columns.values()))

    @property
    def rows(self) -> int:
        """Rows of it."""
        return len(next(iter(self.columns.values())))

    def is_run_beside(self, other: "_Found") -> bool:
        """Whether both are members of one list, and have the same columns."""
        where, there = ([None if isinstance(one, int) else one for one in path] for path in (self.path, other.path))
        return where == there and None in where and set(self.columns) == set(other.columns)


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
    """Read the table with the most values in a document; of a list of such, all, with the column RUN to split by.

    Raises:
        RecordingError: the document is damaged, or there is no table in it.
    """
    text, _ = read_text(path)
    try:
        document = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise RecordingError(f"{path} is no complete JSON: export it again.") from error
    found = list(islice(_tables(document, ()), MOST_TABLES + 1))
    if not found:
        raise RecordingError(f"{path} is JSON without a table of samples: export it as CSV.")
    best = max(found, key=lambda one: one.size)  # the first of them
    beside = [one for one in found if one.is_run_beside(best)]
    runs = [one for one in beside if one.rows >= FEWEST_ROWS] or [best]
    others = sum(set(one.columns) == set(best.columns) for one in found) - max(len(beside), 1)
    cells = {name: [_as_cell(value) for run in runs for value in run.columns[name]] for name in best.columns}
    if len(runs) > 1:
        labels = [f"{run.called or 'run'} {number}" for number, run in enumerate(runs, start=1)]
        cells[RUN] = [label for label, run in zip(labels, runs, strict=True) for _ in range(run.rows)]
    rows = sum(run.rows for run in runs)
    as_texts = {name: np.array(column, np.str_) for name, column in cells.items()}
    return Table(path, np.arange(1, rows + 1), as_texts, notes=_say_left_out(runs, len(beside), others))


def _say_left_out(runs: Sequence[_Found], beside: int, others: int) -> tuple[str, ...]:
    """Say how many runs there are, and which tables of the same columns are not read."""
    said = []
    if len(runs) > 1:
        said.append(f"The file has a list of {len(runs)} runs: a bag each (otherwise: --split).")
    if beside > len(runs):
        said.append(f"Left out: {beside - len(runs)} of the list, of fewer than {FEWEST_ROWS} rows.")
    if others > 0:
        number = "1 more table" if others == 1 else f"{others} more tables"
        said.append(f"Left out: {number} of the same columns (the largest is read): give each in a file of its own.")
    return tuple(said)


def _tables(value: Any, path: tuple[str | int, ...]) -> Iterator[_Found]:
    """The tables in a value of at least two rows and columns."""
    names: list[str] = []
    inner: list[tuple[str | int, Any]] = []
    if isinstance(value, dict):
        for columns in _of_columns({name: _in_order(column) for name, column in value.items()}):
            yield _Found(columns, path, _call(value))
        names = next((value[name] for name in _NAMES if _are_texts(value.get(name))), [])
        inner = list(value.items())
    elif isinstance(value, list):
        inner = list(enumerate(value))
        if len(value) >= 2:
            yield from (_Found(columns, path) for columns in _of_rows(value, []))
    for place, one in inner if len(path) < DEEPEST and not _is_plain(value) else ():
        if names and isinstance(one, list) and len(one) >= 2:
            yield from (_Found(columns, (*path, place)) for columns in _of_rows(one, names))
        if isinstance(one, dict | list):
            yield from _tables(one, (*path, place))


def _call(members: dict[str, Any]) -> str:
    """Name a run by the one text beside its columns: `"type": "step"`."""
    texts = [one for one in members.values() if isinstance(one, str) and one.strip()]
    return texts[0].strip()[:40] if len(texts) == 1 else ""


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
