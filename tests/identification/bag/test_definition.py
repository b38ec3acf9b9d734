"""Definitions of installed types, whole with everything nested in them, as bags embed them."""

from motor_identification.bag.definition import Definition, installed


def test_a_type_without_nested_types_is_its_file() -> None:
    found = installed("std_msgs/msg/Float64")
    assert "float64 data" in found.text and "MSG:" not in found.text
    assert found.type_hash.startswith("RIHS01_") and len(found.type_hash) == len("RIHS01_") + 64


def test_nested_types_follow_once_each_behind_separators() -> None:
    text = installed("motor_msgs/msg/MotorSpeed").text
    parts = text.split("=" * 80 + "\n")
    assert [part.splitlines()[0] for part in parts[1:]] == ["MSG: std_msgs/Header", "MSG: builtin_interfaces/Time"]
    assert "float64 speed" in parts[0] and "string frame_id" in parts[1] and "int32 sec" in parts[2]


def test_types_nested_in_nested_ones_are_found() -> None:
    text = installed("sensor_msgs/msg/JointState").text
    assert text.count("MSG: ") == text.count("=" * 80) == 2
    array = installed("diagnostic_msgs/msg/DiagnosticArray").text
    assert {line for line in array.splitlines() if line.startswith("MSG: ")} == {
        "MSG: std_msgs/Header",
        "MSG: builtin_interfaces/Time",
        "MSG: diagnostic_msgs/DiagnosticStatus",
        "MSG: diagnostic_msgs/KeyValue",
    }


def test_what_is_not_installed_has_no_definition() -> None:
    assert installed("no_msgs/msg/Nothing") == installed("std_msgs/msg/Nothing") == Definition("", "")
