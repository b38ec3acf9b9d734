"""What is given to a node and does not reach it: names that are nearly a parameter's, sections of another node."""

from pathlib import Path

import pytest

from motor_control.parameters import ROWS as CONTROL
from motor_driver.parameters import ROWS as DRIVER
from motor_examples.diff_drive.parameters import ROWS as DRIVE
from motor_model.given.mistakes import find_misspelt, find_mistake, find_unreached
from motor_sim.parameters import PROGRAM as SIM

TABLES = {"motor_driver": DRIVER, "motor_sim": SIM.rows, "motor_control": CONTROL, "diff_drive": DRIVE}
NAMES = {node: [row.name for row in rows] for node, rows in TABLES.items()}


@pytest.mark.parametrize("typed", ["max_voltge", "maxvoltage", "max-voltage", "Max_Voltage", "max_voltages"])
def test_a_slip_of_the_pen_is_told(typed: str) -> None:
    assert (
        find_misspelt([typed], NAMES["motor_driver"]) == f"there is no parameter {typed}, and max_voltage may be meant"
    )
    assert find_misspelt([typed, "max_voltage"], NAMES["motor_driver"]) == ""


@pytest.mark.parametrize("node", TABLES)
def test_no_parameter_of_another_node_of_the_workbench_is_taken_for_a_slip(node: str) -> None:
    """One file may be given to all of them, and to others: `/**:`."""
    everything = {name for names in NAMES.values() for name in names} | {"use_sim_time", "frame_id"}
    assert find_misspelt(everything, NAMES[node]) == ""
    for name in everything:
        assert find_misspelt([name], NAMES[node]) == ""


def written(path: Path, *names: str) -> str:
    path.write_text("".join(f'"{name}":\n  ros__parameters: {{max_voltage: 3.0}}\n' for name in names), "utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("sections", "node", "said"),
    [
        (("motor_driver",), "/left/motor_driver", "for 'motor_driver', which is not /left/motor_driver: write '/**/mo"),
        (("/**", "motor_driver"), "/left/motor_driver", "for 'motor_driver', which is not /left/motor_driver"),
        (("motor_drver",), "/motor_driver", "for 'motor_drver', and motor_driver may be meant"),
        (("/**/motor-driver",), "/left/motor_driver", "for '**/motor-driver', and motor_driver may be meant"),
        (("motor_driver",), "/motor_driver", ""),
        (("motor_driver", "/**/motor_driver"), "/left/motor_driver", ""),
        (("/left/motor_driver", "/right/motor_driver"), "/left/motor_driver", ""),
        (("/right/motor_driver",), "/left/motor_driver", ""),  # this one shall have the defaults
        (("/**",), "/left/motor_driver", ""),
        (("motor_driver2", "motor_driver_3"), "/motor_driver1", ""),
        (("motor_sim", "motor_control", "talker"), "/left/motor_driver", ""),
    ],
)
def test_a_section_that_does_not_reach_its_node_is_told(
    tmp_path: Path, sections: tuple[str, ...], node: str, said: str
) -> None:
    file = written(tmp_path / "p.yaml", *sections)
    found = find_unreached(file, node)
    assert (said in found and found.startswith(f"{file} has parameters")) if said else found == ""
    words = ("--ros-args", "-p", "x:=1", "--params-file", file)
    assert find_mistake(node, (), NAMES["motor_driver"], words) == found


def test_what_is_no_parameter_file_is_said_by_ros(tmp_path: Path) -> None:
    words = ("--ros-args", "--params-file", str(tmp_path / "none.yaml"), "--params-file")
    assert find_mistake("/motor_sim", (), NAMES["motor_sim"], words) == ""
