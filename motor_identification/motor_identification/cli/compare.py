"""Compare identified motors: `compare LEFT.yaml RIGHT.yaml`."""

import argparse
from pathlib import Path

from motor_ros.command.parser import CommandParser
from motor_ros.command.shell import shell

EXAMPLES = """\
the motors of a robot, each recorded and identified with the same effects:
  ros2 run motor_identification compare left.yaml right.yaml
"""


def main(args: list[str] | None = None) -> int:
    """Entry point; returns the exit status."""
    options = parser().parse_args(args)
    return shell(lambda: _compare(options))


def parser() -> argparse.ArgumentParser:
    """Make the command line's parser."""
    made = CommandParser(
        "motor_identification",
        "compare",
        "Show the parameters of identified motors side by side, and say which differ by more than their errors.",
        EXAMPLES,
    )
    made.add_argument("first", metavar="MODEL", help="model file (YAML), with which the others are compared")
    made.add_argument("others", metavar="MODEL", nargs="+", help="model files, as identify or diagnose writes them")
    return made


def _compare(options: argparse.Namespace) -> int:
    from motor_identification.reporting.model_comparison import Identified, compare_text
    from motor_model.model_file import load, load_errors

    paths = (options.first, *options.others)
    print(compare_text([Identified(Path(path).stem, load(path), load_errors(path)) for path in paths]))
    return 0
