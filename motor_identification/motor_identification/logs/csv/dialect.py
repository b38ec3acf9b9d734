"""How a text table is written: encoding, separator, decimal sign, comments, column names, a row of units."""

import csv
import re
import stat
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from motor_model.errors import RecordingError

LARGEST = 2**30  # [bytes] of a text table: 10 hours at 1 kHz; more does not fit an ordinary machine's memory as cells
LOOKED_AT = 100  # lines at the beginning, in which the rows of numbers have to begin
SPACES = " "  # stands for any run of blanks
DELIMITERS = (",", ";", "\t", "|", SPACES)
_COMMENT = re.compile(r"^\s*(#|%|//)\s*")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$")
_CLOCK = re.compile(r"(\d{4}-\d\d-\d\d[T ])?\d\d:\d\d:\d\d(\.\d+)?Z?$")
_NO_VALUE = ("", "nan", "NaN", "NAN", "null", "None", "-")
_UNIT_ROW = re.compile(r"[\[(]?[A-Za-zµμ°%/²\d.^_-]{1,10}[\])]?$")


@dataclass(frozen=True)
class Dialect:
    """Where the rows of a table begin, and how to read them."""

    delimiter: str
    decimal_comma: bool
    header: tuple[str, ...]  # column names; "column 1", … where the file has none
    first_row: int  # index of the line with the first row of numbers
    named: bool = True


def read_text(path: Path) -> tuple[str, str]:
    """The text of a file without a byte order mark, and the name of an encoding other than UTF-8.

    Raises:
        RecordingError: there is no such regular file, it is too large, or cannot be read as text.
    """
    check_file(path)
    try:
        data = path.read_bytes()
    except OSError as error:
        raise RecordingError(f"{path} cannot be read ({error.strerror}): give a log file.") from error
    return _decoded(path, data)


def check_file(path: Path) -> None:
    """Refuse what is no regular file, or too large a one.

    Raises:
        RecordingError: it is.
    """
    try:
        about = path.stat()
    except FileNotFoundError as error:
        raise RecordingError(f"There is no file {path}: check the path.") from error
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise RecordingError(f"{path} cannot be read ({reason}): give a log file.") from error
    if not stat.S_ISREG(about.st_mode):
        raise RecordingError(f"{path} is not a regular file: give a log file.")
    if about.st_size > LARGEST:
        raise RecordingError(
            f"{path} has {about.st_size / 2**20:.0f} MiB, and {LARGEST // 2**20} MiB is the most: cut it into parts."
        )


def _decoded(path: Path, data: bytes) -> tuple[str, str]:
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        try:
            return data.decode("utf-16"), "UTF-16"
        except UnicodeDecodeError as error:
            raise RecordingError(f"{path} is not valid UTF-16 text: export it again as CSV in UTF-8.") from error
    if b"\0" in data:
        raise RecordingError(f"{path} is not text: export it again as CSV in UTF-8.")
    try:
        return data.decode("utf-8-sig"), ""
    except UnicodeDecodeError:
        # Spreadsheets on Windows: µ, ° and accents of column names; the numbers are the same in both.
        return data.decode("latin-1"), "Latin-1"


def find_dialect(lines: Sequence[str]) -> Dialect | None:
    """Find how a table is written; None where nothing looks like two rows of cells.

    The rows begin where the first of some lines in sequence have equally many cells, most of them numbers.
    """
    begin = [(index, line) for index, line in enumerate(lines[: 2 * LOOKED_AT]) if line.strip()][:LOOKED_AT]
    best: tuple[int, int, str, bool] | None = None
    for delimiter in DELIMITERS:
        for comma in (False, True) if delimiter != "," else (False,):
            found = _first_row(begin, delimiter, comma)
            if found is not None and (best is None or found[0] > best[0]):
                best = (*found, delimiter, comma)
    if best is None:
        return None
    _, place, delimiter, comma = best
    width = len(split_line(begin[place][1], delimiter))
    header = _header([line for _, line in begin[:place]], delimiter, comma, width)
    names = header or tuple(f"column {k + 1}" for k in range(width))
    return Dialect(delimiter, comma, names, begin[place][0], named=bool(header))


def _first_row(begin: Sequence[tuple[int, str]], delimiter: str, comma: bool) -> tuple[int, int] | None:
    """How well this delimiter reads the lines, and where the rows begin."""
    rows = [split_line(line, delimiter) for _, line in begin]
    for k, row in enumerate(rows):
        following = rows[k : k + 5]
        numbers = sum(is_number(cell, comma) for cell in row)
        if numbers < 1 or len(row) < 2 or _COMMENT.match(begin[k][1]):
            continue
        if len(following) > 1 and any(len(other) != len(row) for other in following[1:]) and not _ragged(following):
            continue
        rest = [cell for other in rows[k:] for cell in other]
        read = sum(is_number(cell, comma) for cell in rest)
        others = len(rest) - read - sum(cell in _NO_VALUE for cell in rest)
        return 2 * (read - others) + (not comma), k
    return None


def _ragged(rows: Sequence[Sequence[str]]) -> bool:
    """Whether only the last of the rows is shorter, as in a file that was cut off."""
    return all(len(row) == len(rows[0]) for row in rows[:-1]) and len(rows[-1]) < len(rows[0]) and len(rows) < 5


def _header(before: Sequence[str], delimiter: str, comma: bool, width: int) -> tuple[str, ...]:
    """Names of columns out of the lines before the first row: the last that has as many cells."""
    cells = [split_line(_COMMENT.sub("", line), delimiter) for line in before]
    fitting = [row for row in cells if len(row) == width and any(row) and not any(is_number(one, comma) for one in row)]
    if not fitting:
        return ()
    names = fitting[-1]
    if len(fitting) > 1 and all(_UNIT_ROW.match(cell) for cell in names) and cells[-1] == names:
        above = fitting[-2]
        if cells[-2] == above and any("[" in cell or "/" in cell or cell in ("s", "ms", "V") for cell in names):
            names = [f"{name} [{unit.strip('[]()')}]" for name, unit in zip(above, names, strict=True)]
    return tuple(names)


def split_line(line: str, delimiter: str) -> list[str]:
    """The cells of one line, without surrounding blanks."""
    if delimiter == SPACES:
        return line.split()
    return [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter, skipinitialspace=True), [])]


def is_number(cell: str, comma: bool) -> bool:
    """Whether a cell is a number or a time of day, with a decimal comma or without."""
    text = cell.replace(",", ".", 1) if comma else cell
    return bool(_NUMBER.match(text) or _CLOCK.match(cell))
