"""The sections of a parameter file, and which nodes they are for."""

from pathlib import Path

import pytest

from motor_model.errors import MotorError
from motor_model.given.sections import reaches, read_sections


@pytest.mark.parametrize(
    ("name", "reached"),
    [
        ("/**", True),
        ("**/motor_sim", True),
        ("/left/motor_sim", True),
        ("left/motor_sim", True),
        ("/*/motor_sim", True),
        ("motor_sim", False),
        ("/*/*/motor_sim", False),
        ("/left/motor.sim", False),
    ],
)
def test_names_match_as_they_do_in_ros(name: str, reached: bool) -> None:
    assert reaches(name, "/left/motor_sim") == reached


def test_sections_are_read_in_order_wherever_namespaces_stand(tmp_path: Path) -> None:
    file = tmp_path / "p.yaml"
    file.write_text("left:\n  motor_sim:\n    ros__parameters: {seed: 1}\n/**:\n  ros__parameters:\n", "utf-8")
    assert read_sections(str(file)) == [("/left/motor_sim", {"seed": 1}), ("/**", {})]
    file.write_text("kp: 1.0\n", "utf-8")
    with pytest.raises(MotorError, match="is no parameter file: it needs"):
        read_sections(str(file))
