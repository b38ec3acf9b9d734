"""Blocks of lines, a name and a value each."""

import pytest

from motor_identification.logs.csv.blocks import NOTE, turn_blocks_into_rows

JOINT = """header:
  stamp:
    sec: 17
    nanosec: {0}0000000
  frame_id: ''
name:
- left
- right
position:
- 0.{0}
- -1.5
effort: [2.0, {0}]
---"""
REPORT = "Elapsed Time: 0.{0}\nPWM_Speed: {0}0\nState: run\n"


def test_messages_as_ros_shows_them() -> None:
    lines = "\n".join(JOINT.format(k) for k in range(9)).splitlines()
    found, said = turn_blocks_into_rows(lines)
    assert said == (NOTE,) and len(found) == 10
    assert found[0] == "header stamp sec;header stamp nanosec;position 1;position 2;effort 1;effort 2"
    assert found[3] == "17;20000000;0.2;-1.5;2.0;2"


@pytest.mark.parametrize("between", ["", "=====\n", "\n"])
def test_reports_of_a_program(between: str) -> None:
    found, said = turn_blocks_into_rows("".join(REPORT.format(k) + between for k in range(9)).splitlines())
    assert said and found[0] == "Elapsed Time;PWM_Speed" and found[-1] == "0.8;80" and len(found) == 10


def test_a_block_that_lacks_a_value_has_an_empty_cell() -> None:
    lines = [f"t: {k}\n{'u: 1' if k != 4 else 'i: 0'}" for k in range(9)]
    assert turn_blocks_into_rows("\n".join(lines).splitlines())[0][5] == "4;;0"


@pytest.mark.parametrize(
    "lines",
    [
        ["t: 0, u: 1, y: 2"] * 40,  # a row each
        ["t: 0 u: 1"] * 40,
        ["t,u,y", *["0,1,2"] * 40],
        ["# name: a", "# type: matrix", *["1 2 3"] * 40],
        ["t: 0", "u: 1", "t: 1", "u: 2"],  # too few
        ["t: 0"] * 40,  # one name
        [],
    ],
)
def test_other_lines_stay(lines: list[str]) -> None:
    assert turn_blocks_into_rows(lines) == (lines, ())
