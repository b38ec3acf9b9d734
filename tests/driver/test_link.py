"""The serial port: what is wrong is said with its cure, and it comes back by itself."""

import errno
import os
import pty
import termios
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest
import serial
from patience import PATIENCE

from motor_board.emulation.port import Port
from motor_driver import link
from motor_driver.link import Link, PortError, candidates, open_port
from motor_driver.link_events import Closed, Event, Opened, Received
from motor_driver.ports.port_error import COMMAND


class Listener:
    """Collects a link's events, and waits for one."""

    def __init__(self, path: Path) -> None:
        self.events: list[Event] = []
        self._told = threading.Event()
        self.link = Link(str(path) if path.name else "", 500_000, self._told.set, search=True)

    def wait(self, condition: Callable[[], bool], what: str) -> None:
        end = time.monotonic() + PATIENCE
        while not condition():
            assert self._told.wait(end - time.monotonic()), f"still waiting for {what}"
            self._told.clear()
            self.events += self.link.take()

    def wait_for(self, kind: type, count: int = 1) -> list[Event]:
        def found() -> list[Event]:
            return [event for event in self.events if isinstance(event, kind)]

        self.wait(lambda: len(found()) >= count, kind.__name__)
        return found()


@pytest.fixture
def port(tmp_path: Path) -> Iterator[Port]:
    port = Port(tmp_path / "port")
    yield port
    port.close()


@pytest.fixture
def listener(tmp_path: Path) -> Iterator[Listener]:
    listener = Listener(tmp_path / "port")
    yield listener
    listener.link.close()


def read(port: Port, count: int) -> bytes:
    """What a client has written."""
    data, end = b"", time.monotonic() + PATIENCE
    while len(data) < count:
        assert time.monotonic() < end
        port.opened()
        data += port.read()
        time.sleep(0.001)
    return data


def test_waits_for_a_port_reads_writes_and_comes_back(port: Port, listener: Listener, tmp_path: Path) -> None:
    (missing,) = listener.wait_for(Closed)
    assert isinstance(missing, Closed)
    assert missing.why.startswith(f"Cannot open serial port '{tmp_path / 'port'}', there is none: plug the board in")
    assert missing.why.endswith("retrying.")
    for count in (1, 2):
        port.plug()
        listener.wait_for(Opened, count)
        before = time.monotonic_ns()
        listener.link.write(b"hello")
        assert read(port, 5) == b"hello"
        listener.events.clear()
        port.write(b"back")
        listener.wait(lambda: b"".join(e.data for e in listener.events if isinstance(e, Received)) == b"back", "bytes")
        assert all(before < e.at < time.monotonic_ns() for e in listener.events if isinstance(e, Received))
        port.unplug()
        assert "is gone: plug the board in again" in str(listener.wait_for(Closed)[0])
        listener.link.write(b"nobody hears this")
        listener.events = [Opened("", 0)] * count


def test_ends_within_half_a_second_and_frees_the_port(port: Port, listener: Listener, tmp_path: Path) -> None:
    port.plug()
    listener.wait_for(Opened)
    listener.link.close()
    assert not listener.link._thread.is_alive()  # close waits for no more than that
    assert link.END == 0.5
    open_port(str(tmp_path / "port"), 500_000).close()


def test_a_port_in_use_is_refused(port: Port, listener: Listener, tmp_path: Path) -> None:
    port.plug()
    listener.wait_for(Opened)
    with pytest.raises(PortError, match=r"port', it is in use: end the other program that has opened it \(another"):
        open_port(str(tmp_path / "port"), 500_000)


def test_a_stuck_port_does_not_hold_up_the_writer(listener: Listener, port: Port) -> None:
    port.plug()
    listener.wait_for(Opened)
    for _ in range(100):
        listener.link.write(bytes(4096))  # nobody reads: what does not fit is lost
    port.unplug()
    listener.wait_for(Closed)


def test_no_serial_port_and_no_permission(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(PortError, match="file', it is no serial port that can do 500000 baud"):
        open_port(str(tmp_path / "file"), 500_000)

    def refuse(*_: object, **__: object) -> None:
        raise serial.SerialException(errno.EACCES, "Permission denied")

    monkeypatch.setattr(serial, "Serial", refuse)
    monkeypatch.setenv("LOGNAME", "ada")
    with pytest.raises(PortError) as error:
        open_port("/dev/ttyACM0", 500_000)
    assert str(error.value) == (
        "Cannot open serial port '/dev/ttyACM0', no permission: add yourself to the group dialout (sudo usermod -aG "
        "dialout ada), log out and in again; retrying."
    )


@pytest.mark.parametrize(
    ("devices", "words"),
    [
        ([], r"No board is plugged in \(there is no serial port here at all\): plug it in"),
        ([("/dev/ttyS0", None)], r"No board is plugged in \(the ports here are /dev/ttyS0 \(n/a\)\)"),
        ([("/dev/ttyACM0", 1), ("/dev/ttyUSB0", 1)], "set the parameter port to one of /dev/ttyACM0, /dev/ttyUSB0"),
    ],
)
def test_without_a_name_the_only_port_on_usb_is_taken(
    devices: list[tuple[str, int | None]], words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = [SimpleNamespace(device=device, vid=vid, description="n/a") for device, vid in devices]
    monkeypatch.setattr(link.list_ports, "comports", lambda: found)
    with pytest.raises(PortError, match=words):
        candidates("")
    with pytest.raises(PortError) as error:
        candidates("", wording=COMMAND)
    assert "--port" in str(error.value) and "parameter" not in str(error.value) and "retrying" not in str(error.value)
    found.append(SimpleNamespace(device="/dev/ttyACM7", vid=1, description="Uno"))
    if len(devices) < 2:
        assert candidates("") == ["/dev/ttyACM7"]
    assert candidates("/dev/mine") == ["/dev/mine"]
    assert candidates("", search=True) == sorted(one.device for one in found if one.vid)


def test_a_client_that_hangs_up_at_once_is_no_trouble(listener: Listener, tmp_path: Path) -> None:
    """A port that vanishes in the middle of being opened, again and again."""
    for _ in range(20):
        master, slave = pty.openpty()
        (tmp_path / "port").unlink(missing_ok=True)
        (tmp_path / "port").symlink_to(os.ttyname(slave))
        os.close(slave)
        os.close(master)
    (tmp_path / "port").unlink()
    listener.wait_for(Closed)
    assert listener.link._thread.is_alive()


@pytest.mark.parametrize("error", [termios.error(5, "Input/output error"), RuntimeError("what nobody thought of")])
def test_whatever_fails_is_said_and_the_port_is_opened_again(
    listener: Listener, port: Port, monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    """`termios.error` is no OSError: a port that goes while it is being set up once ended the thread without a word."""

    def fail(*_: object, **__: object) -> None:
        raise error

    listener.wait_for(Closed)
    listener.events.clear()
    with monkeypatch.context() as patched:
        patched.setattr(serial, "Serial", fail)
        port.plug()
        (closed,) = listener.wait_for(Closed)
    assert isinstance(closed, Closed) and type(error).__name__ in closed.why and str(error.args[-1]) in closed.why
    assert closed.why.startswith("The serial port has failed (") and closed.why.endswith("retrying.")
    listener.wait_for(Opened)
    assert listener.link.alive


def test_a_thread_that_has_ended_is_seen(listener: Listener, monkeypatch: pytest.MonkeyPatch) -> None:
    listener.wait_for(Closed)
    assert listener.link.alive
    monkeypatch.setattr(threading, "excepthook", lambda _: None)

    def end(*_: object) -> None:
        raise SystemExit

    monkeypatch.setattr(listener.link, "_use", end)
    listener.link._thread.join(PATIENCE)
    assert not listener.link.alive


def test_a_search_goes_through_all_ports_on_usb(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ports = [Port(tmp_path / name) for name in ("left", "right")]
    devices = [str(tmp_path / name) for name in ("left", "right")]
    found = [SimpleNamespace(device=device, vid=1, description="Nano") for device in devices]
    monkeypatch.setattr(link.list_ports, "comports", lambda: found)
    monkeypatch.setattr(link, "SEARCH_AGAIN", 0.01)
    for port in ports:
        port.plug()
    listener = Listener(Path())
    seen: list[str] = []
    while len(seen) < 4:
        listener.wait_for(Opened)
        seen += [event.port for event in listener.events if isinstance(event, Opened)]
        listener.events.clear()
        listener.link.pass_over()
    listener.link.close()
    assert seen == [*devices, *devices]
    for port in ports:
        port.close()
