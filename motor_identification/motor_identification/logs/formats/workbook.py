"""A workbook of Excel (.xlsx) as the lines of a text table: the sheet with the most numbers, or the one that is named.

The format is "Office Open XML": a ZIP archive of XML. Only what a table needs is read: the names of the sheets, the
texts that cells share, which styles show dates, and the cells' values, not their formulas. What the archive says of its
sizes is not believed: `workbook_parts` counts what is read.
"""

from __future__ import annotations

import re
import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime, timedelta
from io import BytesIO
from itertools import groupby
from pathlib import Path
from xml.etree import ElementTree

from motor_identification.logs.csv.cells import is_number
from motor_identification.logs.formats.workbook_parts import MOST_TEXTS, Workbook, name_of
from motor_model.errors import RecordingError

MOST_COLUMNS, MOST_SHEETS = 256, 100
SEPARATOR = "\t"
_DAMAGES = (
    zipfile.BadZipFile,
    zlib.error,
    ElementTree.ParseError,
    LookupError,
    ValueError,
    OSError,
    NotImplementedError,
)
_FIRST_DAY = datetime(1899, 12, 30)  # of Excel's days, as it counts 29 February 1900
_DATES = frozenset([*range(14, 23), *range(45, 48)])  # formats that every workbook has
_CLOCK = re.compile(r"(?i)[yd]|h|m+:|:m|s")  # in a format of its own: it shows a date or a time of day
_QUOTED = re.compile(r'"[^"]*"|\\.|\[[^\]]*\]')  # not part of what a format shows
_PLACE = re.compile(r"([A-Z]{1,3})\d+$")


@dataclass(frozen=True)
class Sheet:
    """A sheet's lines, with a tab between cells."""

    name: str
    lines: list[str]
    tables: int = 1  # that stand side by side on it, and are read one below the other

    @property
    def numbers(self) -> int:
        """How many of its cells are numbers."""
        return sum(is_number(cell, comma=False) for line in self.lines for cell in line.split(SEPARATOR))


def is_workbook(path: Path) -> bool:
    """Whether a ZIP archive is a workbook of Excel."""
    try:
        with zipfile.ZipFile(path) as archive:
            return "xl/workbook.xml" in archive.namelist()
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError):
        return False


def read_workbook(path: Path, wanted: str | None) -> tuple[list[str], str]:
    """Read the lines of one sheet, and what has to be said of which it is.

    Args:
        path: the file.
        wanted: the sheet's name; None: the one with the most numbers.

    Raises:
        RecordingError: it is damaged, too large, or has no such sheet.
    """
    try:
        with zipfile.ZipFile(BytesIO(path.read_bytes())) as archive:
            sheets = list(_read_sheets(Workbook(path, archive), wanted))
    except _DAMAGES as error:
        raise RecordingError(f"{path} is a damaged workbook: save it again, or its sheet as CSV.") from error
    except (EOFError, RuntimeError, MemoryError) as error:  # cut off, encrypted, or too large
        raise RecordingError(f"{path} cannot be read as a workbook: save its sheet as CSV.") from error
    if not sheets:
        raise RecordingError(f"{path} has no sheet with cells: give a workbook with a table.")
    best = max(sheets, key=lambda sheet: sheet.numbers)
    others = [sheet.name for sheet in sheets if sheet is not best and sheet.numbers]
    more = f" (others: {', '.join(others[:8])}; otherwise: --sheet)" if others else ""
    names = _sheet_of_names(best, sheets)
    of_columns = f", whose columns are named on {names.name}" if names else ""
    beside = f" {best.tables} tables of the same columns stand side by side: read one below the other." * (
        best.tables > 1
    )
    return [*(names.lines if names else ()), *best.lines], f"Sheet: {best.name}{more}{of_columns}.{beside}"


def _sheet_of_names(table: Sheet, sheets: list[Sheet]) -> Sheet | None:
    """Find the only sheet that is one line of words, one for each column of a table without names; None without one."""
    first = table.lines[0].split(SEPARATOR)
    if len(first) < 2 or not all(is_number(cell, comma=False) for cell in first):
        return None
    named = [one for one in sheets if len(one.lines) == 1 and not one.numbers]
    named = [one for one in named if len([cell for cell in one.lines[0].split(SEPARATOR) if cell]) == len(first)]
    return named[0] if len(named) == 1 else None


def _read_sheets(book: Workbook, wanted: str | None) -> Iterator[Sheet]:
    """Read the sheets with cells, or the one that is wanted."""
    parts = _sheet_parts(book)
    if wanted is not None and wanted not in parts:
        raise RecordingError(f"{book.path} has no sheet {wanted}: name one of {', '.join(list(parts)[:20])}.")
    book.texts = _shared_texts(book)
    book.dates = _date_styles(book)
    for name, part in list(parts.items())[:MOST_SHEETS]:
        if wanted in (None, name):
            lines, tables = _largest_block(_lines(book, part))
            if any(line.strip() for line in lines):
                yield Sheet(name, lines, tables)


def _sheet_parts(book: Workbook) -> dict[str, str]:
    """Name the part of the archive that holds each sheet."""
    targets = {}
    for one in book.parse("xl/_rels/workbook.xml.rels"):
        target = one.get("Target", "")
        targets[one.get("Id", "")] = target.lstrip("/") if target.startswith("/") else f"xl/{target}"
    found = {}
    for one in book.parse("xl/workbook.xml").iter():
        if name_of(one) == "sheet":
            relation = next((value for key, value in one.attrib.items() if key.endswith("}id")), "")
            if targets.get(relation, "") in book:
                found[one.get("name", "")] = targets[relation]
    return found


def _shared_texts(book: Workbook) -> list[str]:
    if "xl/sharedStrings.xml" not in book:
        return []
    texts: list[str] = []
    for one in book.elements("xl/sharedStrings.xml", "si"):
        texts.append(_text(one))
        book.limit(len(texts), MOST_TEXTS, f"{MOST_TEXTS // 10**6} million texts")
    return texts


def _date_styles(book: Workbook) -> frozenset[int]:
    """Find the styles that show numbers as dates or times of day."""
    if "xl/styles.xml" not in book:
        return frozenset()
    own: dict[int, str] = {}
    styles: list[int] = []
    for one in book.parse("xl/styles.xml"):
        if name_of(one) == "numFmts":
            own = {int(form.get("numFmtId", "0")): form.get("formatCode", "") for form in one}
        elif name_of(one) == "cellXfs":
            styles = [int(form.get("numFmtId", "0")) for form in one]
    shown = {number for number, code in own.items() if _CLOCK.search(_QUOTED.sub("", code))}
    return frozenset(k for k, number in enumerate(styles) if number in (shown if number in own else _DATES))


def _lines(book: Workbook, part: str) -> list[str]:
    """Read a sheet's rows as lines; rows that it leaves out are empty."""
    lines: list[str] = []
    for row in book.elements(part, "row"):
        place = int(row.get("r", str(len(lines) + 1)))
        for _ in range(min(place - 1 - len(lines), 1000)):
            lines.append("")
            book.count_line(0, 0)
        lines.append(_line(book, row))
    return lines


def _largest_block(lines: list[str]) -> tuple[list[str], int]:
    """Cut the block of columns with the most numbers out of a sheet, on which notes and sums stand beside the table.

    Blocks with the same names follow below it, such as one for each voltage: how many there are is told.
    """
    rows = [line.split(SEPARATOR) for line in lines]
    numbers = [0] * max(map(len, rows), default=0)
    filled = [False] * len(numbers)
    for row in rows:
        for k, cell in enumerate(row):
            filled[k] = filled[k] or bool(cell)
            numbers[k] += bool(cell) and is_number(cell, comma=False)
    if all(filled):
        return lines, 1
    columns = [list(block) for there, block in groupby(range(len(filled)), key=filled.__getitem__) if there]
    best = max(columns, key=lambda block: sum(numbers[k] for k in block), default=[0])
    blocks = [[row[block[0] : block[-1] + 1] for row in rows] for block in columns]
    table = blocks[columns.index(best)] if columns else rows
    names = next((row for row in table if len(row) > 1 and all(row)), [""])
    if is_number(names[0], comma=False) or not names[0]:
        return [SEPARATOR.join(row) for row in table], 1
    alike = [block[block.index(names) + 1 :] for block in blocks if names in block]
    if len(alike) == 1:
        return [SEPARATOR.join(row) for row in table], 1
    return [SEPARATOR.join(row) for row in (names, *(row for block in alike for row in block if any(row)))], len(alike)


def _line(book: Workbook, row: ElementTree.Element) -> str:
    cells: list[str] = []
    for cell in row:
        column = _column(cell.get("r", ""), len(cells))
        if column < MOST_COLUMNS:
            cells += [""] * (column - len(cells))
            cells.append(_value(book, cell))
    line = SEPARATOR.join(cells)
    book.count_line(len(line), max(len(cells), len(row)))
    return line


def _column(place: str, following: int) -> int:
    """The place of a cell from 0, by its name such as `AB12`."""
    match = _PLACE.match(place)
    if match is None:
        return following
    number = 0
    for letter in match[1]:
        number = 26 * number + ord(letter) - ord("A") + 1
    return max(number - 1, following)


def _value(book: Workbook, cell: ElementTree.Element) -> str:
    kind = cell.get("t", "n")
    if kind == "inlineStr":
        text = _text(cell)
    else:
        text = next((one.text or "" for one in cell if name_of(one) == "v"), "")
        if kind == "s" and text:
            text = _text_of(book, int(text))
        elif kind == "e":
            text = ""
        elif kind == "n" and text and int(cell.get("s", "0")) in book.dates:
            text = _as_time(float(text))
        elif kind == "n" and text:
            text = f"{float(text):.15g}"  # as it is shown; 17 digits are stored
    return " ".join(text.split())


def _text_of(book: Workbook, place: int) -> str:
    if not 0 <= place < len(book.texts):
        raise ValueError(place)
    return book.texts[place]


def _as_time(days: float) -> str:
    """A number of Excel's days as a date and a time; below one as a time of day."""
    if not 0.0 <= days < 2_900_000.0:
        return str(days)
    time = _FIRST_DAY + timedelta(microseconds=round(days * 86_400e6))
    return time.strftime("%H:%M:%S.%f" if days < 1.0 else "%Y-%m-%dT%H:%M:%S.%f")


def _text(element: ElementTree.Element) -> str:
    """The text of an element, however it is set; without how it is pronounced."""
    inner = [one for one in element.iter() if name_of(one) == "t"]
    spoken = {id(one) for ruby in element.iter() if name_of(ruby) == "rPh" for one in ruby}
    return "".join(one.text or "" for one in inner if id(one) not in spoken)
