"""What one cell says: a number with a decimal point or comma, or the time of a clock, as many programs write them."""

import csv
import re
from datetime import datetime, timezone

SPACES = " "  # stands for any run of blanks
COMMENT = re.compile(r"^\s*(#|%|//)\s*")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$")
_THOUSANDS = {  # 1.234,5 and 1,234.5: only with both signs it is sure which of them is the decimal one
    True: re.compile(r"[+-]?\d{1,3}(\.\d{3})+,\d*$"),
    False: re.compile(r"[+-]?\d{1,3}(,\d{3})+\.\d*$"),
}
_MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
_CLOCK = re.compile(
    r"((?P<date>\d{1,4}[-/.](\d{1,2}|[A-Za-z]{3})[-/.]\d{1,4})[T ,] {0,3}|(?P<days>\d{1,5}) days? )?"
    r"(?P<hour>\d{1,2}):(?P<minute>\d\d):(?P<second>\d\d)([.,:](?P<fraction>\d{1,9}))?"
    r" {0,3}(?P<half>[AaPp])?(?(half)[Mm]) {0,3}(?P<zone>Z|UTC|[+-]\d\d:?\d\d)?$"
)


_MINUTES = re.compile(r"\d{1,3}:[0-5]\d[.,]\d{1,9}$")  # and seconds: a spreadsheet shows times of day so


def is_number(cell: str, comma: bool) -> bool:
    """Whether a cell is a number or a clock's time, with a decimal comma or without."""
    return bool(_NUMBER.match(with_point(cell, comma)) or _CLOCK.match(cell) or _MINUTES.match(cell))


def with_point(cell: str, comma: bool) -> str:
    """A number with a decimal point and without marks of thousands; other texts as they are."""
    if _THOUSANDS[comma].match(cell):
        cell = cell.replace("." if comma else ",", "")
    return cell.replace(",", ".", 1) if comma else cell


def clock_nanoseconds(cell: str) -> int:
    """[ns] of 12:34:56.789, 34:56.789, 1 days 12:34:56 since midnight; of 2026-05-01T12:34:56.789+02:00 since 1970.

    Dates are year-month-day, day.month.year, or month/day/year where that is a date, as their writers mostly mean.

    Raises:
        ValueError: it is no time.
    """
    if _MINUTES.match(cell):
        minutes, _, rest = cell.partition(":")
        cell = f"{int(minutes) // 60}:{int(minutes) % 60:02d}:{rest}"
    found = _CLOCK.match(cell)
    if found is None:
        raise ValueError(cell)
    year, month, day = _date(found["date"]) if found["date"] else (1970, 1, 1)
    hour = int(found["hour"])
    if found["half"]:
        hour = hour % 12 + (12 if found["half"] in "Pp" else 0)
    whole = datetime(year, month, day, hour, int(found["minute"]), int(found["second"]), tzinfo=timezone.utc)
    seconds = round(whole.timestamp()) - _offset(found["zone"] or "Z") + 86_400 * int(found["days"] or 0)
    return seconds * 10**9 + int(((found["fraction"] or "") + "000000000")[:9])


def _date(text: str) -> tuple[int, int, int]:
    parts = re.split(r"[-/.]", text)
    if not parts[1].isdigit():  # 01-May-2024
        parts[1] = str(_MONTHS.index(parts[1].lower()) + 1)
        text = text.replace("/", "-")
    first, second, third = (int(part) for part in parts)
    if first > 31:
        return first, second, third
    year = third if third > 99 else 2000 + third
    if "/" in text and first <= 12:
        return year, first, second
    return year, second, first


def _offset(zone: str) -> int:
    """[s] that a zone's clocks are before those of Greenwich."""
    if zone in ("Z", "UTC"):
        return 0
    digits = zone[1:].replace(":", "")
    return (-1 if zone[0] == "-" else 1) * (3600 * int(digits[:2]) + 60 * int(digits[2:]))


def split_line(line: str, delimiter: str) -> list[str]:
    """The cells of one line, without surrounding blanks."""
    if delimiter == SPACES:
        return line.split()
    try:
        cells = next(csv.reader([line], delimiter=delimiter, skipinitialspace=True), [])
    except csv.Error:  # longer than any cell may be, as all of a matrix on one line
        cells = [line]
    return [cell.strip() for cell in cells]
