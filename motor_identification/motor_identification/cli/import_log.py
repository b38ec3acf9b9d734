"""Makes bags from other people's logs, whatever format they have: `import_log FILE --output BAG`."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from motor_identification.cli.options.log import add_log_options
from motor_identification.cli.options.log_said import read_log_options
from motor_ros.command.parser import CommandParser
from motor_ros.command.shell import shell

if TYPE_CHECKING:
    from motor_identification.logs.columns.said import Said
    from motor_identification.logs.imported import Imported

EXAMPLES = """\
what is in it, and what could be identified from it:
  ros2 run motor_identification import_log log.csv --dry-run
a duty of -255 to 255 of a 7.4 V battery, speeds whose unit no name tells:
  ros2 run motor_identification import_log log.csv --output log --supply-voltage 7.4 --unit rpm
two motors in one file, a bag for each:
  ros2 run motor_identification import_log log.csv --output robot --motor left:lc,ls --motor right:rc,rs
SysId's own log of a drivetrain, a bag for every test and side:
  ros2 run motor_identification import_log drivetrain_sysid.json --output drivetrain
"""


def main(args: list[str] | None = None) -> int:
    """Entry point; returns the exit status."""
    return run(parser(), args)


def run(
    parser: argparse.ArgumentParser,
    args: list[str] | None,
    read: "Callable[[Path, Said], Imported] | None" = None,
) -> int:
    """Parse, read and write; returns the exit status."""
    options = parser.parse_args(args)
    said = read_log_options(parser, options)

    def work() -> int:
        from motor_identification.cli._log_bags import run_import
        from motor_identification.logs.imported import import_log

        imported = (read or import_log)(options.file, said)  # all of it, before anything is written
        return run_import(options.file, imported, None if options.dry_run else options.output, options.force)

    return shell(work)


def parser() -> argparse.ArgumentParser:
    """Make the command line's parser."""
    made = CommandParser(
        "motor_identification",
        "import_log",
        "Make a bag from a motor's log, for identify and diagnose: CSV and other text, Excel, JSON, WPILOG, MATLAB.",
        EXAMPLES,
    )
    add_log_options(made)
    return made
