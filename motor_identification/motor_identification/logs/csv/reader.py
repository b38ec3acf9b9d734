"""Reads a text table: all of its columns, chunk by chunk, with the line of each row."""

import csv
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.csv.blocks import turn_blocks_into_rows
from motor_identification.logs.csv.cells import COMMENT, SPACES, is_number, split_line
from motor_identification.logs.csv.dialect import LOOKED_AT, Dialect, find_dialect, read_text
from motor_identification.logs.csv.header import say_names_without_cells
from motor_identification.logs.csv.matrix import join_arrays, take_off_brackets, turn_lines_into_columns
from motor_identification.logs.csv.monitor import RECEIVED, Lines, take_apart
from motor_identification.logs.csv.oscilloscope import give_times
from motor_identification.logs.csv.quotes import unquote_rows
from motor_identification.logs.csv.sentences import drop_sentences, drop_words
from motor_identification.logs.csv.table import GARBLED, Table
from motor_identification.logs.csv.table_end import NEARLY_ALL, cut_at_end, leave_out_cut_number
from motor_model.errors import RecordingError

_CHUNK = 50_000  # rows: lists of texts take ten times the memory of arrays
LONG_ROW = 10  # numbers: fewer may be a table of one sample


def read_table(path: Path, wanted: Sequence[str] = ()) -> Table:
    """All columns of a text table; commas, semicolons, tabs, bars or blanks separate them.

    Args:
        path: the file.
        wanted: columns that have to be there, once.

    Raises:
        RecordingError: no such file, not text, empty, a column is missing or there twice, or fewer than 2 rows.
    """
    text, encoding = read_text(path)
    if not text.strip():
        raise RecordingError(f"{path} is empty: it needs a line of column names and a row for each sample.")
    notes = [f"The file is read as {encoding}, as it is not UTF-8."] if encoding else []
    return leave_out_cut_number(table_of(path, text.splitlines(), notes, wanted), text)


def table_of(path: Path, text: Sequence[str], notes: list[str], wanted: Sequence[str] = ()) -> Table:
    """Make a table of lines; the other arguments are as of `read_table`, and notes what has to be said of the file.

    Raises:
        RecordingError: as there.
    """
    timed, said = give_times(unquote_rows(text))
    in_rows, of_blocks = turn_blocks_into_rows(timed)
    upright, turned = turn_lines_into_columns(take_off_brackets(join_arrays(in_rows)))
    notes = [*notes, *said, *of_blocks, *turned]
    taken = take_apart(upright)
    lines = taken.lines
    dialect = find_dialect(lines)
    if dialect is None:
        raise RecordingError(_no_rows(path, lines))
    dialect = _named_by_lines(dialect, taken)
    for column in wanted:
        _check_column(path, dialect.header, column)
    lines, said = cut_at_end(lines, dialect)
    notes += said
    notes += say_names_without_cells(lines[: dialect.first_row], dialect.delimiter, dialect.header)
    notes += _say_rows_above(lines, dialect)
    numbers, columns = _columns(path, lines, dialect, notes)
    if len(numbers) < 2:
        raise RecordingError(_too_few(path, len(numbers), dialect.header))
    return Table(path, numbers, columns, dialect.decimal_comma, tuple(notes))


def _say_rows_above(lines: Sequence[str], dialect: Dialect) -> list[str]:
    """Say which lines above the rows have as many numbers, but not their number of cells."""
    found = []
    for place, line in enumerate(lines[: dialect.first_row], start=1):
        cells = split_line(line, dialect.delimiter)
        if (
            not COMMENT.match(line)
            and len(cells) > 1
            and all(is_number(cell, dialect.decimal_comma) for cell in cells[:2])
        ):
            found.append(place)
    return [f"Left out: {_lines(found)} above the rows, with other cells than they have."] if found else []


def _named_by_lines(dialect: Dialect, taken: Lines) -> Dialect:
    """The dialect with the names of columns that a serial monitor's lines themselves tell."""
    if taken.names:
        return replace(dialect, header=taken.names, named=True)
    if taken.stamped and not dialect.named:
        return replace(dialect, header=(*dialect.header[:-1], RECEIVED))
    return dialect


def _no_rows(path: Path, lines: Sequence[str]) -> str:
    rows = sum(bool(line.strip()) for line in lines) - 1
    if rows < 2:
        return _too_few(path, rows, ())
    alone = [is_number(line.strip(), comma=True) or is_number(line.strip(), comma=False) for line in lines[:LOOKED_AT]]
    if sum(alone) > NEARLY_ALL * len(alone) - 1:
        return (
            f"{path} has one column of numbers: give a table that has the voltage or duty and the motion side by side."
        )
    return f"{path} has no rows of numbers in its first lines: give a table with a line of column names and then rows."


def _too_few(path: Path, rows: int, header: Sequence[str]) -> str:
    if rows == 1 and len(header) > LONG_ROW and header[0] == "column 1":
        return (
            f"{path} is one row of {len(header)} numbers, a signal alone: give a table that has the voltage or duty "
            "and the motion side by side, and a line for each sample."
        )
    return f"{path} has {rows} row{'' if rows == 1 else 's'} below its column names: at least 2 samples are needed."


def _columns(
    path: Path, lines: Sequence[str], dialect: Dialect, notes: list[str]
) -> tuple[NDArray[np.int64], dict[str, NDArray[Any]]]:
    """Line numbers and cells of all rows, chunk by chunk; a last line that was cut off is left out."""
    width, numbers, parts = len(dialect.header), [], []
    left_out: list[int] = []
    sentences: list[int] = []
    garbled: list[int] = []
    remarks: list[int] = []
    rows = drop_sentences(_rows(path, lines, dialect), width, dialect.decimal_comma, sentences)
    rows = drop_words(rows, dialect.decimal_comma, left_out)
    rows = _cut_remarks(rows, width, dialect.decimal_comma, remarks)
    while chunk := list(islice(rows, _CHUNK)):
        longer = [line for line, row in chunk if any(row[width:])]
        if len(longer) > GARBLED * len(chunk):
            raise RecordingError(
                f"{path}, line {longer[0]} has more cells than columns are named ({width}): name them all, or separate "
                "columns by semicolons where commas are decimal signs."
            )
        garbled += longer
        chunk = [(line, row) for line, row in chunk if not any(row[width:])] if longer else chunk
        last = chunk[-1]
        numbers.append([line for line, _ in chunk])
        padded = [row if len(row) == width else (row + [""] * width)[:width] for _, row in chunk]
        parts.append([np.char.encode(np.array(column), "utf-8") for column in zip(*padded, strict=True)])
        cut = len(last[1]) < width
    if numbers and cut and sum(map(len, numbers)) > 2:
        notes.append(f"Line {numbers[-1][-1]}, the last, is cut off and left out.")
        numbers[-1].pop()
        parts[-1] = [column[:-1] for column in parts[-1]]
    if garbled:
        notes.append(f"Left out: {_lines(garbled)} with more cells than columns are named ({width}).")
    if remarks:
        notes.append(f"Left out: words behind the last named column, in {_lines(remarks)}.")
    if left_out:
        notes.append(f"Left out: {_lines(left_out)} without a number (comments, names of columns).")
    if sentences:
        notes.append(f"Left out: {_lines(sentences)} of words and few numbers, as of a board that starts again.")
    names = _unique(dialect.header)
    columns = {name: np.concatenate([part[k] for part in parts]) for k, name in enumerate(names)}
    return np.array([line for chunk_lines in numbers for line in chunk_lines], np.int64), columns


def _cut_remarks(
    rows: Iterable[tuple[int, list[str]]], width: int, comma: bool, remarks: list[int]
) -> Iterator[tuple[int, list[str]]]:
    """Cut words off behind the last column that has a name, as of remarks beside a table; their lines are noted."""
    for line, row in rows:
        beyond = [cell for cell in row[width:] if cell]
        if beyond and not any(is_number(cell, comma) for cell in beyond):
            remarks.append(line)
            row = row[:width]
        yield line, row


def _lines(numbers: Sequence[int]) -> str:
    if len(numbers) == 1:
        return f"line {numbers[0]}"
    return f"{len(numbers)} lines (the first is {numbers[0]})"


def _rows(path: Path, lines: Sequence[str], dialect: Dialect) -> Iterable[tuple[int, list[str]]]:
    begin = dialect.first_row
    if dialect.delimiter == SPACES:
        yield from ((begin + k + 1, split_line(line, SPACES)) for k, line in enumerate(lines[begin:]) if line.strip())
        return
    reader = csv.reader(islice(lines, begin, None), delimiter=dialect.delimiter, skipinitialspace=True)
    try:
        for row in reader:
            cells = [cell.strip() for cell in row]
            if any(cells):
                yield begin + reader.line_num, cells
    except csv.Error as error:
        raise RecordingError(f"{path}, line {begin + reader.line_num}: {error}; correct that line.") from error


def _unique(header: Sequence[str]) -> list[str]:
    """Names that are there twice get their number, those that are empty their place."""
    names: list[str] = []
    taken: set[str] = set()  # a line may have a hundred thousand
    for place, name in enumerate(header, start=1):
        here = name or f"column {place}"
        names.append(here if here not in taken else f"{here} #{place}")
        taken.add(names[-1])
    return names


def _check_column(path: Path, header: Sequence[str], column: str) -> None:
    if column in _unique(header) and header.count(column) < 2:
        return
    if header.count(column) > 1:
        raise RecordingError(f"{path} has {header.count(column)} columns named {column}: rename all but one of them.")
    there = ", ".join(name for name in _unique(header))
    raise RecordingError(f"{path} has no column {column}: name one of {there}.")
