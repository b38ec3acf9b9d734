"""Runs in which the motor never moves."""

from pathlib import Path

from motor_identification.logs.columns.said import Said
from motor_identification.logs.imported import import_log
from motor_identification.logs.run import Run
from motor_identification.logs.still_runs import leave_out_still_runs
from motor_model.sample import Sample


def run(label: str, voltage: float, speed: float) -> Run:
    return Run(label, tuple(Sample(k, speed, voltage, 0, 0, 0.0, 12.0, 0.0) for k in range(5)))


def test_they_are_left_out_and_told() -> None:
    runs, said = leave_out_still_runs([run("0V", 0.0, 0.0), run("-1V", -1.0, 0.0), run("3V", 3.0, 2.0)])
    assert [one.label for one in runs] == ["3V"]
    assert said == ("Left out: 2 runs in which the motor never moves, at 1 V at most (0V, -1V).",)


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
