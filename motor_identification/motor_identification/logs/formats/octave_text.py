"""Read the matrices of a text file of Octave: `# name: u`, its size, and the numbers, a line for each row."""

import re
from typing import Any

import numpy as np

from motor_identification.logs.formats.mat_elements import BrokenFileError, Value

MARK = b"# Created by Octave"
_FIELD = re.compile(r"# (name|type|rows|columns): (.*)$")
_NUMBERS = ("matrix", "scalar", "range")
MOST_VARIABLES = 1000


def read_octave_text(data: bytes) -> dict[str, Value]:
    """Read real matrices of shape (rows, columns) by name; texts, cells, structs and complex numbers are left out.

    Raises:
        BrokenFileError: a row has other numbers than its matrix says, or there are more than 1,000 variables.
    """
    found: dict[str, Value] = {}
    about: dict[str, str] = {}
    rows: list[str] = []
    for line in [*data.decode("utf-8", "replace").splitlines(), "# name: "]:
        match = _FIELD.match(line)
        if match and match[1] == "name":
            if about.get("type") in _NUMBERS and rows:
                found[about["name"]] = _matrix(about, rows)
            about, rows = {}, []
            if len(found) > MOST_VARIABLES:
                raise BrokenFileError(f"it has more than {MOST_VARIABLES} variables")
        if match:
            about[match[1]] = match[2].strip()
        elif line.strip() and not line.startswith("#"):
            rows.append(line)
    return found


def _matrix(about: dict[str, str], rows: list[str]) -> Any:
    try:
        values = [np.array(row.split(), np.float64) for row in rows]
    except ValueError as error:
        raise BrokenFileError(f"{about['name']} has a cell that is no number") from error
    if len({len(row) for row in values}) != 1:
        raise BrokenFileError(f"the rows of {about['name']} have different lengths")
    return np.stack(values)
