"""What the tests of parameter files, launch files and pages share: every node's parameters, every launch session."""

import importlib.util
from pathlib import Path
from types import ModuleType

from motor_board.parameters import FAULTS, SET_UP
from motor_bringup import diff_drive, identify, motor, motors, replay
from motor_control.parameters import ROWS as CONTROL
from motor_driver.parameters import ROWS as DRIVER
from motor_examples.diff_drive.parameters import ROWS as DIFF_DRIVE
from motor_identification.service.node import PARAMETERS as IDENTIFICATION
from motor_ros.parameters import SHARED_PARAMETERS, max_voltage_row
from motor_sim.parameters import PARAMETERS as SIM

ROOT = Path(__file__).resolve().parents[2]
# node: the parameter file, and the parameters it declares
NODES = {
    "motor_sim": ("plant.yaml", (*SHARED_PARAMETERS, max_voltage_row(), *SIM)),
    "motor_driver": ("plant.yaml", DRIVER),
    "board_emulator": ("plant.yaml", (*SET_UP, *FAULTS)),
    "motor_control": ("control.yaml", CONTROL),
    "motor_identification": ("identification.yaml", IDENTIFICATION),
    "diff_drive": ("robot.yaml", DIFF_DRIVE),
}
SESSIONS = {
    "motor": motor,
    "motors": motors,
    "identify": identify,
    "replay": replay,
    "diff_drive": diff_drive,
}  # launch file: its session


def reference(name: str) -> ModuleType:
    """A script of docs/ as a module."""
    spec = importlib.util.spec_from_file_location(name, ROOT / "docs" / f"{name}.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
