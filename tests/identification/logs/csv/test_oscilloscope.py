"""Tables of oscilloscopes whose header says when the rows were."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.csv.oscilloscope import give_times
from motor_identification.logs.csv.reader import read_table

ROWS = [(0.5 * k, 2.0 - k) for k in range(6)]
NUMBERED = [f"{k},{one:.2e},{other:.2e}," for k, (one, other) in enumerate(ROWS)]
BARE = [f"{one:.2e},{other:.2e},," for one, other in ROWS]
SAID = "Rows are 5 ms apart, as the oscilloscope's header says."


@pytest.mark.parametrize(
    ("above", "rows", "names"),
    [
        (
            ["X,CH1,CH2,Start,Increment,", "Sequence,VOLT,VOLT,-1.5e-02,5.0e-03,"],
            NUMBERED,
            ["CH1 [VOLT]", "CH2 [VOLT]"],
        ),
        (["X,CH1,CH2,Start,Increment", "Sequence,Volt,Volt,-1.5e-02,5.0e-03"], NUMBERED, ["CH1 [Volt]", "CH2 [Volt]"]),
        (["Time(s),CH1V,CH2V,t0 = -1.5e-02, tInc = 5.0e-03,"], BARE, ["CH1V", "CH2V"]),
    ],
)
def test_rows_have_the_times_that_the_header_says(
    tmp_path: Path, above: list[str], rows: list[str], names: list[str]
) -> None:
    path = tmp_path / "scope.csv"
    path.write_text("\n".join([*above, *rows]) + "\n")
    table = read_table(path)
    assert table.names == ["time [s]", *names] and table.notes == (SAID,)
    assert table.numbers("time [s]") == pytest.approx(-0.015 + 0.005 * np.arange(6))
    for k, name in enumerate(names):
        assert table.numbers(name).tolist() == [row[k] for row in ROWS]
    assert table.lines[0] == len(above) + 1  # as the file counts


def test_the_first_rows_may_have_been_cut_off() -> None:
    lines = ["X,CH1,Start,Increment", "Sequence,Volt,0.0,0.001", *(f"{k},1.0," for k in range(7, 10))]
    assert give_times(lines)[0][2:] == ["0.007,1.0", "0.008,1.0", "0.009,1.0"]


@pytest.mark.parametrize(
    "lines",
    [
        [],
        ["t,u,y", "0,1,2", "1,2,3"],
        ["k,u,increment", "0,1,2", "1,2,3"],  # counts of each row
        ["X,CH1,Start,Increment", "Sequence,Volt,0.0,", "0,1,,"],
        ["X,CH1,Start,Increment", "Sequence,Volt,0.0,0.0", "0,1,,"],
    ],
)
def test_other_tables_stay(lines: list[str]) -> None:
    assert give_times(lines) == (lines, [])
