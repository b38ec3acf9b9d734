"""A robot of two motors in one line: each in its namespace, with its own model; references end by themselves."""

from pathlib import Path

import pytest

from motor_bringup import diff_drive
from motor_bringup.program import Program

BAGS = Path(__file__).resolve().parents[2] / "bags"


def by_side(told: dict[str, str]) -> dict[tuple[str, str], Program]:
    programs = diff_drive.session(told).programs
    found = {(program.namespace, program.executable): program for program in programs}
    assert len(found) == len(programs)
    return found


@pytest.mark.parametrize(("plant", "each"), [("sim", 2), ("emulated", 3), ("hardware", 2)])
def test_both_wheels_and_the_drive_are_started(plant: str, each: int) -> None:
    programs = by_side({"plant": plant, "left": "1", "right": "2"})
    assert [sum(side == name for side, _ in programs) for name in ("left", "right", "")] == [each, each, 1]
    assert all(programs[side, "motor_control"].parameters["reference_timeout"] == 0.5 for side in ("left", "right"))
    assert programs["", "diff_drive"].parameters["cmd_vel_timeout"] == 0.5


def test_each_wheel_has_its_own(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text(
        "/left/motor_control:\n  ros__parameters: {reference_timeout: 0.2}\n"
        "/**/diff_drive:\n  ros__parameters: {wheel_radius: 0.05}\n",
        encoding="utf-8",
    )
    model, gains = str(BAGS / "emulated.yaml"), str(BAGS / "low_gain.yaml")
    told = {"plant": "hardware", "left_model": model, "right_gains": gains, "parameters": str(file)}
    programs = by_side({**told, "left": "7", "right": "9"})
    assert [programs[s, "motor_driver"].parameters["board_id"] for s in ("left", "right")] == ["7", "9"]
    assert [programs[s, "motor_driver"].parameters["name"] for s in ("left", "right")] == ["left", "right"]
    controls = [programs[s, "motor_control"].parameters for s in ("left", "right")]
    assert [one["model"] for one in controls] == [model, ""]
    assert [one["kp"] for one in controls] == [0.2, 0.02]
    assert [one["reference_timeout"] for one in controls] == [0.2, 0.5]
    assert programs["", "diff_drive"].parameters["wheel_radius"] == 0.05
    recorders = [p for p in diff_drive.session({"record": "true"}).programs if p.executable == "record"]
    assert [p.arguments[-1] for p in recorders] == ["left", "right"]
