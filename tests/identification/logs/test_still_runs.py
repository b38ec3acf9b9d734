"""Runs in which the motor never moves."""

from dataclasses import replace
from pathlib import Path

import pytest

from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.logs.run import Run
from motor_identification.logs.still_runs import leave_out_still_runs, rows_in_motion
from motor_model.sample import Sample


def run(label: str, voltage: float, speed: float) -> Run:
    return Run(label, tuple(Sample(k, speed, voltage, 0, 0, 0.0, 12.0, 0.0) for k in range(5)))


def test_they_are_left_out_and_told() -> None:
    runs, said = leave_out_still_runs([run("0V", 0.0, 0.0), run("-1V", -1.0, 0.0), run("3V", 3.0, 2.0)])
    assert [one.label for one in runs] == ["3V"]
    assert said == ("Left out: 2 runs in which the motor never moves, at 1 V at most (0V, -1V).",)


@pytest.mark.parametrize(("rows", "left"), [(3, 1), (4, 2)])
def test_runs_that_hardly_begin_are_left_out(rows: int, left: int) -> None:
    """As behind the last gap of a log: a bag of two rows is refused, and with it all that are given together."""
    counted = Run("8", tuple(Sample(k, 0.0, 1.0, min(k, rows), 0, 0.0, 12.0, 0.0) for k in range(20)))
    assert rows_in_motion(counted) == rows
    runs, said = leave_out_still_runs([run("7", 3.0, 2.0), counted])
    assert len(runs) == left
    assert said == (("Left out: 1 run of fewer than 4 rows in motion (8).",) if left == 1 else ())
    both, said = leave_out_still_runs(
        [run("7", 3.0, 2.0), run("0", 0.0, 0.0), replace(counted, samples=counted.samples[:3])]
    )
    assert len(both) == 1 and len(said) == 2
    assert len(leave_out_still_runs([replace(counted, samples=counted.samples[:3])])[0]) == 1


def test_all_stay_where_all_move_or_none_does() -> None:
    for speed in (0.0, 2.0):
        runs, said = leave_out_still_runs([run("a", 1.0, speed), run("b", 2.0, speed)])
        assert (len(runs), said) == (2, ())


def test_steps_from_standstill_of_a_file(tmp_path: Path) -> None:
    """The clock begins with each voltage; at 1 V the motor stays where it is."""
    rows = [
        f"{u},{0.01 * k + 0.004:.3f},{round(max(u - 1.5, 0.0) * 90.0 * (0.01 * k))}"
        for u in (1.0, 3.0, 5.0)
        for k in range(100)
    ]
    (tmp_path / "log.csv").write_text("\n".join(["voltage [V],t [s],pos [deg]", *rows]) + "\n")
    (motor,) = import_log(tmp_path / "log.csv", Said()).motors
    assert [one.label for one in motor.log.runs] == ["3V", "5V"]
    left_out = [line for line in motor.log.findings if line.startswith("Left out")]
    assert left_out == ["Left out: 1 run in which the motor never moves, at 1 V at most (1V)."]
