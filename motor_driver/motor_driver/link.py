"""The serial port: read by a thread of its own, and opened again when it comes back. Nothing else touches it."""

import glob
import os
import select
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress

import serial
from serial.tools import list_ports

from motor_driver.link_events import Closed, Event, Opened, Received
from motor_driver.ports.port_error import FAILED, NODE, PortError, Wording, cannot_open
from motor_driver.ports.search import Search

LOOK_AGAIN = 0.1  # [s] for a port that is not there
SEARCH_AGAIN = 2.0  # [s] between two rounds through all ports
END = 0.5  # [s] that the thread may take to end
MOST_READ = 4096  # [byte] at once


def ports() -> str:
    """List the serial ports there are, in words."""
    found = [f"{port.device} ({port.description})" for port in list_ports.comports()]
    return f"the ports here are {', '.join(found)}" if found else "there is no serial port here at all"


def candidates(port: str, search: bool = False, wording: Wording = NODE) -> list[str]:
    """List the ports that may be opened: the one, or those of the pattern, that was asked for, or else those on USB.

    Raises:
        PortError: there is none, or there are several and nobody is to `search` them.
    """
    if port and not glob.has_magic(port):
        return [port]
    found = sorted(glob.glob(port) or (str(one.device) for one in list_ports.comports() if not port and one.vid))
    if not found:
        which = f"There is no port '{port}'" if port else "No board is plugged in"
        raise PortError(f"{which} ({ports()}): plug it in, or {wording.port}{wording.end}.")
    if len(found) > 1 and not search:
        raise PortError(
            f"There are several boards here: {wording.port} to one of {', '.join(found)}, or {wording.board_id}."
        )
    return found


def open_port(port: str, baud: int, wording: Wording = NODE) -> serial.Serial:
    """Open a port for ourselves alone.

    Raises:
        PortError: there is none, no permission, or it is in use.
    """
    try:
        opened = serial.Serial(port, baud, exclusive=True)
    except (OSError, ValueError) as error:  # SerialException is an OSError
        raise PortError(cannot_open(port, baud, getattr(error, "errno", None), ports(), wording)) from error
    with suppress(OSError, ValueError):  # an FTDI adapter then passes bytes on after 1 ms instead of 16; others cannot
        opened.set_low_latency_mode(True)
    return opened


class Link:
    """Keeps a port open. `wake` is called, in the link's thread, when there is something to `take`."""

    def __init__(self, port: str, baud: int, wake: Callable[[], None], search: bool = False) -> None:
        """`search`: without a port's name every one on USB may be it; `pass_over` says that the open one is not."""
        self._port, self._baud, self._wake = port, baud, wake
        self._search = Search() if search and (not port or glob.has_magic(port)) else None
        self._match = False  # what `pass_over` was told
        self._events: deque[Event] = deque()
        self._open: serial.Serial | None = None
        self._lock = threading.Lock()  # of `_open`, between writing and closing
        self._ended, self._passing = threading.Event(), threading.Event()
        self._end_read, self._end_write = os.pipe()
        self._thread = threading.Thread(target=self._run, name="serial", daemon=True)
        self._thread.start()

    @property
    def alive(self) -> bool:
        """Whether the port is still looked after."""
        return self._thread.is_alive()

    def pass_over(self, match: bool = False) -> None:
        """The open port is not the one that is searched for; or it may be (`match`), and the others are to be asked."""
        self._match = match
        if self._search and self._open is not None and not self._passing.is_set():
            self._passing.set()
            os.write(self._end_write, b"\0")

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
                self._use(*self._next())
                told = ""
            except Exception as error:  # whatever it is (termios.error is no OSError), the port is opened again
                why = str(error) if isinstance(error, PortError) else FAILED.format(f"{type(error).__name__}: {error}")
                if why != told:
                    told = why
                    self._tell(Closed(why))
                self._ended.wait(LOOK_AGAIN)

    def _next(self) -> tuple[str, bool]:
        """The port to try now, and whether its board is only to say its number; no port: look again soon.

        Raises:
            PortError: there is none, it is not clear which, or none or several have the number.
        """
        found = candidates(self._port, self._search is not None)
        if self._search is None:
            return found[0], False
        try:
            return self._search.next(found)
        except PortError:
            self._ended.wait(SEARCH_AGAIN)  # to open a port resets the board on it
            raise

    def _use(self, port: str, roll_call: bool) -> None:
        """Open a port and read until it is gone."""
        if not port:
            self._ended.wait(LOOK_AGAIN)
            return
        opened = self._opened(port)
        try:
            with self._lock:
                self._open = opened
            self._tell(Opened(port, time.monotonic_ns(), roll_call))
            self._read(opened.fileno())
        finally:
            with self._lock:
                self._open = None
                with suppress(OSError):  # a port that is gone may not even be closed
                    opened.close()
        if self._search and self._passing.is_set():
            self._passing.clear()
            self._search.hear(port, self._match and roll_call)
            self._tell(Closed(f"The board on {port} is not the one that is searched for.", passed=True))
        elif not self._ended.is_set():
            if self._search and not roll_call:
                self._search.is_lost(port)
            self._tell(Closed(f"The serial port {port} is gone: plug the board in again; retrying ({ports()})."))

    def _opened(self, port: str) -> serial.Serial:
        """The port, ours alone.

        Raises:
            PortError: it cannot be opened.
        """
        try:
            return open_port(port, self._baud)
        except PortError:
            if self._search:
                self._search.is_busy(port)
            raise

    def _read(self, descriptor: int) -> None:
        while not self._ended.is_set() and not self._passing.is_set():
            ready, _, _ = select.select([descriptor, self._end_read], [], [])
            if self._end_read in ready:
                os.read(self._end_read, MOST_READ)
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
