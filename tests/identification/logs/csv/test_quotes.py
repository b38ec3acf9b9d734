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


def test_line_breaks_in_quotes_are_no_rows(tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    path.write_text("time,speed,pwm\n" + "".join(f'{0.01 * k:.2f},{k},"{k % 3}\r\n"\n' for k in range(20)), newline="")
    table = read_table(path)
    assert table.notes == () and table.lines[3] == 8
    np.testing.assert_allclose(table.numbers("pwm"), np.arange(20) % 3)
    odd = ["a,b", *['1,"'] * 3, *["2,3"] * 20]
    assert unquote_rows(odd) == odd and unquote_rows(['1,"2', '"', *["3,4"] * 20])[:2] == ['1,"2', '"']


def test_line_breaks_in_quotes_in_the_middle_of_rows(tmp_path: Path) -> None:
    """As of a supply's voltage that was read from a power meter, to the end of its line."""
    path = tmp_path / "log.csv"
    rows = "".join(f'{k},{0.01 * k:.2f},"+{k % 3}.5E+00\n",{2 * k},25\n' for k in range(20))
    path.write_text(f",time,pwm,speed,temp\n{rows}")
    table = read_table(path)
    np.testing.assert_allclose(table.numbers("pwm"), np.arange(20) % 3 + 0.5)
    np.testing.assert_allclose(table.numbers("speed"), 2.0 * np.arange(20))
    quoted = ['"1","2"', '"3",4'] * 10  # rows that begin with a quote, and close what they opened
    assert unquote_rows(quoted) == quoted
