"""Makes bags from other people's CSV logs: `import_csv FILE --output BAG`; columns that no name tells are options."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from motor_identification.cli.import_log import run
from motor_identification.cli.options.log import add_log_options
from motor_ros.command.parser import CommandParser

if TYPE_CHECKING:
    from motor_identification.logs.columns.said import Said
    from motor_identification.logs.imported import Imported

EXAMPLES = """\
columns by their names, units by the encoder's steps; what was guessed is said:
  ros2 run motor_identification import_csv log.csv --output log
speeds, each the mean over the 20 ms before its row:
  ros2 run motor_identification import_csv log.csv --output log --time t --voltage u --speed y --unit deg/s \\
    --speed-window 0.02
positions of an encoder of 360 counts, steps of several duties (of 7.4 V) from rest, a bag for each:
  ros2 run motor_identification import_csv steps.csv --output steps --time t_s --voltage duty_pct \\
    --voltage-scale 0.074 --position pos_deg --unit deg --split duty_pct --rest-until 0
a static curve, without time:
  ros2 run motor_identification import_csv static.csv --output static --steady --voltage u --speed y --unit deg/s
"""


def main(args: list[str] | None = None) -> int:
    """Entry point; returns the exit status."""
    return run(parser(), args, _read)


def parser() -> argparse.ArgumentParser:
    """Make the command line's parser."""
    made = CommandParser(
        "motor_identification",
        "import_csv",
        "Make a bag from a CSV log of a motor, for identify and diagnose: commas, semicolons, tabs or blanks between "
        "columns. `import_log` reads other formats too.",
        EXAMPLES,
    )
    add_log_options(made)
    return made


def _read(file: Path, said: "Said") -> "Imported":
    from motor_identification.logs.csv.reader import read_table
    from motor_identification.logs.formats.source import Source
    from motor_identification.logs.imported import import_source

    return import_source(Source(read_table(file), "text table"), said)
