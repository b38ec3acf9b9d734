"""A JSON document as a table: a list of objects or of rows, or a list for each column, wherever it stands in there."""

import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from motor_identification.logs.columns.heading import read_heading
from motor_identification.logs.columns.names.words import split_words
from motor_identification.logs.columns.vocabulary import Quantity, words_of
from motor_identification.logs.csv.dialect import read_text
from motor_identification.logs.csv.table import Table
from motor_identification.logs.formats.json_lines import MOST_NAMES, flatten_members
from motor_identification.logs.rows.parts import MOST_RUNS
from motor_model.errors import RecordingError

Columns: TypeAlias = "dict[str, list[Any]]"
RUN = "run in the file"  # the column by which the runs of one list are split
FEWEST_ROWS = 5  # of a run: of fewer, members are a vector's
MOST_NAMED = 4  # channels in a sentence
DEEPEST = 4  # lists and objects around a table
MOST_TABLES = 100_000  # that are looked at in one document
NEXT = 2.0  # rows' lengths from one member of a list to the next at most, where these are one recording's batches
_RUNS = words_of("run runs trial trials test tests experiment experiments recording recordings session sessions")
_MOTORS = words_of("motor motors axis axes joint joints wheel wheels actuator actuators drive drives")
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

    @property
    def list_words(self) -> frozenset[str]:
        """The words of the name of the list that it is in."""
        names = [one for one, inner in pairwise(self.path) if isinstance(one, str) and isinstance(inner, int)]
        return frozenset(split_words(names[-1])) if names else frozenset()

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
    same = {one.path for one in found if set(one.columns) == set(best.columns)}  # one may be found in two ways
    others = len(same) - max(len(beside), 1)
    if _are_channels(beside):
        raise RecordingError(
            f"{path} has a list of channels ({', '.join(one.called for one in beside[:MOST_NAMED])}), and no table in "
            "which the voltage and the motion have a column each: export it as CSV."
        )
    batches = len(beside) > 1 and _go_on(beside)
    runs = beside if batches else [one for one in beside if one.rows >= FEWEST_ROWS] or [best]
    if len(runs) > MOST_RUNS and not batches:
        raise RecordingError(
            f"{path} has a list of {len(runs)} tables, whose times do not go on from one to the next: as runs they "
            f"are too many (at most {MOST_RUNS}). Make one table of those that are of one recording."
        )
    cells = {name: [_as_cell(value) for run in runs for value in run.columns[name]] for name in best.columns}
    if len(runs) > 1 and not batches:
        labels = [f"{run.called or 'run'} {number}" for number, run in enumerate(runs, start=1)]
        cells[RUN] = [label for label, run in zip(labels, runs, strict=True) for _ in range(run.rows)]
    rows = sum(run.rows for run in runs)
    as_texts = {name: np.array(column, np.str_) for name, column in cells.items()}
    said = _say_list(runs, batches) if len(runs) > 1 else []
    return Table(path, np.arange(1, rows + 1), as_texts, notes=(*said, *_say_left_out(len(beside) - len(runs), others)))


def _go_on(members: Sequence[_Found]) -> bool:
    """Whether times go on from one member of a list to the next by a row: batches of one recording.

    Where the list's name, or a text of their own, tells that they are runs, they are.
    """
    if members[0].list_words & _RUNS or len({one.called for one in members}) > 1:
        return False
    name = next((one for one in members[0].columns if read_heading(one).quantity is Quantity.TIME), "")
    try:
        times = [np.array(one.columns[name], np.float64) for one in members] if name else []
    except (TypeError, ValueError):  # times of day
        return False
    if not times:
        return False
    with np.errstate(over="ignore", invalid="ignore"):  # a damaged cell may be any number
        within = np.concatenate([np.diff(one) for one in times])
        between = np.array([after[0] - before[-1] for before, after in pairwise(times)])
        rise = bool(np.all(within >= 0.0) and np.all(between >= 0.0))
        return rise and bool(0.0 < np.median(between) <= NEXT * np.median(within))


def _are_channels(members: Sequence[_Found]) -> bool:
    """Whether the members of a list are columns rather than tables: values, named as different quantities."""
    told = {read_heading(one.called).quantity for one in members} - {None, Quantity.OTHER}
    values = [one for one in members[0].columns if read_heading(one).quantity is None] if members else []
    return len(told) > 1 and len(members[0].columns) == 2 and bool(values)


def _say_list(members: Sequence[_Found], batches: bool) -> list[str]:
    """Say as what the members of a list are read."""
    number = len(members)
    if batches:
        return [f"The file has a list of {number} tables, whose times go on from one to the next: one recording."]
    said = [f"The file has a list of {number} runs: a bag each (otherwise: --split)."]
    sides = [read_heading(one.called).side for one in members]
    if members[0].list_words & _MOTORS or (all(sides) and len(set(sides)) > 1):
        said.append("Caution: by their name they may be different motors: identify each bag alone, then.")
    return said


def _say_left_out(few: int, others: int) -> tuple[str, ...]:
    """Say which tables of the same columns are not read: those of few rows in the list, and those elsewhere."""
    said = []
    if few > 0:
        said.append(f"Left out: {few} of the list, of fewer than {FEWEST_ROWS} rows.")
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
