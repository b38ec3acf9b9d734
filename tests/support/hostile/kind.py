"""What a kind of hostile inputs is: how one is made, and which command reads it."""

import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

from hostile.sandbox import Main

ROOT = Path(__file__).resolve().parents[3]
if str(ROOT) not in sys.path:
    sys.path.append(str(ROOT))  # the stand-in is no installed package
Draw = Callable[[Any], Any]


@dataclass(frozen=True)
class Kind:
    """A kind of input: `make` writes it into a folder and returns the words of a command line for `main`."""

    name: str
    share: int  # of a whole run, in inputs
    main: Callable[[str], Main]
    make: Callable[[Draw, Random, Path], list[str]]
    interrupt: float = 0.0  # [s] after which what runs for ever is told to end


MODULES = {  # of what is not in motor_identification/cli
    "tune": "motor_control.cli.tune",
    "check": "motor_driver.cli.check",
    "flash": "motor_board.cli.flash",
    "ros2": "ros2_stand_in.main",
    "motor_sim": "motor_sim.node",
    "motor_control": "motor_control.node",
    "motor_driver": "motor_driver.node",
    "motor_identification": "motor_identification.service.node",
    "monitor": "motor_identification.live.monitor_node",
    "board_emulator": "motor_board.node",
    "diff_drive": "motor_examples.diff_drive.node",
}


def command(name: str) -> Main:
    """The main function of a command or of a node, such as `identify`."""
    from importlib import import_module

    main: Main = import_module(MODULES.get(name, f"motor_identification.cli.{name}")).main
    return main
