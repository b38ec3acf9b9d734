"""One motor at work: several keep apart, and whose value prevails."""

from pathlib import Path

from motor_bringup import motor
from motor_bringup.program import Program, Session

BAGS = Path(__file__).resolve().parents[2] / "bags"


def by_name(session: Session) -> dict[str, Program]:
    return {program.executable: program for program in (*session.programs, *session.steps)}


def test_two_motors_keep_apart() -> None:
    left, right = (
        motor.session({"plant": "emulated", "namespace": name, "record": "true"}) for name in ("left", "/right/")
    )
    programs = by_name(left), by_name(right)
    assert [p["motor_driver"].namespace for p in programs] == ["left", "right"]
    assert [p["motor_driver"].parameters["name"] for p in programs] == ["left", "right"]
    assert [p["board_emulator"].parameters["link"] for p in programs] == [
        "/tmp/motor_board_left",
        "/tmp/motor_board_right",
    ]
    assert all(
        p["record"].arguments[1:] == ("--topic-namespace", name)
        for p, name in zip(programs, ("left", "right"), strict=True)
    )
    assert all(
        p["record"].arguments[0].startswith(name) for p, name in zip(programs, ("left_20", "right_20"), strict=True)
    )


def test_which_value_prevails(tmp_path: Path) -> None:
    """Ours, what follows from model and namespace, the user's file, the user's words."""
    file = tmp_path / "mine.yaml"
    file.write_text(
        "/**:\n  ros__parameters: {sample_rate: 500.0, max_voltage: 7.0, kp: 0.5, ki: 0.5}\n", encoding="utf-8"
    )
    told = {"parameters": str(file), "model": str(BAGS / "emulated.yaml"), "namespace": "left"}
    programs = by_name(motor.session({**told, "gains": str(BAGS / "low_gain.yaml")}))
    plant, control = programs["motor_sim"].parameters, programs["motor_control"].parameters
    assert (plant["sample_rate"], plant["max_voltage"], plant["name"]) == (500.0, 7.0, "left")
    assert (control["kp"], control["ki"], control["voltage_limit"]) == (0.02, 0.25, 12.0)
    assert by_name(motor.session({"parameters": str(file)}))["motor_control"].parameters["kp"] == 0.5
