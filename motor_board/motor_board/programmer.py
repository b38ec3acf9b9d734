"""Puts the firmware onto a real board: which port, which bootloader, what avrdude is told."""

import fcntl
import glob
import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from motor_board.errors import BoardError

PORTS = ("/dev/ttyACM*", "/dev/ttyUSB*")


@dataclass(frozen=True)
class Kind:
    """A kind of Arduino, and how its bootloader is spoken to."""

    chip: str  # as the compiler calls it
    part: str  # as avrdude does
    protocol: str
    baud: int


KINDS = {
    "uno": Kind("atmega328p", "m328p", "arduino", 115200),
    "nano": Kind("atmega328p", "m328p", "arduino", 115200),
    "nano-old": Kind("atmega328p", "m328p", "arduino", 57600),
    "mega": Kind("atmega2560", "m2560", "wiring", 115200),
}


def ports() -> list[str]:
    """List the serial ports that look like boards."""
    return sorted(path for pattern in PORTS for path in glob.glob(pattern))


def the_port(asked: str | None) -> str:
    """Return the port to use.

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
    """Return what flashes the board."""
    kind = KINDS[board]
    told = {"-c": kind.protocol, "-p": kind.part, "-P": port, "-b": str(kind.baud)}
    return ["avrdude", "-q", *(word for pair in told.items() for word in pair), "-D", "-U", f"flash:w:{elf}:e"]


@contextmanager
def _alone(port: str) -> Iterator[None]:
    """Keep a port from every driver, as drivers do from each other; avrdude itself neither asks nor keeps anybody out.

    Raises:
        BoardError: somebody has it, or it cannot be opened.
    """
    try:
        opened = os.open(port, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    except OSError as error:
        raise BoardError(f"{port} cannot be opened ({error.strerror}): see who has it (fuser -v {port}).") from error
    try:
        fcntl.flock(opened, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield
    except BlockingIOError as error:
        raise BoardError(
            f"{port} is in use, as by a driver, whose commands would get in between: end that (fuser -v {port} names "
            "it), then flash."
        ) from error
    finally:
        os.close(opened)


def flash(elf: Path, port: str, board: str) -> None:
    """Run avrdude, with its output to the terminal.

    Raises:
        BoardError: it is missing or could not flash, or a driver has the port.
    """
    if shutil.which("avrdude") is None:
        raise BoardError("avrdude is not installed: sudo apt install avrdude")
    with _alone(port):
        done = subprocess.run(command(elf, port, board))
    if done.returncode != 0:
        raise BoardError(
            f"avrdude could not flash {port} (see above): stop what has it open; for a Nano, try --board nano-old."
        )
