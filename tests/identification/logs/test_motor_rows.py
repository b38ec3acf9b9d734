"""Rows of several motors under the same columns."""

from pathlib import Path

import numpy as np
import pytest

from motor_identification.logs.columns.said import Said
from motor_identification.logs.csv.table import Table
from motor_identification.logs.imported import import_log
from motor_identification.logs.motor_rows import FEWEST_ROWS, separate_motors


def table(column: str, names: list[str]) -> Table:
    return Table(Path("log.csv"), np.arange(len(names)), {"t": np.arange(len(names)) * 0.01, column: names})


@pytest.mark.parametrize("order", ["rows", "blocks"])
def test_motors_that_a_column_names_are_read_apart(tmp_path: Path, order: str) -> None:
    """In turn, row by row, or one after the other: each has its own gain."""
    time = np.arange(200) * 0.02
    volts = np.repeat([6.0, -3.0, 9.0, -6.0], 50)
    lines = [
        (k, m, f"{time[k]:.2f},M{m},{volts[k]},{volts[k] * 5 * m * (1 - np.exp(-(k % 50) / 9)):.3f}")
        for m in (1, 2)
        for k in range(200)
    ]
    lines.sort(key=lambda line: line[:2] if order == "rows" else (line[1], line[0]))
    (tmp_path / "log.csv").write_text("\n".join(["time,motor,voltage,rpm", *(line[2] for line in lines)]) + "\n")
    imported = import_log(tmp_path / "log.csv", Said())
    assert [motor.label for motor in imported.motors] == ["M1", "M2"]
    tops = [max(sample.speed for run in motor.log.runs for sample in run.samples) for motor in imported.motors]
    assert tops[1] == pytest.approx(2.0 * tops[0], rel=1e-3)
    assert [len(run.samples) for motor in imported.motors for run in motor.log.runs] == [200, 200]
    assert "motor names 2 motors: M1, M2, a bag each at least." in imported.findings


@pytest.mark.parametrize(
    ("column", "names", "motors"),
    [
        ("motor", ["left", "right"], 2),
        ("Wheel ID", ["FL", "FR", "RL", "RR"], 4),
        ("motor", ["M1"], 1),
        ("motor", ["on", "off"], 1),  # a state
        ("motor", ["100", "200"], 1),  # what drives it
        ("motor_speed", ["M1", "M2"], 1),
        ("test", ["M1", "M2"], 1),
        ("motor", [f"M{k}" for k in range(17)], 1),
        ("motor", ["1", "2", "4"], 1),
    ],
)
def test_which_columns_name_motors(column: str, names: list[str], motors: int) -> None:
    rows = table(column, names * FEWEST_ROWS)
    assert len(separate_motors(rows, Said())) == motors
    assert len(separate_motors(rows, Said(split=column))) == motors
    assert list(separate_motors(rows, Said(voltage=column))) == [""]
    if motors > 1:
        assert len(separate_motors(table(column, (names * FEWEST_ROWS)[:-1]), Said())) == 1


def test_numbers_are_motors_where_rows_are_split_by_them() -> None:
    for names in (["1", "2", "3"], ["0", "1"]):
        rows = table("motor", names * FEWEST_ROWS)
        assert list(separate_motors(rows, Said(split="motor"))) == names
        assert list(separate_motors(rows, Said(split="t"))) == list(separate_motors(rows, Said())) == [""]


def test_a_motor_that_turns_the_other_way_is_turned_round_alone(tmp_path: Path) -> None:
    """The sign of four motors was decided by all their rows, so that two of them were made wrong."""
    volts = np.tile(np.repeat([6.0, -3.0, 9.0, -6.0], 50), 2)
    lines = [
        f"{0.02 * (k % 200):.2f},{k // 200 + 1},M{m},{volts[k]},{sign * volts[k] * 5 * (1 - np.exp(-(k % 50) / 9)):.3f}"
        for m, sign in ((1, -1.0), (2, -1.0), (3, -1.0), (4, 1.0))
        for k in range(400)
    ]
    (tmp_path / "log.csv").write_text("\n".join(["time,test,motor,voltage,rpm", *lines]) + "\n")
    for split, runs in (("motor", ["1", "2"]), ("test", ["1", "2"])):
        motors = import_log(tmp_path / "log.csv", Said(split=split)).motors
        assert [motor.label for motor in motors] == ["M1", "M2", "M3", "M4"]
        assert all([run.label for run in motor.log.runs] == runs for motor in motors)
        turned = ["its sign is turned round" in "".join(motor.log.findings) for motor in motors]
        assert turned == [True, True, True, False]
        assert all(run.samples[-1].speed < 0.0 for motor in motors for run in motor.log.runs)
