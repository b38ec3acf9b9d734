"""A log file of any format as a table: what it is, is found from its content."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

from motor_identification.bag.storage import OF_ROS_1, ROS_1
from motor_identification.logs.columns.said import Said
from motor_identification.logs.csv.dialect import check_file
from motor_identification.logs.csv.reader import read_table, table_of
from motor_identification.logs.csv.table import Table
from motor_identification.logs.formats.json_lines import are_json_lines, read_json_lines
from motor_identification.logs.formats.json_table import RUN, is_document, may_be_document, read_json_table
from motor_identification.logs.formats.lvm import LETTERS as LABVIEW
from motor_identification.logs.formats.lvm import read_lvm
from motor_identification.logs.formats.mat_version_4 import is_version_4
from motor_identification.logs.formats.matlab import read_matlab
from motor_identification.logs.formats.numpy_arrays import MARK as NUMPY
from motor_identification.logs.formats.octave_text import MARK as OCTAVE
from motor_identification.logs.formats.sysid import is_sysid, read_sysid
from motor_identification.logs.formats.workbook import is_workbook, read_workbook
from motor_identification.logs.formats.wpilog import LETTERS, read_wpilog
from motor_model.errors import RecordingError

HEAD = 512  # bytes at the beginning that tell the format
_LONGEST_LINE = 10_000  # characters of a first line of JSON
_OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
_WORKBOOK = (b"[Content_Types].xml", b"xl/", b"opendocument.spreadsheet")  # Excel's, and that of LibreOffice
_HDF5, _ZIP, _PARQUET, _MCAP = b"\x89HDF\r\n\x1a\n", b"PK\x03\x04", b"PAR1", b"\x89MCAP"


@dataclass(frozen=True)
class Source:
    """A table, the format it came in, and what that says of it: as if a user had said so."""

    table: Table
    format: str
    said: Said = field(default_factory=Said)

    def with_said(self, said: Said) -> Said:
        """What the user said, and where he did not, what the file says."""
        unsaid = {name: value for name, value in self.said.__dict__.items() if getattr(said, name) in (None, ())}
        if said.motion or said.voltage or said.constant_voltage is not None:
            unsaid.pop("motors", None)  # a user who names a column means no other
        return replace(said, **unsaid)


def read_source(path: Path, said: Said | None = None) -> Source:
    """Read a log file; of a workbook, the sheet that is said, or the one with the most numbers.

    Raises:
        RecordingError: it cannot be read, or is of a format that is not known.
    """
    check_file(path)
    said = said or Said()
    try:
        with path.open("rb") as file:
            head = file.read(HEAD)
    except OSError as error:
        raise RecordingError(f"{path} cannot be read ({error.strerror}): give a log file.") from error
    if head.startswith(_ZIP) and is_workbook(path):
        lines, note = read_workbook(path, said.sheet)
        return Source(table_of(path, lines, [note]), "workbook")
    if said.sheet is not None:
        raise RecordingError(f"{path} has no sheets: leave out --sheet.")
    return _read_other(path, head, said)


def _read_other(path: Path, head: bytes, said: Said) -> Source:
    """Read a file of one table, whose first bytes tell its format."""
    for is_format, cure in _REFUSED:
        if is_format(head):
            raise RecordingError(f"{path} is {cure}.")
    for is_format, name in _OF_VARIABLES:
        if is_format(head):
            fewest = 2 if said.constant_voltage is None else 1  # the motion alone
            return Source(read_matlab(path, said.columns(), fewest), name)
    if head.startswith(LABVIEW):
        return Source(read_lvm(path), "file of LabVIEW (LVM)")
    if head.startswith(LETTERS):
        log = read_wpilog(path)
        return Source(log.table, "WPILOG", Said(split=log.split, motors=log.motors))
    if may_be_document(head) and (b"{" in head or is_document(path)):
        return _read_json(path)
    return Source(read_table(path), "text table")


def _read_json(path: Path) -> Source:
    """Read a file of JSON: of a line for each sample, SysId's, or a table somewhere in it."""
    with path.open(encoding="utf-8-sig", errors="replace") as file:
        if are_json_lines(file.read(_LONGEST_LINE)):
            return Source(read_json_lines(path), "JSON file of a line for each sample")
    if is_sysid(path.read_text(encoding="utf-8-sig", errors="replace")):
        table, units_per_revolution = read_sysid(path)
        return Source(table, "SysId JSON", Said(split="test", units_per_revolution=units_per_revolution))
    table = read_json_table(path)
    return Source(table, "JSON file", Said(split=RUN if RUN in table.names else None))


_OF_VARIABLES: tuple[tuple[Callable[[bytes], bool], str], ...] = (
    (lambda head: head.startswith(b"MATLAB 5.0"), "MATLAB 5 file"),
    (lambda head: head.startswith(b"MATLAB 7.3"), "MATLAB 7.3 file"),
    (lambda head: head.startswith(OCTAVE), "text file of Octave"),
    (lambda head: head.startswith(NUMPY) or (head.startswith(_ZIP) and b".npy" in head), "NumPy file"),
    (is_version_4, "MATLAB 4 file"),
)
_REFUSED: tuple[tuple[Callable[[bytes], bool], str], ...] = (
    (lambda head: head.startswith(_HDF5), "an HDF5 file: save its arrays as CSV"),
    (
        lambda head: head.startswith(_ZIP) and any(one in head for one in _WORKBOOK),
        "a spreadsheet: save its sheet as CSV (comma separated values), and give that",
    ),
    (lambda head: head.startswith(_OLE), "an old Excel file: save its sheet as CSV, and give that"),
    (
        lambda head: head.startswith(_ZIP) and b".npy" not in head,
        "a ZIP or spreadsheet file: unpack it, or export it as CSV",
    ),
    (lambda head: head.startswith(ROS_1), OF_ROS_1),
    (lambda head: head.startswith(b"TDSm"), "a TDMS file of LabVIEW: export it as CSV"),
    (
        lambda head: head.startswith((_PARQUET, b"ARROW1")),
        "a Parquet or Feather file: export it as CSV",
    ),
    (lambda head: head.startswith(_MCAP), "a bag: give it to identify, diagnose or inspect"),
    (lambda head: head.startswith(b"SQLite format 3"), "a bag: give it to identify, diagnose or inspect"),
)
