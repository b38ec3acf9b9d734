"""A serial port made of a pseudo-terminal, under a name that stays."""

import os
import select
import socket
import termios
import tty
from contextlib import suppress
from pathlib import Path

from motor_board.errors import BoardError

MOST_READ = 4096


class Port:
    """The board's end; a client opens `link` as it would open /dev/ttyACM0."""

    def __init__(self, link: Path) -> None:
        """Raises: BoardError: `link` cannot be made, or is somebody else's."""
        self._link = link
        self._master = -1
        self._name = ""
        self._connected = False
        self._empty = True  # nothing is left of an earlier client
        self._lock = socket.socket(socket.AF_UNIX)
        self._claim()

    @property
    def plugged(self) -> bool:
        """Whether there is a port."""
        return self._master >= 0

    def _claim(self) -> None:
        """Take the name: a link that a killed emulator left may be replaced, one in use or of another kind may not."""
        try:
            self._lock.bind(f"\0motor_board:{self._link.absolute()}")  # gone when the process is, however it ends
        except OSError as error:
            raise BoardError(
                f"{self._link} is the port of another emulator: set the parameter link to another path."
            ) from error
        target = os.readlink(self._link) if self._link.is_symlink() else ""
        if os.path.lexists(self._link) and not target.startswith("/dev/pts/"):
            raise BoardError(f"{self._link} exists and is no link to a port: set the parameter link to another path.")

    def plug(self) -> None:
        """Make the port.

        Raises:
            BoardError: the link cannot be made there.
        """
        master, slave = os.openpty()
        tty.setraw(slave)
        os.set_blocking(master, False)
        self._name = os.ttyname(slave)
        os.close(slave)  # so that a missing client shows as a hang-up
        self._master, self._connected = master, False
        made = self._link.with_name(f".{self._link.name}.{os.getpid()}")
        try:
            made.unlink(missing_ok=True)
            made.symlink_to(self._name)
            os.replace(made, self._link)
        except OSError as error:
            self.unplug()
            raise BoardError(
                f"cannot make {self._link} ({error.strerror}): set the parameter link to another path."
            ) from error

    def unplug(self) -> None:
        """Pull the plug: a client's next call fails, and the link is gone."""
        if self._master < 0:
            return
        with suppress(OSError):  # where the link may not be removed, it leads nowhere from now on
            self._link.unlink()
        os.close(self._master)
        self._master, self._connected = -1, False

    def opened(self) -> bool:
        """Whether a client has opened the port since the last call."""
        if self._master < 0:
            return False
        poll = select.poll()
        poll.register(self._master, select.POLLIN)
        gone = any(event & select.POLLHUP for _, event in poll.poll(0))
        if gone and not self._empty:
            self._forget()
        new = not gone and not self._connected
        self._connected = not gone
        self._empty = gone
        return new

    def _forget(self) -> None:
        """Empty the line of what the client that has gone did not read; only its own end can do that."""
        slave = os.open(self._name, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        termios.tcflush(slave, termios.TCIOFLUSH)
        os.close(slave)

    def read(self) -> bytes:
        """What the client has sent."""
        if not self._connected:
            return b""
        try:
            return os.read(self._master, MOST_READ)
        except BlockingIOError:
            return b""
        except OSError:  # the client has just closed
            self._connected = False
            return b""

    def write(self, data: bytes) -> None:
        """Send to the client; what a client that does not read leaves no room for is lost, as on a real line."""
        if not self._connected or not data:
            return
        try:
            os.write(self._master, data)
        except BlockingIOError:
            return
        except OSError:
            self._connected = False

    def close(self) -> None:
        """Pull the plug and give the name back."""
        self.unplug()
        self._lock.close()
