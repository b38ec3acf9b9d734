"""Lines between rows that are no rows."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.csv.reader import read_table
from motor_identification.logs.csv.sentences import drop_sentences
from motor_model.errors import RecordingError

GREETING = [
    "Motor test version 0.8 build 115",
    "Pins set",
    "Longest time of a run [ms]: 65535",
    "Kp: 0.01 Ki: 0.96 Kd: 0.00",
]


def rows_of(lines: list[str], width: int) -> tuple[int, list[int]]:
    dropped: list[int] = []
    kept = list(drop_sentences(((k, line.split()) for k, line in enumerate(lines)), width, False, dropped))
    return len(kept), dropped


def test_what_a_board_says_as_it_starts_again(tmp_path: Path) -> None:
    """A serial capture of several runs: a zero byte and a greeting before each."""
    run = [f"{10 * k}.00 {100 * (k > 2)} {3 * k} -7.5" for k in range(60)]
    zeros = b"\0" * 3
    text = "\n".join([*GREETING, *run]).encode() + b"\n" + zeros + "\n".join([*GREETING, *run]).encode() + b"\n"
    (tmp_path / "log.txt").write_bytes(text + b"\0" * 400)  # a block of a card that was not filled
    table = read_table(tmp_path / "log.txt")
    assert len(table) == 120
    np.testing.assert_allclose(table.numbers("column 1"), 10.0 * np.tile(np.arange(60.0), 2))
    told = [note for note in table.notes if "of words" in note]
    assert told == ["Left out: 3 lines (the first is 65) of words and few numbers, as of a board that starts again."]


def test_rows_with_words_stay() -> None:
    assert rows_of(["0 1 2 3"] * 9 + ["Kp: 0.01 Ki: 0.96 Kd: x"], 4) == (9, [9])
    assert rows_of(["0 1 2 3"] * 9 + ["x y 2 z"], 4) == (10, [])  # a garbled row keeps its time
    assert rows_of(["0 1 2 3"] * 9 + ["0 1 2"], 4) == (10, [])  # one that was cut off
    assert rows_of(["0 M1 run FWD"] * 9 + ["0 M1 run FWD fast"], 4) == (10, [])  # columns of words


@pytest.mark.parametrize(("zeros", "read"), [(1, True), (2, False)])
def test_zero_bytes_of_numbers_are_no_text(tmp_path: Path, zeros: int, read: bool) -> None:
    lines = [f"{k},{k}".encode() for k in range(120)]
    for k in range(zeros):
        lines[10 * k + 5] = b"\0" + lines[10 * k + 5]
    (tmp_path / "log.csv").write_bytes(b"\n".join(lines) + b"\n")
    if read:
        assert len(read_table(tmp_path / "log.csv")) == 120
    else:
        with pytest.raises(RecordingError, match="is not text"):
            read_table(tmp_path / "log.csv")
