"""The options of `check`, and the settings they make."""

import argparse
import sys
from pathlib import Path

from motor_driver.check.settings import Settings
from motor_driver.frames.codes import BAUD, Decay
from motor_driver.parameters import MOST_ID
from motor_model.errors import MotorError
from motor_model.gearing.gear import parse_gear_ratio
from motor_ros.command.number_types import between, positive, whole_between
from motor_ros.command.parser import CommandParser
from motor_ros.output_files import add_force_option


def parser() -> argparse.ArgumentParser:
    """Make the command line's parser."""
    made = CommandParser(
        "motor_driver",
        "check",
        "Check a new board step by step: supply, encoder, a little voltage both ways. Says what is wired wrong, and "
        "writes the driver's parameter file if all is right. The driver must not run at the same time.",
        "example:\n  ros2 run motor_driver check --max-voltage 12 --edges-per-revolution 96 --output motor.yaml",
    )
    _add_port(made)
    _add_motor(made)
    _add_person(made)
    made.add_argument("--name", default="", help="of the motor, for the parameter file (default: left out)")
    made.add_argument("--output", type=Path, metavar="FILE", help="write the driver's parameters here, if all is right")
    made.add_argument("--json", type=Path, metavar="FILE", help="write all that was found here")
    add_force_option(made)
    return made


def settings_of(options: argparse.Namespace) -> Settings:
    """Return the settings of the run.

    Raises:
        MotorError: two options contradict each other.
    """
    pulses = options.pulses_per_revolution or options.edges_per_revolution
    if options.pulses_per_revolution and options.edges_per_revolution not in (None, pulses):
        raise MotorError("--pulses-per-revolution and --edges-per-revolution are the same thing here: say one of them.")
    return Settings(
        max_voltage=options.max_voltage,
        supply_voltage=options.supply_voltage,
        edges_per_revolution=pulses,
        quadrature=options.quadrature,
        gear=parse_gear_ratio(options.gear_ratio),
        gear_said=options.gear_ratio.strip(),
        single_channel=None if options.channels is None else options.channels == 1,
        board_id=options.board_id,
        current_gain=options.current_gain,
        current_offset=options.current_offset,
        hand=not options.no_hand and sys.stdin.isatty(),
        turns=options.turns,
        hand_time=options.time_limit,
    )


def _add_port(parser: argparse.ArgumentParser) -> None:
    """The board and where it is."""
    add = parser.add_argument
    add("--port", default="", metavar="PORT", help="the board's serial port (default: the only one on USB)")
    add("--board-id", type=whole_between(0, MOST_ID), metavar="N", help="number the board was flashed with")
    add("--baud", type=whole_between(9600, 4_000_000), default=BAUD, metavar="N", help=f"default {BAUD}")


def _add_motor(parser: argparse.ArgumentParser) -> None:
    """What a person says of motor, supply, encoder and bridge."""
    add = parser.add_argument
    add("--max-voltage", type=between(0.1, 100.0), default=12.0, metavar="V", help="of the motor (default 12)")
    add("--supply-voltage", type=between(0.0, 100.0), default=0.0, metavar="V", help="default: as --max-voltage")
    add(
        "--edges-per-revolution",
        type=whole_between(1, 100_000),
        metavar="N",
        help="encoder edges of one polarity per turn (default: as flashed)",
    )
    add(
        "--pulses-per-revolution",
        type=whole_between(1, 65535),
        metavar="N",
        help="periods of one channel per turn of the encoder's shaft (the same as edges of one polarity)",
    )
    add("--quadrature", type=int, choices=(1, 2, 4), default=1, help="with which the driver is to count (default 1)")
    add("--gear-ratio", default="1", metavar="R", help="encoder turns per turn of the output: 34.014, 9291/273")
    add("--channels", type=int, choices=(1, 2), help="of the encoder (default: as flashed)")
    add("--silent-pwm", action="store_true", help="PWM above hearing")
    add("--decay", choices=[decay.name.lower() for decay in Decay], default="brake", help="default brake")
    add("--current-gain", type=between(-10.0, 10.0), default=0.0, metavar="V/A", help="of a current sensor on A1")
    add("--current-offset", type=between(0.0, 5.0), default=2.5, metavar="V", help="of it (default 2.5)")


def _add_person(parser: argparse.ArgumentParser) -> None:
    """Who is there to turn the shaft and to answer."""
    add = parser.add_argument
    add("--turns", type=whole_between(1, 100), default=1, metavar="N", help="to turn the shaft by hand (default 1)")
    add("--time-limit", type=positive, default=30.0, metavar="S", help="for an answer (default 30)")
    add("--no-hand", action="store_true", help="nobody is there to turn the shaft or to answer")
