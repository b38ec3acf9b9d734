"""The parts of a workbook's archive, and how much of them is read.

What an archive says of its sizes is not believed: a kilobyte may stand for gigabytes, a row for a thousand empty ones,
a text for ten million cells. So all is counted while it is read, and a part that declares entities is refused, as is
one in an encoding that could hide them.
"""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from xml.etree import ElementTree

from motor_model.errors import RecordingError

MOST_BYTES = 2**28  # unpacked, of a part with cells or their texts; characters of all lines
MOST_OF_SMALL = 2**24  # bytes of any other part, which is read as a whole
MOST_IN_ALL = 2**29  # bytes of all parts: sheets may be one and the same part
MOST_CELLS = 10_000_000
MOST_ROWS = 2**20  # as Excel's own sheets have at most
MOST_TEXTS = 2_000_000
MOST_ELEMENTS = 1_000_000  # that are kept at once: of one row, and of what stands beside the rows
_ENCODING = re.compile(rb"""\s*<\?xml[^>]*?encoding\s*=\s*["']([^"']*)""")


@dataclass
class Workbook:
    """An open workbook, and how much of it has been read."""

    path: Path
    archive: zipfile.ZipFile
    texts: list[str] = field(default_factory=list)
    dates: frozenset[int] = frozenset()  # styles
    unpacked: int = 0  # bytes
    rows: int = 0
    cells: int = 0
    characters: int = 0

    def __contains__(self, part: str) -> bool:
        return part in self.archive.namelist()

    def count_line(self, characters: int, cells: int) -> None:
        """Count a line, of all sheets together.

        Raises:
            RecordingError: there are more rows, cells or characters than are read.
        """
        self.rows += 1
        self.cells += cells
        self.characters += characters
        self.limit(self.rows, MOST_ROWS, f"{MOST_ROWS} rows")
        self.limit(self.cells, MOST_CELLS, f"{MOST_CELLS // 10**6} million cells")
        self.limit(self.characters, MOST_BYTES, f"{MOST_BYTES >> 20} MiB of text")

    def parse(self, part: str) -> ElementTree.Element:
        """Read a small part as a whole."""
        return ElementTree.fromstring(self._read(part, MOST_OF_SMALL))

    def elements(self, part: str, wanted: str) -> Iterator[ElementTree.Element]:
        """Read the elements of one name, one after the other; what was read before each is forgotten."""
        with BytesIO(self._read(part, MOST_BYTES)) as stream:
            above: list[tuple[ElementTree.Element, int]] = []  # with how many elements were kept before each
            kept = 0
            for event, element in ElementTree.iterparse(stream, events=("start", "end")):
                if event == "start":
                    kept += 1
                    self.limit(kept, MOST_ELEMENTS, f"{MOST_ELEMENTS} elements in a row of {part}, or beside its rows")
                    above.append((element, kept))
                    continue
                above.pop()
                if name_of(element) == wanted and above:
                    yield element
                    parent, kept = above[-1]
                    parent.clear()

    def limit(self, number: int, most: int, what: str) -> None:
        """Refuse a workbook of which there is more than is read."""
        if number > most:
            raise RecordingError(f"{self.path} has more than {what}: save the sheet with the table as CSV.")

    def _read(self, part: str, most: int) -> bytes:
        if self.archive.getinfo(part).compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise RecordingError(f"{self.path} is packed in a way that workbooks are not: save its sheet as CSV.")
        with self.archive.open(part) as stream:
            data = stream.read(most + 1)
        self.unpacked += len(data)
        self.limit(len(data), most, f"{most >> 20} MiB in {part}")
        self.limit(self.unpacked, MOST_IN_ALL, f"{MOST_IN_ALL >> 20} MiB in all its parts")
        encoding = _ENCODING.match(data)
        if b"\0" in data[:4] or (encoding and encoding[1].lower() != b"utf-8"):
            raise RecordingError(f"{self.path} is not in UTF-8, as workbooks are: save its sheet as CSV.")
        if b"<!DOCTYPE" in data or b"<!ENTITY" in data:
            raise RecordingError(f"{self.path} declares entities, as no workbook does: save its sheet as CSV.")
        return data


def name_of(element: ElementTree.Element) -> str:
    """The name of an element without its namespace."""
    return element.tag.rpartition("}")[2]
