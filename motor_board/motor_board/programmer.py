"""Puts the firmware onto a real board: which port, which bootloader, what avrdude is told."""

import glob
import os
import shutil
import subprocess
from pathlib import Path

from motor_board.errors import BoardError

BAUD = {"uno": 115200, "nano": 115200, "nano-old": 57600}  # of the boards' bootloaders
PORTS = ("/dev/ttyACM*", "/dev/ttyUSB*")


def ports() -> list[str]:
    """The serial ports that look like boards."""
    return sorted(path for pattern in PORTS for path in glob.glob(pattern))


def the_port(asked: str | None) -> str:
    """The port to use.

    Raises:
        BoardError: there is none, several and none was asked for, or no permission for it.
    """
    found = ports()
    if asked is None and len(found) != 1:
        listed = ", ".join(found)
        raise BoardError(
            f"say which port the board is on with --port: {listed}."
            if found
            else "no board is plugged in (no /dev/ttyACM* or /dev/ttyUSB*): try another USB cable, some only charge."
        )
    port = asked or found[0]
    if not os.path.exists(port):
        raise BoardError(f"there is no {port}; the ports here: {', '.join(found) or 'none'}.")
    if not os.access(port, os.R_OK | os.W_OK):
        raise BoardError(f"no permission for {port}: run 'sudo usermod -aG dialout $USER', log out and in again.")
    return port


def command(elf: Path, port: str, board: str) -> list[str]:
    """What flashes the board."""
    return [
        "avrdude",
        "-q",
        "-c",
        "arduino",
        "-p",
        "m328p",
        "-P",
        port,
        "-b",
        str(BAUD[board]),
        "-D",
        "-U",
        f"flash:w:{elf}:e",
    ]


def flash(elf: Path, port: str, board: str) -> None:
    """Run avrdude, with its output to the terminal.

    Raises:
        BoardError: it is missing or could not flash.
    """
    if shutil.which("avrdude") is None:
        raise BoardError("avrdude is not installed: sudo apt install avrdude")
    if subprocess.run(command(elf, port, board)).returncode != 0:
        raise BoardError(
            f"avrdude could not flash {port} (see above): stop what has it open; for a Nano, try --board nano-old."
        )
