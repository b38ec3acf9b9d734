"""Matrices as text: brackets, semicolons, and a line for each column; what they do to an import: test_odd_logs.py."""

import pytest

from motor_identification.logs.csv.matrix import NOTE, take_off_brackets, turn_lines_into_columns


def test_brackets_and_semicolons_are_taken_off() -> None:
    rows = ["[ 0  0.00 0;", *(f"  {k} {0.02 * k:.2f} {k % 3};" for k in range(1, 20)), "  20 0.40 1]"]
    found = take_off_brackets(["t u y", "", *rows])
    assert found[:3] == ["t u y", "", " 0  0.00 0"] and found[-1].split() == ["20", "0.40", "1"]
    assert take_off_brackets(["data = [1,2;", *["3,4;"] * 9, "];"])[0] == "1,2"
    assert take_off_brackets(["1,2,3;"] * 20) == ["1,2,3"] * 20


@pytest.mark.parametrize("line", ["1;2", "1;2;", "1 2 3"])
def test_semicolons_between_cells_stay(line: str) -> None:
    assert take_off_brackets([line] * 20) == [line] * 20
    assert take_off_brackets([]) == []


@pytest.mark.parametrize("delimiter", [",", ";", "\t", " "])
@pytest.mark.parametrize("named", [True, False])
def test_a_line_for_each_column(delimiter: str, named: bool) -> None:
    columns = [[str(k) for k in range(50)], [f"{0.5 * k}" for k in range(50)]]
    lines = [delimiter.join([*([name] if named else []), *row]) for name, row in zip("tu", columns, strict=True)]
    found, said = turn_lines_into_columns([*lines, ""])
    assert said == (NOTE,) and found[0] == ("t;u" if named else "0;0.0")
    assert found[-1] == "49;24.5" and len(found) == 50 + named


@pytest.mark.parametrize(
    ("form", "between"), [("{} = [{}]", ", "), ("{}=[{}, ];", ","), ("{} = [ {} ];", " "), ("{}: ({}),", ", ")]
)
def test_lists_as_programs_print_them(form: str, between: str) -> None:
    """`pwm = [0, 20, 40]` and a line for the next: of Python, MATLAB, and people who paste them."""
    lists = {"pwm": [str(20 * k) for k in range(50)], "rpm": [f"{0.5 * k}" for k in range(50)]}
    lines = [form.format(name, between.join(cells)) for name, cells in lists.items()]
    found, said = turn_lines_into_columns(["", *lines])
    assert said == (NOTE,) and found[0] == "pwm;rpm" and found[-1] == "980;24.5" and len(found) == 51
    assert turn_lines_into_columns([*lines, "print(rpm)"]) == ([*lines, "print(rpm)"], ())


def test_decimal_commas_in_a_line_for_each_column() -> None:
    found, said = turn_lines_into_columns([";".join(f"{k},5" for k in range(50)), ";".join("7" for _ in range(50))])
    assert said and found[3] == "3,5;7"


@pytest.mark.parametrize(("rows", "cells", "turned"), [(2, 40, True), (2, 39, False), (20, 100, True), (20, 99, False)])
def test_tables_that_stand_upright_stay(rows: int, cells: int, turned: bool) -> None:
    lines = [",".join(["1"] * cells)] * rows
    assert bool(turn_lines_into_columns(lines)[1]) is turned


@pytest.mark.parametrize(
    "lines",
    [
        [",".join(["1"] * 120)] * 21,  # too many columns
        [",".join(["1"] * 120)],  # one line
        [",".join(["1"] * 120), ",".join(["1"] * 119)],
        [",".join(["1"] * 119 + ["x"]), ",".join(["1"] * 120)],
        [",".join(["t"] + ["1"] * 119), ",".join(["1"] * 120)],  # one of them named
    ],
)
def test_what_is_no_line_for_each_column(lines: list[str]) -> None:
    assert turn_lines_into_columns(lines) == (lines, ())


def test_comments_above_rows_that_end_with_semicolons_stay() -> None:
    above = ["% a log", "% of some motor", *["%"] * 20, "%t,u,y", "%[#],[V],[turns]"]
    found = take_off_brackets([*above, *["1,2,3;"] * 40])
    assert found[: len(above)] == above and found[-1] == "1,2,3"


@pytest.mark.parametrize("around", ["({})", "[{}],", "[{}]"])
def test_rows_as_python_prints_them(around: str) -> None:
    rows = [around.format(f"{0.1 * k:.1f}, {k}, -3") for k in range(20)]
    assert take_off_brackets(["# t, u, y", *rows])[:2] == ["# t, u, y", "0.0, 0, -3"]
    printed = ["[[0 1 2]", *[" [3 4 5]"] * 20, " [6 7 8]]"]
    assert take_off_brackets(printed)[0] == "0 1 2" and take_off_brackets(printed)[-1] == "6 7 8"
    assert take_off_brackets(["f(1) 2 (3)"] * 20) == ["f(1) 2 (3)"] * 20
