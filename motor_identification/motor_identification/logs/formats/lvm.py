"""Measurement files of LabVIEW (.lvm) as a table: an X for all channels, one for each, or none; segments."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from motor_identification.logs.csv.cells import is_number
from motor_identification.logs.csv.dialect import read_text
from motor_identification.logs.csv.reader import table_of
from motor_identification.logs.csv.table import Table
from motor_model.errors import RecordingError

LETTERS = b"LabVIEW Measurement"  # at the beginning
_END, _X, _COMMENT = "***End_of_Header***", "X_Value", "Comment"
_DELIMITERS = {"tab": "\t", "comma": ","}


@dataclass(frozen=True)
class _Part:
    """A segment's header: which cells are read as what, and when its rows were where they do not say so."""

    names: tuple[str, ...]
    places: tuple[int, ...]  # of them in a row
    first: float  # [s]
    period: float  # [s]; 0 where rows have their times
    single: bool  # rows have their times once


def read_lvm(path: Path) -> Table:
    """The channels of an .lvm file, with `time`; segments follow each other.

    Raises:
        RecordingError: there is no header's end, no row, or no period where rows have no times.
    """
    text, encoding = read_text(path)
    lines = text.splitlines()
    settings = _settings(lines, "\t" if "\t" in text else ",")
    delimiter = _DELIMITERS.get(settings.get("Separator", "Tab").lower(), "\t")
    comma = settings.get("Decimal_Separator", ".") == ","
    ends = [place for place, line in enumerate(lines) if line.startswith(_END)]
    if not ends:
        raise RecordingError(f"{path} is a damaged LVM file of LabVIEW (its header has no end): export it again.")
    table = [""] * len(lines)  # rows stay where they are, so that complaints name their lines
    begins = [*(ends[1:] or ends), len(lines)]
    named = False
    for end, following in zip(begins[:-1], begins[1:], strict=True):
        part = _part(path, lines[:end], _cells(lines, end + 1, delimiter), settings, delimiter)
        if not named:
            table[end + 1], named = "\t".join(part.names), True
        count = 0
        for place in range(end + 2, following):
            cells = lines[place].split(delimiter)
            if cells[0].strip() and not is_number(cells[0].strip(), comma):  # a setting of the next header
                continue
            if not is_number(cells[part.places[0]].strip() if len(cells) > part.places[0] else "", comma):
                continue
            table[place] = _row(cells, part, count, comma)
            count += 1
    notes = [f"The file is read as {encoding}, as it is not UTF-8."] if encoding else []
    return table_of(path, table, notes)


def _cells(lines: Sequence[str], place: int, delimiter: str) -> list[str]:
    return [cell.strip() for cell in lines[place].split(delimiter)] if place < len(lines) else []


def _settings(lines: Sequence[str], delimiter: str) -> Mapping[str, str]:
    """What the file's own header says, up to its end."""
    found: dict[str, str] = {}
    for line in lines:
        if line.startswith(_END):
            break
        name, _, value = line.partition(delimiter)
        found[name.strip()] = value.strip()
    return found


def _part(
    path: Path, before: Sequence[str], header: Sequence[str], settings: Mapping[str, str], delimiter: str
) -> _Part:
    """Read a segment's header, which ends before its line of names."""
    about: dict[str, list[str]] = {}
    for line in before[::-1]:
        name, *values = (cell.strip() for cell in line.split(delimiter))
        if name.startswith(_END):
            break
        about.setdefault(name, values)
    units = about.get("Y_Unit_Label", [])
    channels = [place for place, name in enumerate(header) if name and name not in (_X, _COMMENT)]
    names = [
        f"{header[place]} [{units[k]}]" if k < len(units) and units[k] else header[place]
        for k, place in enumerate(channels)
    ]
    with_x = settings.get("X_Columns", "One").lower() != "no"
    if not channels or not (with_x or about.get("Delta_X")):
        raise RecordingError(f"{path} is an LVM file of LabVIEW without channels, or without times: export it again.")
    first, period = (_number(about.get(name, [])) for name in ("X0", "Delta_X"))
    places = ((header.index(_X) if _X in header else 0), *channels) if with_x else tuple(channels)
    return _Part(("time [s]", *names), tuple(places), first, 0.0 if with_x else period, with_x)


def _number(cells: Sequence[str]) -> float:
    try:
        return float(cells[0].replace(",", "."))
    except (IndexError, ValueError):
        return 0.0


def _row(cells: Sequence[str], part: _Part, count: int, comma: bool) -> str:
    """One row, with a decimal point, and with its time where it has none."""
    values = [cells[place].strip() if place < len(cells) else "" for place in part.places]
    if comma:
        values = [value.replace(",", ".") for value in values]
    return "\t".join(values if part.single else (f"{part.first + count * part.period:.9g}", *values))
