"""The pseudo-terminal under a name that stays: plugged, opened, read, unplugged, and nobody else's."""

import os
import termios
import tty
from collections.abc import Iterator
from pathlib import Path

import pytest
from read_only import read_only

from motor_board.emulation.port import Port
from motor_board.errors import BoardError


@pytest.fixture
def port(tmp_path: Path) -> Iterator[Port]:
    port = Port(tmp_path / "port")
    yield port
    port.close()


def client(path: Path) -> int:
    descriptor = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    tty.setraw(descriptor, termios.TCSANOW)
    return descriptor


def test_it_is_there_while_it_is_plugged(port: Port, tmp_path: Path) -> None:
    assert not port.plugged and not (tmp_path / "port").exists()
    port.plug()
    assert port.plugged and (tmp_path / "port").is_char_device()
    port.unplug()
    assert not port.plugged and not os.path.lexists(tmp_path / "port")


def test_a_place_that_is_read_only_is_a_sentence(tmp_path: Path) -> None:
    """Also where a link is there that a killed emulator left, and may not be taken away."""
    (tmp_path / "port").symlink_to("/dev/pts/none")
    port = Port(tmp_path / "port")
    with read_only(tmp_path):
        with pytest.raises(BoardError, match=r"cannot make .*port \(Permission denied\): set the parameter link"):
            port.plug()
        port.close()


def test_bytes_pass_both_ways_while_somebody_has_it_open(port: Port, tmp_path: Path) -> None:
    port.plug()
    assert not port.opened() and port.read() == b""
    descriptor = client(tmp_path / "port")
    assert port.opened() and not port.opened()  # told once
    os.write(descriptor, b"to the board\0")
    assert port.read() == b"to the board\0" and port.read() == b""
    port.write(b"to the host\0")
    assert os.read(descriptor, 100) == b"to the host\0"
    os.close(descriptor)
    assert not port.opened() and port.read() == b""


def test_what_a_client_left_unread_is_not_the_next_ones(port: Port, tmp_path: Path) -> None:
    port.plug()
    first = client(tmp_path / "port")
    assert port.opened()
    port.write(b"old")
    os.close(first)
    assert not port.opened()
    second = client(tmp_path / "port")
    assert port.opened()
    port.write(b"new")
    assert os.read(second, 100) == b"new"
    os.close(second)


def test_a_client_notices_that_the_plug_is_pulled(port: Port, tmp_path: Path) -> None:
    port.plug()
    descriptor = client(tmp_path / "port")
    assert port.opened()
    port.unplug()
    with pytest.raises(OSError, match="Input/output error"):
        os.write(descriptor, b"anybody?")
    os.close(descriptor)


def test_a_name_in_use_or_of_another_kind_is_not_taken(port: Port, tmp_path: Path) -> None:
    with pytest.raises(BoardError, match="is the port of another emulator: set the parameter link"):
        Port(tmp_path / "port")
    (tmp_path / "notes").write_text("precious")
    with pytest.raises(BoardError, match="exists and is no link to a port"):
        Port(tmp_path / "notes")
    (tmp_path / "stale").symlink_to("/dev/pts/99999")  # what a killed emulator leaves
    Port(tmp_path / "stale").close()
