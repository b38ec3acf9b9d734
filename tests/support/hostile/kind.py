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


def command(name: str) -> Main:
    """The main function of a command, such as `identify`."""
    from importlib import import_module

    packages = {"tune": "motor_control.cli.tune", "ros2": "ros2_stand_in.main"}
    main: Main = import_module(packages.get(name, f"motor_identification.cli.{name}")).main
    return main


def node(name: str) -> Main:
    from importlib import import_module

    modules = {"motor_identification": "service.node", "monitor": "live.monitor_node"}
    module = f"motor_identification.{modules[name]}" if name in modules else f"{name}.node"
    main: Main = import_module(module).main
    return main
