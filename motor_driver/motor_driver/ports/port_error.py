"""What is wrong with a serial port, as a sentence with its cure."""

import errno
import getpass
from dataclasses import dataclass

from motor_model.errors import MotorError

FAILED = "The serial port has failed ({}): see the cable, or end what else uses the port; retrying."


class PortError(MotorError):
    """A port that cannot be opened, or no single one with the board."""


@dataclass(frozen=True)
class Wording:
    """How whoever reads a sentence says a port, and whether it is tried again."""

    port: str
    port_and_baud: str
    board_id: str
    end: str


NODE = Wording("set the parameter port", "set the parameters port and baud", "board_id", "; retrying")
COMMAND = Wording("set --port", "set --port and --baud", "--board-id", "")


def cannot_open(port: str, baud: int, number: int | None, ports: str, wording: Wording = NODE) -> str:
    """Why a port cannot be opened, by the system's error number, and what to do; `ports`: those there are, in words."""
    in_use = "it is in use: end the other program that has opened it (another motor_driver, a serial monitor)"
    cures = {
        errno.ENOENT: f"there is none: plug the board in, or {wording.port} ({ports})",
        errno.EACCES: f"no permission: add yourself to the group dialout (sudo usermod -aG dialout {_user()}), "
        "log out and in again",
        errno.EAGAIN: in_use,
        errno.EBUSY: in_use,
    }
    other = f"it is no serial port that can do {baud} baud: {wording.port_and_baud} ({ports})"
    return f"Cannot open serial port '{port}', {cures.get(number or 0, other)}{wording.end}."


def _user() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError):  # no such user, as in some containers
        return "$USER"
