"""Rows that stand in quotes as a whole."""

from pathlib import Path

import numpy as np

from motor_identification.logs.csv.quotes import unquote_rows
from motor_identification.logs.csv.reader import read_table


def test_rows_in_quotes(tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    path.write_text("duty, time, speed\n" + "".join(f'"{k % 3}, {0.01 * k:.2f}, {k}"\n' for k in range(20)))
    table = read_table(path)
    assert table.names == ["duty", "time", "speed"]
    np.testing.assert_allclose(table.numbers("time"), 0.01 * np.arange(20))


def test_cells_in_quotes_stay() -> None:
    for line in ('"1","2"', '"1,5";"2,5"', "1,2", '"1"', '"1,5",2'):
        assert unquote_rows([line] * 9) == [line] * 9
    assert unquote_rows(['"1,2"'] * 7 + ["3,4"] * 3) == ['"1,2"'] * 7 + ["3,4"] * 3
    assert unquote_rows(['"1,2"'] * 8 + ["3,4"] * 2) == ["1,2"] * 8 + ["3,4"] * 2
