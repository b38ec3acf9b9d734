"""Matrices in a text file of Octave."""

import numpy as np
import pytest

from motor_identification.logs.formats.mat_elements import BrokenFileError
from motor_identification.logs.formats.octave_text import MARK, read_octave_text

HEAD = MARK.decode() + " 6.4.0, Thu Feb 26 14:00:50 2026 UTC <u@h>\n"
WORDS = "# name: what\n# type: string\n# elements: 1\n# length: 5\nbench\n\n\n"
SCALAR = "# name: Ts\n# type: scalar\n0.02\n\n\n"


def matrix(name: str, rows: list[str]) -> str:
    lines = "".join(f" {row}\n" for row in rows)
    return f"# name: {name}\n# type: matrix\n# rows: {len(rows)}\n# columns: 1\n{lines}\n\n"


def test_columns_rows_and_scalars() -> None:
    found = read_octave_text((HEAD + matrix("t", ["0", "0.5"]) + WORDS + matrix("u", ["1 2 -3e-1"]) + SCALAR).encode())
    assert list(found) == ["t", "u", "Ts"]
    assert np.array_equal(found["t"], [[0.0], [0.5]]) and np.array_equal(found["u"], [[1.0, 2.0, -0.3]])


@pytest.mark.parametrize("rows", [["1 2", "3"], ["1", "x"]])
def test_a_damaged_matrix_is_told(rows: list[str]) -> None:
    with pytest.raises(BrokenFileError, match="u"):
        read_octave_text((HEAD + matrix("u", rows)).encode())
