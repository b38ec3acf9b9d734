"""`flash`: build the firmware and put it onto a board, or write it as a sketch for the Arduino IDE."""

import argparse
import sys
from pathlib import Path

from motor_board.build import BRIDGES, FirmwareConfig, firmware
from motor_board.programmer import KINDS, flash, the_port
from motor_board.sketch import write_sketch
from motor_model.errors import MotorError
from motor_ros.command.parser import CommandParser


def parser() -> argparse.ArgumentParser:
    """Make the command line's parser."""
    parser = CommandParser(
        "motor_board",
        "flash",
        "Build the firmware and flash it onto an Arduino Uno, Nano or Mega 2560.",
        "example:\n  ros2 run motor_board flash --board nano --bridge tb6612 --channels 2",
    )
    parser.add_argument("--port", metavar="PORT", help="the board's serial port (default: the only one there is)")
    parser.add_argument("--board", choices=list(KINDS), default="uno", help="default uno; nano-old: its old bootloader")
    parser.add_argument("--bridge", choices=list(BRIDGES), default="l298n", help="default l298n")
    parser.add_argument("--board-id", type=int, default=0, metavar="N", help="which of several boards, default 0")
    parser.add_argument(
        "--edges-per-revolution",
        type=int,
        default=0,
        metavar="N",
        help="of one polarity; default 0: not known to the board",
    )
    parser.add_argument("--channels", type=int, choices=(1, 2), default=1, help="of the encoder, default 1")
    parser.add_argument(
        "--supply-full-scale",
        type=int,
        default=0,
        metavar="MV",
        help="motor supply [mV] that puts 5 V on A0 through the divider; default 0: not measured",
    )
    parser.add_argument(
        "--current-sense", action="store_true", help="A1 has a voltage that follows the motor's current"
    )
    parser.add_argument("--build", action="store_true", help="only build, and say where the ELF file is")
    parser.add_argument("--sketch", type=Path, metavar="DIR", help="only write a sketch folder for the Arduino IDE")
    return parser


def main(args: list[str] | None = None) -> int:
    """`ros2 run motor_board flash`."""
    options = parser().parse_args(args)
    config = FirmwareConfig(
        options.bridge,
        options.board_id,
        options.edges_per_revolution,
        options.channels,
        options.supply_full_scale,
        options.current_sense,
        KINDS[options.board].chip,
    )
    try:
        if options.sketch is not None:
            print(write_sketch(options.sketch, config))
        elif options.build:
            print(firmware(config))
        else:
            flash(firmware(config), the_port(options.port), options.board)
    except MotorError as error:
        print(error, file=sys.stderr)
        return 1
    return 0
