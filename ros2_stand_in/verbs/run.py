"""`ros2 run`: becomes the executable, so that signals and the exit status pass straight through."""

import argparse
import os
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

from motor_model.program.entry_point import hold_interrupt_back
from ros2_stand_in.interfaces import packages

WORKBENCH = Path(__file__).resolve().parents[2]


def run_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 run` takes."""
    parser.add_argument("--prefix", default="", help="command to put before the executable, such as 'gdb --args'")
    parser.add_argument("package_name", help="name of the package")
    parser.add_argument("executable_name", help="name of the executable")
    parser.add_argument("argv", nargs=argparse.REMAINDER, help="all that follows goes to the executable")


def run(args: argparse.Namespace) -> int:
    """Replace this process by the executable."""
    path = packages.executable(args.package_name, args.executable_name)
    if (WORKBENCH / args.package_name / args.package_name / "programs.py").is_file():
        hold_interrupt_back()
    become([*shlex.split(args.prefix), str(path), *args.argv])


def become(command: Sequence[str]) -> NoReturn:
    """Replace this process by another command.

    Raises:
        NotInstalled: the command cannot be started.
    """
    sys.stdout.flush()
    try:
        os.execvp(command[0], list(command))
    except OSError as error:
        raise packages.NotInstalled(f"{command[0]} cannot be started: {error.strerror}.") from error
