"""The serial port: read by a thread of its own, and opened again when it comes back. Nothing else touches it."""

import errno
import getpass
import os
import select
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import TypeAlias

import serial
from serial.tools import list_ports

from motor_model.errors import MotorError

LOOK_AGAIN = 0.1  # [s] for a port that is not there
END = 0.5  # [s] that the thread may take to end
MOST_READ = 4096  # [byte] at once


@dataclass(frozen=True, slots=True)
class Opened:
    """The port was opened."""

    port: str
    at: int  # [ns] time.monotonic_ns


@dataclass(frozen=True, slots=True)
class Received:
    """Bytes were read."""

    data: bytes
    at: int  # [ns]


@dataclass(frozen=True, slots=True)
class Closed:
    """The port is gone or cannot be opened; `why` is a sentence that names the cure."""

    why: str


Event: TypeAlias = Opened | Received | Closed


class PortError(MotorError):
    """A port that cannot be opened."""


def ports() -> str:
    """The serial ports there are, in words."""
    found = [f"{port.device} ({port.description})" for port in list_ports.comports()]
    return f"the ports here are {', '.join(found)}" if found else "there is no serial port here at all"


def chosen(port: str) -> str:
    """The port to open: the one that was asked for, or else the only one on USB.

    Raises:
        PortError: it is not clear which.
    """
    if port:
        return port
    found = [entry.device for entry in list_ports.comports() if entry.vid is not None]
    if len(found) == 1:
        return str(found[0])
    if found:
        raise PortError(f"there are several boards here: set the parameter port to one of {', '.join(sorted(found))}.")
    raise PortError(f"no board is plugged in ({ports()}): plug it in, or set the parameter port.")


def open_port(port: str, baud: int) -> serial.Serial:
    """Open a port for ourselves alone.

    Raises:
        PortError: there is none, no permission, or it is in use.
    """
    try:
        opened = serial.Serial(port, baud, exclusive=True)
    except (OSError, ValueError) as error:  # SerialException is an OSError
        raise PortError(_cure(port, baud, getattr(error, "errno", None))) from error
    with suppress(OSError, ValueError):  # an FTDI adapter then passes bytes on after 1 ms instead of 16; others cannot
        opened.set_low_latency_mode(True)
    return opened


def _cure(port: str, baud: int, number: int | None) -> str:
    in_use = f"{port} is in use: end the other program (another motor_driver, a serial monitor) that has opened it."
    cures = {
        errno.ENOENT: f"there is no {port}: plug the board in, or set the parameter port; {ports()}.",
        errno.EACCES: f"no permission for {port}: add yourself to the group dialout (sudo usermod -aG dialout "
        f"{_user()}), log out and in again.",
        errno.EAGAIN: in_use,
        errno.EBUSY: in_use,
    }
    other = f"{port} cannot be opened as a serial port with {baud} baud: set the parameters port and baud; {ports()}."
    return cures.get(number, other) if number is not None else other


def _user() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError):  # no such user, as in some containers
        return "$USER"


class Link:
    """Keeps a port open. `wake` is called, in the link's thread, when there is something to `take`."""

    def __init__(self, port: str, baud: int, wake: Callable[[], None]) -> None:
        self._port, self._baud, self._wake = port, baud, wake
        self._events: deque[Event] = deque()
        self._open: serial.Serial | None = None
        self._lock = threading.Lock()  # of `_open`, between writing and closing
        self._ended = threading.Event()
        self._end_read, self._end_write = os.pipe()
        self._thread = threading.Thread(target=self._run, name="serial", daemon=True)
        self._thread.start()

    def take(self) -> list[Event]:
        """What has happened since the last call."""
        return [self._events.popleft() for _ in range(len(self._events))]

    def write(self, data: bytes) -> None:
        """Send bytes now, or never: what a port that is gone or stuck does not take is lost, as on the line itself."""
        with self._lock, suppress(OSError):  # the reading thread finds out and says why
            if self._open is not None and data:
                os.write(self._open.fileno(), data)

    def close(self) -> None:
        """Close the port, within END seconds."""
        self._ended.set()
        os.write(self._end_write, b"\0")
        self._thread.join(END)

    def _run(self) -> None:
        told = ""
        while not self._ended.is_set():
            try:
                port = chosen(self._port)
                opened = open_port(port, self._baud)
            except PortError as error:
                if str(error) != told:
                    told = str(error)
                    self._tell(Closed(told))
                self._ended.wait(LOOK_AGAIN)
                continue
            told = ""
            self._use(port, opened)

    def _use(self, port: str, opened: serial.Serial) -> None:
        """Read until the port is gone."""
        with self._lock:
            self._open = opened
        self._tell(Opened(port, time.monotonic_ns()))
        self._read(opened.fileno())
        with self._lock:
            self._open = None
            with suppress(OSError):  # a port that is gone may not even be closed
                opened.close()
        if not self._ended.is_set():
            self._tell(Closed(f"{port} is gone: plug the board in again; {ports()}."))

    def _read(self, descriptor: int) -> None:
        while not self._ended.is_set():
            ready, _, _ = select.select([descriptor, self._end_read], [], [])
            if descriptor not in ready:
                continue
            try:
                data = os.read(descriptor, MOST_READ)
            except BlockingIOError:
                continue
            except OSError:
                return
            if not data:
                return
            self._tell(Received(data, time.monotonic_ns()))

    def _tell(self, event: Event) -> None:
        self._events.append(event)
        self._wake()
