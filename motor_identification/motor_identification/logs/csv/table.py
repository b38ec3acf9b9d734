"""A table as columns of numbers, with the line of every complaint."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motor_identification.logs.csv.cells import clock_nanoseconds, is_number, with_point
from motor_model.errors import RecordingError

Cells = Sequence[str] | NDArray[Any]

GARBLED = 0.01  # of the rows: a serial line loses a character now and then; more is another kind of table
_LARGEST_TIME = 2**63 - 1  # [ns]
_ROUNDED_BELOW = 2**50  # [ns] 13 days: below, a float64 of seconds is right to a quarter of a nanosecond


@dataclass(frozen=True)
class Table:
    """The columns of a file; a row for each line that is not blank, as text or as numbers."""

    path: Path
    lines: Sequence[int] | NDArray[np.int64]  # the line of each row in the file, from 1
    cells: Mapping[str, Cells]  # by column
    decimal_comma: bool = False  # 0,5 is a number
    notes: tuple[str, ...] = ()  # what had to be assumed to read it
    _known: dict[str, NDArray[np.float64]] = field(default_factory=dict, init=False, repr=False, compare=False)

    def __len__(self) -> int:
        return len(self.lines)

    @property
    def names(self) -> list[str]:
        """The columns, from left to right."""
        return list(self.cells)

    def text(self, column: str, row: int) -> str:
        """One cell."""
        return _as_text(self.column(column)[row])

    def column(self, column: str) -> Cells:
        """The cells of a column.

        Raises:
            RecordingError: there is none of this name.
        """
        if column not in self.cells:
            there = ", ".join(name for name in self.cells if name)
            raise RecordingError(f"{self.path} has no column {column}: name one of {there}.")
        return self.cells[column]

    def numbers(self, column: str) -> NDArray[np.float64]:
        """The column as finite numbers, shape (K,), not to be written to: they are read once.

        Raises:
            RecordingError: a cell is not a finite number.
        """
        if column not in self._known:
            values = self._read_numbers(column).view()
            values.flags.writeable = False
            self._known[column] = values
        return self._known[column]

    def _read_numbers(self, column: str) -> NDArray[np.float64]:
        cells = self.column(column)
        try:
            values = self._floats(cells)
        except ValueError:
            values = np.array([self._float(cell) for cell in cells])
        bad = ~np.isfinite(values)
        if bad.any():
            raise self._complaint(column, int(np.argmax(bad)))
        return values

    def readable(self, column: str) -> NDArray[np.bool_]:
        """Which cells of a column are finite numbers or a clock's times, shape (K,)."""
        cells = self.column(column)
        try:
            return np.isfinite(self._floats(cells))
        except ValueError:
            return np.array([is_number(_as_text(cell), self.decimal_comma) for cell in cells], np.bool_)

    def rows(self, which: NDArray[np.bool_] | NDArray[np.int64], note: str) -> "Table":
        """The rows of a mask or of these places, and a note that says so."""
        cells = {name: np.asarray(column)[which] for name, column in self.cells.items()}
        return replace(self, lines=np.asarray(self.lines)[which], cells=cells, notes=(*self.notes, note))

    def nanoseconds(self, column: str, unit: int = 10**9) -> NDArray[np.int64]:
        """A column of times as whole nanoseconds, shape (K,); exact, which a float64 of seconds since 1970 is not.

        Args:
            column: its name.
            unit: [ns] what one unit of it is.

        Raises:
            RecordingError: a cell is not a number, or is beyond 292 years.
        """
        cells = self.column(column)
        if isinstance(cells, np.ndarray) and cells.dtype == np.int64 and unit == 1:
            return cells
        try:
            with np.errstate(over="ignore"):  # times beyond are told below
                values = self._floats(cells) * float(unit)
            if np.all(np.abs(values) < _ROUNDED_BELOW):
                return np.rint(values).astype(np.int64)
        except ValueError:
            pass
        times = np.empty(len(cells), np.int64)
        for row, cell in enumerate(cells):
            try:
                times[row] = _exact_nanoseconds(self._with_point(cell), unit)
            except (ValueError, InvalidOperation) as error:
                raise self._complaint(column, row) from error
        return times

    def _floats(self, cells: Cells) -> NDArray[np.float64]:
        array = np.asarray(cells)
        if array.dtype.kind == "S" and self.decimal_comma:
            array = np.char.replace(array, b",", b".")
        elif array.dtype.kind == "U" and self.decimal_comma:
            array = np.char.replace(array, ",", ".")
        with np.errstate(over="ignore"):  # infinite, which is complained of
            return np.asarray(array, dtype=np.float64)

    def _float(self, cell: object) -> float:
        try:
            return float(self._with_point(cell))
        except ValueError:
            return float("nan")

    def _with_point(self, cell: object) -> str:
        return with_point(_as_text(cell), self.decimal_comma)

    def _complaint(self, column: str, row: int) -> RecordingError:
        cell = self.text(column, row)
        what = f"'{cell[:40]}' is not a number" if cell else "the cell is empty"
        return RecordingError(
            f"{self.path}, line {self.lines[row]}, {name_column(column)}: {what}; correct or remove that line."
        )


def _as_text(cell: object) -> str:
    if isinstance(cell, bytes):
        return cell.decode("utf-8", "replace")
    return str(cell)


def _exact_nanoseconds(cell: str, unit: int) -> int:
    if ":" in cell:
        return clock_nanoseconds(cell)
    time = Decimal(cell) * unit
    if not time.is_finite() or abs(time) > _LARGEST_TIME:
        raise ValueError(cell)
    return int(time.to_integral_value())


def name_column(column: str) -> str:
    """Name a column in a sentence; where a file names none, `column 2` is its name already."""
    return column if column.startswith("column ") else f"column {column}"
