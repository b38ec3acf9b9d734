"""How a text table is written: encoding, separator, decimal sign, comments, column names, a row of units."""

import re
import stat
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from motor_identification.logs.csv.cells import COMMENT, SPACES, is_number, split_line
from motor_identification.logs.csv.header import find_header, find_header_below
from motor_model.errors import RecordingError

LARGEST = 2**30  # [bytes] of a text table: 10 hours at 1 kHz; more does not fit an ordinary machine's memory as cells
LOOKED_AT = 100  # lines at the beginning, in which the rows of numbers have to begin
STRAY = 0.01  # of the lines: a board restarts now and then; more zero bytes are those of numbers
FEW_ROWS = 4  # fewer are a short table rather than a block of settings
DELIMITERS = (",", ";", "\t", "|", SPACES)
_NOTHING = " ,;\t|"  # all that is in a line without cells
_NO_VALUE = ("", "nan", "NaN", "NAN", "null", "None", "-")
_ZEROS = re.compile(rb"\0+")
_QUOTED_COMMA = re.compile(r'"([+-]?\d+,\d+)"')


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
    data = _without_stray_bytes(path, data)
    try:
        return data.decode("utf-8-sig"), ""
    except UnicodeDecodeError:
        # Spreadsheets on Windows: µ, ° and accents of column names; the numbers are the same in both.
        return data.decode("latin-1"), "Latin-1"


def _without_stray_bytes(path: Path, data: bytes) -> bytes:
    """Text without its zero bytes: those of a board that restarts, and of a card's block that was not filled."""
    data = data.rstrip(b"\0")
    if data.count(b"\0") == 0:
        return data
    if len(_ZEROS.findall(data)) > STRAY * data.count(b"\n"):
        raise RecordingError(f"{path} is not text: export it again as CSV in UTF-8.")
    return _ZEROS.sub(b"", data)


def find_dialect(lines: Sequence[str]) -> Dialect | None:
    """Find how a table is written; None where nothing looks like two rows of cells.

    The rows begin where the first of some lines in sequence have equally many cells, most of them numbers.
    """
    begin = [(index, line) for index, line in enumerate(lines[: 2 * LOOKED_AT]) if line.strip(_NOTHING)][:LOOKED_AT]
    best: tuple[int, int, str, bool] | None = None
    for delimiter in DELIMITERS:
        for comma in (False, True) if delimiter != "," or _quotes_commas(begin) else (False,):
            found = _first_row(begin, delimiter, comma)
            if found is not None and (best is None or found[0] > best[0]):
                best = (*found, delimiter, comma)
    if best is None:
        return None
    _, place, delimiter, comma = best
    rows = [split_line(line, delimiter) for _, line in begin[place:]]
    width, most = _width(rows), Counter(map(len, rows)).most_common(1)[0][0]
    header = find_header([line for _, line in begin[:place]], begin[place][1], delimiter, comma, width, most)
    header = header or find_header_below(rows, width, comma)
    names = header or tuple(f"column {k + 1}" for k in range(width))
    return Dialect(delimiter, comma, names, begin[place][0], named=bool(header))


def _quotes_commas(begin: Sequence[tuple[int, str]]) -> bool:
    """Whether cells between commas are numbers with a comma in quotes, of which not all can be marks of thousands."""
    cells = [cell for _, line in begin for cell in _QUOTED_COMMA.findall(line)]
    return any(not is_number(f"{cell}.", comma=False) for cell in cells)


def _first_row(begin: Sequence[tuple[int, str]], delimiter: str, comma: bool) -> tuple[int, int] | None:
    """How well this delimiter reads the lines, and where the rows begin."""
    rows = [split_line(line, delimiter) for _, line in begin]
    for k, row in enumerate(rows):
        following = rows[k : k + 5]
        numbers = sum(is_number(cell, comma) for cell in row)
        if numbers < 1 or len(row) < 2 or COMMENT.match(begin[k][1]):
            continue
        if len(following) > 1 and any(len(other) != len(row) for other in following[1:]) and not _ragged(following):
            continue
        if not _alike(following, comma) or _names_a_column(following, comma):
            continue
        rest = [cell for other in rows[k:] for cell in other]
        read = sum(is_number(cell, comma) for cell in rest)
        others = len(rest) - read - sum(cell in _NO_VALUE for cell in rest)
        return 2 * (read - others) + (not comma), k
    return None


def _alike(rows: Sequence[Sequence[str]], comma: bool) -> bool:
    """Whether columns that are numbers in the first row mostly are below: a block of settings is no row."""
    places = [k for k, cell in enumerate(rows[0]) if is_number(cell, comma)]
    below = [is_number(row[k], comma) for row in rows[1:] for k in places if k < len(row)]
    return 2 * sum(below) > len(below) or len(rows) < FEW_ROWS


def _names_a_column(rows: Sequence[Sequence[str]], comma: bool) -> bool:
    """Whether the first row begins with a word above numbers: names of columns, some of them numbers themselves."""
    word, below = rows[0][0], [row[0] for row in rows[1:]]
    if word in _NO_VALUE or word in below or is_number(word, comma):
        return False
    return 2 * sum(is_number(cell, comma) for cell in below) > len(below)


def _ragged(rows: Sequence[Sequence[str]]) -> bool:
    """Whether only the last of the rows is shorter, as in a file that was cut off."""
    return all(len(row) == len(rows[0]) for row in rows[:-1]) and len(rows[-1]) < len(rows[0]) and len(rows) < 5


def _width(rows: Sequence[Sequence[str]]) -> int:
    """How many cells most rows have, without those behind the last separator where nothing is."""
    widths = Counter(max((place for place, cell in enumerate(row, start=1) if cell), default=0) for row in rows)
    return max(widths, key=lambda width: (widths[width], width))
