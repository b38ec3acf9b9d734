"""A user's parameter file: which sections are for a node, and what is said of what is no such file."""

from pathlib import Path

import pytest

from motor_bringup.parameter_file import parameters_for, parameters_named, parameters_told
from motor_model.errors import MotorError


def written(path: Path, text: str) -> str:
    path.write_text(text, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("key", "found"),
    [
        ("/**", True),
        ("/**/motor_sim", True),
        ("/left/motor_sim", True),
        ("left/motor_sim", True),
        ("/*/motor_sim", True),
        ("motor_sim", False),
        ("/right/motor_sim", False),
        ("/*/*/motor_sim", False),
        ("/**/motor_driver", False),
    ],
)
def test_names_match_as_they_do_in_ros(tmp_path: Path, key: str, found: bool) -> None:
    file = written(tmp_path / "p.yaml", f'"{key}":\n  ros__parameters: {{seed: 7}}\n')
    assert parameters_for("/left/motor_sim", file) == ({"seed": 7} if found else {})


def test_namespaces_may_stand_around_the_node_and_later_sections_prevail(tmp_path: Path) -> None:
    text = "left:\n  motor_sim:\n    ros__parameters: {seed: 1, name: a}\n"
    text += "/**:\n  ros__parameters: {seed: 2, qos: {depth: 3}}\n"
    file = written(tmp_path / "p.yaml", text)
    assert parameters_for("/left/motor_sim", file) == {"seed": 2, "name": "a", "qos.depth": 3}


def test_gains_are_found_in_whatever_namespace_they_were_dumped(tmp_path: Path) -> None:
    file = written(tmp_path / "gains.yaml", "/left/motor_control:\n  ros__parameters: {kp: 0.3}\n")
    assert parameters_named("motor_control", file) == {"kp": 0.3}
    assert parameters_for("/motor_control", file) == {}
    with pytest.raises(MotorError, match=r"has no parameters for motor_sim: it needs '/\*\*/motor_sim:'"):
        parameters_named("motor_sim", file)


@pytest.mark.parametrize("text", ["", "kp: 1.0\n", "- 1\n", "7\n"])
def test_what_is_no_parameter_file_is_one_sentence(tmp_path: Path, text: str) -> None:
    with pytest.raises(MotorError, match="is no parameter file: it needs"):
        parameters_for("/motor_sim", written(tmp_path / "p.yaml", text))


def test_what_is_no_yaml_is_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(MotorError, match="cannot be read as YAML"):
        parameters_for("/motor_sim", written(tmp_path / "p.yaml", "{"))


def test_a_section_that_was_meant_for_a_node_and_is_not_for_it_is_refused(tmp_path: Path) -> None:
    file = written(tmp_path / "p.yaml", "motor_sim:\n  ros__parameters: {max_voltage: 3.0}\n")
    with pytest.raises(MotorError, match=r"for 'motor_sim', which is not /left/motor_sim: write '/\*\*/motor_sim'"):
        parameters_told("/left/motor_sim", file)
    assert parameters_told("/motor_sim", file) == {"max_voltage": 3.0}
