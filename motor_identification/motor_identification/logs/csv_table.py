"""A CSV file as columns of numbers, with the line of every complaint."""

import csv
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation
from math import isfinite
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from motor_model.errors import RecordingError

Number = TypeVar("Number", int, float)

_DELIMITERS = ",;\t"
_LARGEST_TIME = Decimal(2**63 - 1)  # [ns]


@dataclass(frozen=True)
class Table:
    """The wanted columns of a file, as text without surrounding blanks; a row for each line that is not blank."""

    path: Path
    lines: tuple[int, ...]  # the line of each row in the file, from 1
    cells: dict[str, list[str]]  # by column
    decimal_comma: bool = False  # 0,5 is a number where something else separates the columns

    def __len__(self) -> int:
        return len(self.lines)

    def numbers(self, column: str) -> NDArray[np.float64]:
        """The column as finite numbers, shape (K,).

        Raises:
            RecordingError: a cell is not a finite number.
        """
        return np.array(self._converted(column, _finite), dtype=np.float64)

    def nanoseconds(self, column: str) -> NDArray[np.int64]:
        """A column of seconds as whole nanoseconds, shape (K,); exact, which a float64 of seconds since 1970 is not.

        Raises:
            RecordingError: a cell is not a number, or is beyond 292 years.
        """
        return np.array(self._converted(column, _nanoseconds), dtype=np.int64)

    def _converted(self, column: str, convert: Callable[[str], Number]) -> list[Number]:
        numbers = []
        for line, cell in zip(self.lines, self.cells[column], strict=True):
            try:
                numbers.append(convert(cell.replace(",", ".") if self.decimal_comma else cell))
            except (ValueError, InvalidOperation) as error:
                what = f"'{cell}' is not a number" if cell else "the cell is empty"
                raise RecordingError(
                    f"{self.path}, line {line}, column {column}: {what}; correct or remove that line."
                ) from error
        return numbers


def read_table(path: Path, wanted: Sequence[str]) -> Table:
    """The wanted columns of a CSV file whose first line names its columns; commas, semicolons or tabs separate them.

    Raises:
        RecordingError: no such file, not text, empty, a column is missing or there twice, or fewer than 2 rows.
    """
    lines = _text(path).split("\n")
    header_line = next((line for line in lines if line.strip()), None)
    if header_line is None:
        raise RecordingError(f"{path} is empty: it needs a line of column names and a row for each sample.")
    delimiter = max(_DELIMITERS, key=header_line.count)
    try:
        reader = csv.reader(lines, delimiter=delimiter)
        rows = [(reader.line_num, [cell.strip() for cell in row]) for row in reader]
    except csv.Error as error:
        raise RecordingError(f"{path}, line {reader.line_num}: {error}; correct that line.") from error
    (_, header), *rows = [(line, row) for line, row in rows if any(row)]
    where = {column: _position(path, header, column) for column in wanted}
    if len(rows) < 2:
        raise RecordingError(f"{path} has {len(rows)} rows below its column names: at least 2 samples are needed.")
    cells = {column: [row[k] if k < len(row) else "" for _, row in rows] for column, k in where.items()}
    return Table(path, tuple(line for line, _ in rows), cells, decimal_comma=delimiter != ",")


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")  # with or without a byte order mark
    except FileNotFoundError as error:
        raise RecordingError(f"There is no file {path}: check the path.") from error
    except UnicodeDecodeError as error:
        raise RecordingError(f"{path} is not UTF-8 text: export it again as CSV in UTF-8.") from error
    except OSError as error:
        raise RecordingError(f"{path} cannot be read ({error.strerror}): give a CSV file.") from error


def _position(path: Path, header: list[str], column: str) -> int:
    if column not in header:
        there = ", ".join(name for name in header if name)
        raise RecordingError(f"{path} has no column {column}: name one of {there}.")
    if header.count(column) > 1:
        raise RecordingError(f"{path} has {header.count(column)} columns named {column}: rename all but one of them.")
    return header.index(column)


def _finite(cell: str) -> float:
    number = float(cell)
    if not isfinite(number):
        raise ValueError(cell)
    return number


def _nanoseconds(cell: str) -> int:
    time = Decimal(cell) * 1_000_000_000
    if not time.is_finite() or abs(time) > _LARGEST_TIME:
        raise ValueError(cell)
    return int(time.to_integral_value())
