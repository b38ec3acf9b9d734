"""What a user says with the options of the commands that import logs, and what of it does not go together."""

import argparse

from motor_identification.logs.columns.said import Pair, Said
from motor_identification.logs.form import UNITS, Kind


def read_log_options(parser: argparse.ArgumentParser, options: argparse.Namespace) -> Said:
    """The options as what a user said; what does not go together is a usage error."""
    kind = next((kind for kind in Kind if getattr(options, kind.value) is not None), None)
    motion = getattr(options, kind.value) if kind else None
    if kind and options.unit and options.unit not in UNITS[kind]:
        parser.error(f"--unit {options.unit} does not go with --{kind.value}: take one of {', '.join(UNITS[kind])}")
    if kind not in (None, Kind.SPEED) and (options.speed_window or options.speed_lag is not None):
        parser.error("--speed-window and --speed-lag go with --speed only")
    if options.steady and (
        kind not in (None, Kind.SPEED) or options.speed_lag is not None or options.voltage_before is not None
    ):
        parser.error("--steady goes with --speed, and without --speed-lag and --voltage-before")
    if options.steady and options.rest_until is not None:
        parser.error("--rest-until takes a time of the --time column")
    if "count" in (kind.value if kind else "", options.unit) and options.edges_per_revolution is None:
        parser.error("counts have a size only with --edges-per-revolution")
    if options.sample_period and options.time_unit:
        parser.error("--sample-period is in seconds, and takes no --time-unit")
    _check_drive(parser, options)
    if not options.output and not options.dry_run:
        parser.error("say where the bag goes (--output BAG), or --dry-run")
    same = set(Said.__dataclass_fields__) - {"motion", "kind", "motors"}
    pairs = tuple(_pair(parser, text) for text in options.motor)
    if len({pair.label for pair in pairs}) < len(pairs):
        parser.error("every --motor needs a NAME of its own")
    return Said(motion=motion, kind=kind, motors=pairs, **{name: getattr(options, name) for name in same})


def _check_drive(parser: argparse.ArgumentParser, options: argparse.Namespace) -> None:
    """Refuse what does not go together of how a column of voltages or duties is to be read."""
    if options.voltage_scale and (options.full_duty or options.supply or options.supply_voltage):
        parser.error("--voltage-scale does not go with --full-duty, --supply and --supply-voltage")
    if options.neutral and (options.voltage_scale or options.motor):
        parser.error("--neutral is of one column of duties: it does not go with --voltage-scale and --motor")
    of_columns = ("voltage_scale", "full_duty", "neutral", "supply", "supply_voltage", "direction")
    said = options.motor or options.steady or any(getattr(options, name) is not None for name in of_columns)
    if options.constant_voltage is not None and said:
        parser.error("--constant-voltage is in volts, of one motor in motion: leave out --motor, --steady and duties")


def _pair(parser: argparse.ArgumentParser, text: str) -> Pair:
    label, colon, columns = text.partition(":")
    voltage, comma, motion = columns.partition(",")
    if not (colon and comma and label and voltage and motion) or not label.replace("_", "").isalnum():
        parser.error(f"--motor takes NAME:VOLTAGE_COLUMN,MOTION_COLUMN, and not {text!r}")
    return Pair(label, voltage.strip(), motion.strip())
