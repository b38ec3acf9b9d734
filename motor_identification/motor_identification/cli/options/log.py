"""The options of the commands that import logs."""

import argparse
from collections.abc import Callable
from contextlib import suppress
from fractions import Fraction
from pathlib import Path

from motor_identification.logs.count_size import MOST_EDGES
from motor_identification.logs.form import TIME_UNITS, UNITS
from motor_model.errors import MotorError
from motor_model.gearing.gear import parse_gear_ratio
from motor_model.sample import RANGES
from motor_ros.command.number_types import between, positive, whole_between
from motor_ros.output_files import add_force_option

SHORTEST_TICK, LONGEST_TICK = 1e-9, 3600.0  # [s] a nanosecond is as fine as times are kept


def add_log_options(parser: argparse.ArgumentParser) -> None:
    """Add all of them: none but `--output` is needed where names and numbers tell the rest."""
    add = parser.add_argument
    add("file", type=Path, help="the log")
    add("--output", type=Path, metavar="BAG", help="where the bag goes; must not exist")
    add("--dry-run", action="store_true", help="say what would be imported, and write nothing")
    add("--name", default="motor", help="the motor's name in the bag (default: motor)")
    add_force_option(parser)
    add("--sheet", metavar="NAME", help="sheet of a workbook (default: the one with the most numbers)")
    _add_columns(parser)
    _add_meaning(parser)


def _add_columns(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group(
        "which columns are read, by name or number (default: guessed from names and numbers)"
    )
    rows = group.add_mutually_exclusive_group()
    rows.add_argument("--time", metavar="COL", help="column of times")
    rows.add_argument(
        "--steady", action="store_true", help="every row is a steady state, such as those of a static curve"
    )
    rows.add_argument(
        "--sample-period",
        type=between(*RANGES["sample_period"]),
        metavar="S",
        help="rows are S seconds apart; the log has no times",
    )
    _add_drive_and_motion(group)


def _add_drive_and_motion(group: argparse._ArgumentGroup) -> None:
    """Add what drives, what moves, and what stands beside them."""
    drive = group.add_mutually_exclusive_group()
    drive.add_argument("--voltage", metavar="COL", help="column of voltages or duties")
    drive.add_argument(
        "--constant-voltage",
        type=between(-RANGES["max_voltage"][1], RANGES["max_voltage"][1]),
        metavar="V",
        help="a log of one step has no such column: V volts in every row",
    )
    kind = group.add_mutually_exclusive_group()
    kind.add_argument("--speed", metavar="COL", help="column of speeds")
    kind.add_argument("--position", metavar="COL", help="column of positions")
    kind.add_argument("--count", metavar="COL", help="column of encoder counts, with a sign")
    kind.add_argument(
        "--motor",
        action="append",
        default=[],
        metavar="NAME:COL,COL",
        help="a motor with its columns of voltage and motion, and a bag BAG_NAME; once for each",
    )
    group.add_argument(
        "--direction", metavar="COL", help="column that says which way a duty without a sign goes; -: none"
    )
    group.add_argument("--supply", metavar="COL", help="column of the supply's voltage, for duties")
    group.add_argument(
        "--split",
        metavar="COL",
        help="a bag BAG_VALUE for every run of one value of this column; time may start again there",
    )


def _time_unit(text: str) -> str:
    """A unit of times, or a number of seconds, as an argparse type."""
    if text in TIME_UNITS:
        return text
    with suppress(ValueError):
        if SHORTEST_TICK <= float(text) <= LONGEST_TICK:
            return repr(float(text))
    raise argparse.ArgumentTypeError(f"{text} is none of {', '.join(TIME_UNITS)}, and no seconds a tick, 1e-9 to 3600")


def _add_meaning(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument_group("what the columns mean").add_argument
    units = sorted({unit for units in UNITS.values() for unit in units})
    add(
        "--time-unit",
        type=_time_unit,
        metavar="{" + ",".join(TIME_UNITS) + ",S}",
        help="of the times; S: seconds a tick of some timer (default: by name, or by how often rows come)",
    )
    add("--unit", choices=units, help="of speeds or positions (default: by name, or by the encoder's steps)")
    add("--voltage-scale", type=_scale, metavar="V", help="volts per unit of the voltage column (default 1)")
    add("--full-duty", type=positive, metavar="D", help="the voltage column holds duties: this one is full duty")
    add(
        "--neutral",
        type=positive,
        metavar="N",
        help="what the voltage column shows at 0 V, where that is not 0: 1500 or 1000 of an ESC's pulses, 127 of a "
        "bridge that turns back below half; full voltage is --full-duty from there (default of pulses: at 2000 µs)",
    )
    add("--supply-voltage", type=positive, metavar="V", help="voltage at full duty")
    _add_row_timing(add)
    add(
        "--max-voltage",
        type=positive,
        metavar="V",
        help="voltage at full duty (default: the largest in the log, or the supply column's median if that is more)",
    )
    _add_counts(add)
    _add_speed_timing(add)


def _add_row_timing(add: Callable[..., object]) -> None:
    """When a row's voltage was applied, and when rows were made."""
    add(
        "--voltage-before",
        action=argparse.BooleanOptionalAction,
        help="a row's voltage was applied until its time, as where a controller logs what it did before it reads the "
        "encoder, or from its time until the next row (default: from then on, unless the row's motion answers it)",
    )
    add(
        "--even-clock",
        action=argparse.BooleanOptionalAction,
        help="rows came by an even clock, whatever their stamps say, or at their stamps (default: as the motion fits)",
    )
    add(
        "--nominal-period",
        action=argparse.BooleanOptionalAction,
        help="speeds were computed with the period that rows should have had, not with their own (default: as the "
        "motion fits)",
    )


def _add_speed_timing(add: Callable[..., object]) -> None:
    """What a speed is the mean over, and when the motor began to move."""
    add("--speed-window", type=positive, metavar="S", help="[s] what a speed is the mean over (default: sample period)")
    add(
        "--speed-lag",
        type=between(-1e3, 1e3),
        metavar="S",
        help="[s] age of that window's middle at the row's time (default: half of it)",
    )
    add(
        "--rest-until",
        type=between(-1e18, 1e18),
        metavar="S",
        help="the motor stood until this time [s] of the column, when the first row's voltage came (such as 0, where "
        "the rows begin a little later)",
    )


def _add_counts(add: Callable[..., object]) -> None:
    """Counts, and the angle that one of them stands for."""
    add(
        "--increments",
        action=argparse.BooleanOptionalAction,
        help="the counts of a row are those since the row before (default: by name and numbers)",
    )
    edges = whole_between(1, MOST_EDGES)
    add("--edges-per-revolution", type=edges, metavar="N", help="counts of a turn of the encoder's shaft")
    add(
        "--gear-ratio",
        type=_gear,
        dest="gear",
        default=Fraction(1),
        metavar="R",
        help="turns of the encoder's shaft, whose edges those are, per turn of the output: 34.014, 9291/273",
    )
    add("--count-quantum", type=positive, metavar="Q", help="size of one count in --unit (default: a turn / N)")
    add("--units-per-revolution", type=positive, metavar="U", help="how many m (or whatever stands there) a turn goes")
    add("--wrap", type=positive, metavar="R", help="positions begin again after this much (default: seen in them)")


def _gear(text: str) -> Fraction:
    try:
        return parse_gear_ratio(text)
    except MotorError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def _scale(text: str) -> float:
    number = between(-1e9, 1e9)(text)
    if number == 0.0:
        raise argparse.ArgumentTypeError("0 V per unit is no voltage")
    return number
