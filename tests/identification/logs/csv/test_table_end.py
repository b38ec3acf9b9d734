"""Where the rows of a text table end."""

from pathlib import Path

import pytest

from motor_identification.logs.csv.reader import read_table

SETTINGS = ["", "Axis :;CoMax", "PID :;KP;KI;KD;KV;KA", "Position :;1000;1000;1000;0;0", "Speed :;1000;1000;;0;0"]


@pytest.mark.parametrize("count", [8, 30, 150])
def test_settings_behind_the_rows_are_none_of_them(tmp_path: Path, count: int) -> None:
    rows = [f"{k};{5 * k},0;;{k % 7};2" for k in range(count)]
    (tmp_path / "log.csv").write_text("\n".join(["n;t;;i;w", *rows, *SETTINGS]) + "\n")
    found = read_table(tmp_path / "log.csv")
    assert (
        found.numbers("t").tolist() == [5.0 * k for k in range(count)] and found.numbers("w").tolist() == [2.0] * count
    )
    assert found.notes[0] == f"Left out: the lines from {count + 3} on, which lack numbers that all rows before have."


def test_rows_that_lack_numbers_between_others_stay(tmp_path: Path) -> None:
    rows = [f"{k};{k},5;{'' if k > 30 else k}" for k in range(40)]
    rows[20:22] = ["20;;", "21;;20"]
    (tmp_path / "log.csv").write_text("\n".join(["n;t;w", *rows]) + "\n")
    found = read_table(tmp_path / "log.csv")
    assert len(found) == 40 and found.notes == ()


@pytest.mark.parametrize(
    ("last", "kept"),
    [
        ("85.00\t35.83\t7", False),  # of 77.78
        ("85.00\t35.83\t77.", False),
        ("85.00\t35.83\t77.78", True),
        ("85.00\t35.83\t7\n", True),  # a whole line
        ("85.00\t35.83\t7 ", True),
    ],
)
def test_a_last_number_that_is_cut_off_is_left_out(tmp_path: Path, last: str, kept: bool) -> None:
    rows = [f"85.00\t35.83\t{77.0 + 0.13 * k:.2f}" for k in range(20)]
    (tmp_path / "log.txt").write_text("\n".join(["r\tu\ty", *rows, last]))
    found = read_table(tmp_path / "log.txt")
    assert len(found) == 20 + kept
    assert found.notes == (() if kept else ("Line 22, the last, is cut off within its last number and left out.",))


def test_numbers_without_decimals_do_not_tell_whether_one_is_cut_off(tmp_path: Path) -> None:
    rows = [f"{k},{70 + k % 7}{'.5' if k % 3 else ''}" for k in range(20)]
    (tmp_path / "log.csv").write_text("\n".join(["t,y", *rows, "20,7"]))
    assert len(read_table(tmp_path / "log.csv")) == 21
