"""Makes bags from other people's CSV logs: `import_csv FILE --output BAG --time COL --voltage COL --speed COL …`."""

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING

from motor_identification.logs.csv_form import UNITS, CsvForm, Kind
from motor_ros.command import CommandParser, positive, shell
from motor_ros.output_files import add_force_option

if TYPE_CHECKING:
    from motor_identification.bag import BagWriter
    from motor_identification.logs import Run
    from motor_model.sample import Info

EXAMPLES = """\
speeds, each the mean over the 20 ms before its row:
  import_csv log.csv --output log --time t --voltage u --speed y --unit deg/s --speed-window 0.02
positions of an encoder of 360 counts, steps of several duties (of 7.4 V) from rest, a bag for each:
  import_csv steps.csv --output steps --time t_s --voltage duty_pct --voltage-scale 0.074 \\
    --position pos_deg --unit deg --split duty_pct --rest-until 0
a static curve, without time:
  import_csv static.csv --output static --steady --voltage u --speed y --unit deg/s
"""
_SINCE_1970 = 10**18  # [ns] the year 2001: a log whose times are later counts from 1970


def main(args: list[str] | None = None) -> int:
    """Entry point; returns the exit status."""
    options = parser().parse_args(args)
    form = _form(parser(), options)
    return shell(lambda: _import(options.file, form, options.output, options.force))


def parser() -> argparse.ArgumentParser:
    """The command line."""
    parser = CommandParser(
        "motor_identification",
        "import_csv",
        "Make a bag from a CSV log of a motor, for identify and diagnose. Its first line names columns.",
        EXAMPLES,
    )
    add = parser.add_argument
    add("file", type=Path, help="the CSV file: commas, semicolons or tabs between columns")
    add("--output", type=Path, required=True, metavar="BAG", help="where the bag goes; must not exist")
    rows = parser.add_mutually_exclusive_group(required=True)
    rows.add_argument("--time", metavar="COL", help="column of times [s]")
    rows.add_argument(
        "--steady", action="store_true", help="no time column: every row is a steady state, such as a static curve"
    )
    add(
        "--voltage",
        required=True,
        metavar="COL",
        help="column of voltages, or of what --voltage-scale converts to volts",
    )
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument("--speed", metavar="COL", help="column of speeds")
    kind.add_argument("--position", metavar="COL", help="column of positions, which do not wrap after a turn")
    kind.add_argument("--count", metavar="COL", help="column of encoder counts, with a sign")
    add(
        "--split",
        metavar="COL",
        help="a bag BAG_VALUE for every run of one value of this column; time may start again there",
    )
    add("--name", default="motor", help="the motor's name in the bag (default: motor)")
    add_force_option(parser)
    _add_meaning(parser)
    return parser


def _add_meaning(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument_group("what the columns mean").add_argument
    units = sorted({unit for units in UNITS.values() for unit in units})
    add("--unit", choices=units, help="of speeds or positions (default: rad/s for --speed, rad for --position)")
    add(
        "--voltage-scale", type=float, default=1.0, metavar="V", help="volts per unit of the voltage column (default 1)"
    )
    add(
        "--voltage-before",
        action="store_true",
        help="a row's voltage was applied until its time (default: from its time until the next row), as where a "
        "controller logs what it did before it reads the encoder",
    )
    add("--max-voltage", type=positive, metavar="V", help="voltage at full duty (default: the largest in the log)")
    add("--edges-per-revolution", type=int, metavar="N", help="counts of a turn of the shaft that the log is about")
    add("--count-quantum", type=positive, metavar="Q", help="size of one count in --unit (default: a turn / N)")
    add("--speed-window", type=positive, metavar="S", help="[s] what a speed is the mean over (default: sample period)")
    add(
        "--speed-lag",
        type=float,
        metavar="S",
        help="[s] age of that window's middle at the row's time (default: half of it)",
    )
    add(
        "--rest-until",
        type=float,
        metavar="S",
        help="the motor stood until this time [s] of the column, when the first row's voltage came (such as 0, where "
        "the rows begin a little later)",
    )


def _form(parser: argparse.ArgumentParser, options: argparse.Namespace) -> CsvForm:
    """The options as a form; what does not go together is a usage error."""
    kind = next(kind for kind in Kind if getattr(options, kind.value) is not None)
    unit = options.unit or next(iter(UNITS[kind]))
    if unit not in UNITS[kind]:
        parser.error(f"--unit {unit} does not go with --{kind.value}: take one of {', '.join(UNITS[kind])}")
    if kind is not Kind.SPEED and (options.speed_window or options.speed_lag is not None):
        parser.error("--speed-window and --speed-lag go with --speed only")
    if options.steady and (kind is not Kind.SPEED or options.speed_lag is not None or options.voltage_before):
        parser.error("--steady goes with --speed, and without --speed-lag and --voltage-before")
    if options.rest_until is not None and (options.steady or not math.isfinite(options.rest_until)):
        parser.error("--rest-until takes a time of the --time column")
    if options.edges_per_revolution is not None and options.edges_per_revolution < 1:
        parser.error("--edges-per-revolution takes a whole number above 0")
    if kind is not Kind.SPEED and unit == "count" and options.edges_per_revolution is None:
        parser.error("counts have a size only with --edges-per-revolution")
    if not math.isfinite(options.voltage_scale) or options.voltage_scale == 0.0:
        parser.error("--voltage-scale takes a number other than 0")
    same = (
        "voltage_scale",
        "edges_per_revolution",
        "count_quantum",
        "speed_window",
        "speed_lag",
        "split",
        "max_voltage",
        "rest_until",
        "voltage_before",
    )
    return CsvForm(
        time=options.time,
        voltage=options.voltage,
        motion=getattr(options, kind.value),
        kind=kind,
        unit=unit,
        name=options.name,
        **{name: getattr(options, name) for name in same},
    )


def _import(file: Path, form: CsvForm, output: Path, force: bool) -> int:
    from motor_identification.logs import read_log

    log = read_log(file, form)  # all of it, before anything is written
    paths = [output.with_name(f"{output.name}_{run.label}") if form.split else output for run in log.runs]
    write_bags(dict(zip(paths, log.runs, strict=True)), log.info, _offset(file, log.runs[0]), force)
    print(*log.findings, sep="\n")
    for path, run in zip(paths, log.runs, strict=True):
        print(f"{path}: {len(run.samples)} samples, {run.duration:.2f} s")
    return 0


def write_bags(runs: "dict[Path, Run]", info: "Info", offset: int, force: bool = False) -> None:
    """One bag a run, or none at all.

    Raises:
        RecordingError: a path exists already, or cannot be written.
    """
    from motor_identification.bag import BagWriter
    from motor_model.errors import MotorError

    writers: list[BagWriter] = []
    try:
        writers.extend(BagWriter(path, force) for path in runs)
        for writer, run in zip(writers, runs.values(), strict=True):
            _write(writer, run, info, offset)
            writer.close()
    except (MotorError, KeyboardInterrupt):
        for writer in writers:
            writer.discard()
        raise


def _offset(file: Path, first: "Run") -> int:
    """[ns] from the log's clock to ROS time: the file's date, where the log itself does not count from 1970."""
    return 0 if first.samples[0].sample_time > _SINCE_1970 else file.stat().st_mtime_ns


def _write(writer: "BagWriter", run: "Run", info: "Info", offset: int, force: bool = False) -> None:
    from rclpy.serialization import serialize_message

    from motor_identification.live.qos_profiles import offered
    from motor_ros import qos
    from motor_ros.messages import info_message, speed_message, time_message, voltage_message

    latched = writer.topic("/motor/info", "motor_msgs/msg/MotorInfo", offered(qos.INFO))
    speed = writer.topic("/motor/speed", "motor_msgs/msg/MotorSpeed", offered(qos.SPEED))
    voltage = writer.topic("/motor/voltage", "motor_msgs/msg/MotorVoltage", offered(qos.VOLTAGE))
    start = offset + run.samples[0].sample_time
    writer.write(latched, start, serialize_message(info_message(info, time_message(start))))
    for sample in run.samples:
        now = offset + sample.sample_time
        stamp = time_message(now)
        writer.write(voltage, now, serialize_message(voltage_message(sample.voltage, stamp, info.name)))
        writer.write(speed, now, serialize_message(speed_message(sample, stamp, info.name)))
