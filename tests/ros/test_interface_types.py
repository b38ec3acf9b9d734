"""A type's name becomes an import only where an installed interface has it."""

from pathlib import Path

import pytest
from std_msgs.msg import Float64

from motor_msgs.srv import Identify
from motor_ros.interface_types import NotInstalled, definition_file, load, load_message


@pytest.mark.parametrize(
    "name",
    ["std_msgs/msg/Float64", "motor_msgs/srv/Identify", "motor_msgs/action/Diagnose_SendGoal_Request"],
)
def test_installed_interfaces_are_loaded(name: str) -> None:
    assert load(name).__name__ == name.rpartition("/")[2]
    assert definition_file(name).is_file()


@pytest.mark.parametrize(
    "name",
    [
        "venv/__main__/X",  # a module that does something where it is imported
        "antigravity/msg/X",
        "os/msg/Path",
        "../std_msgs/msg/Float64",
        "std_msgs/msg/../msg/Float64",
        "std_msgs/msg/Float64\n",
        "std_msgs.msg/msg/Float64",
        "std_msgs/Float64",
        "std_msgs/msg/NoSuch",
        "std_msgs/msg/float64",
        "",
        "x" * 100_000 + "/msg/X",
        "std_msgs/msg/\N{FULLWIDTH LATIN CAPITAL LETTER F}loat64",
    ],
)
def test_all_other_names_are_refused_without_an_import(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("motor_ros.interface_types.import_module", lambda name: pytest.fail(f"imports {name}"))
    with pytest.raises(NotInstalled):
        load(name)


def test_a_package_that_shadows_an_installed_one_is_not_imported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The index has std_srvs, and Python would take that of the working directory."""
    (tmp_path / "sensor_msgs").mkdir()
    (tmp_path / "sensor_msgs" / "__init__.py").write_text("raise SystemExit('imported')")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(__import__("sys").modules, "sensor_msgs", raising=False)
    with pytest.raises(NotInstalled, match=r"^the Python package sensor_msgs is in .*, not in "):
        load("sensor_msgs/msg/JointState")


def test_only_a_message_can_be_sent() -> None:
    assert load_message("std_msgs/msg/Float64") is Float64
    assert load("motor_msgs/srv/Identify") is Identify
    with pytest.raises(NotInstalled, match="is not the type of a message"):
        load_message("motor_msgs/srv/Identify")
