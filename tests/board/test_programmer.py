"""Flashing: which port, what avrdude is told, and what is said where something is missing."""

import fcntl
import shutil
import sys
from pathlib import Path

import pytest
from emulated_board import need_emulator

from motor_board import programmer
from motor_board.build import FirmwareConfig, firmware
from motor_board.cli.flash import main
from motor_board.errors import BoardError

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def plugged(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two boards, and an avrdude that writes its arguments down."""
    for name in ("ttyACM0", "ttyACM1"):
        (tmp_path / name).touch()
    tool = tmp_path / "bin" / "avrdude"
    tool.parent.mkdir()
    tool.write_text(f'#!/bin/sh\necho "$@" > {tmp_path}/arguments\nexit $(cat {tmp_path}/status)\n')
    tool.chmod(0o755)
    (tmp_path / "status").write_text("0")
    monkeypatch.setattr(programmer, "PORTS", (f"{tmp_path}/ttyACM*",))
    monkeypatch.setenv("PATH", f"{tool.parent}:{Path(shutil.which('sh') or '/bin/sh').parent}:/usr/bin:/bin")
    return tmp_path


def test_flashing_tells_avrdude_all_it_needs(plugged: Path) -> None:
    need_emulator()
    assert main(["--port", f"{plugged}/ttyACM1", "--board", "nano-old", "--board-id", "3"]) == 0
    arguments = (plugged / "arguments").read_text().split()
    assert arguments[:3] == ["-q", "-c", "arduino"]
    assert ["-P", f"{plugged}/ttyACM1", "-b", "57600"] == arguments[5:9]
    assert arguments[-1] == f"flash:w:{firmware(FirmwareConfig(board_id=3))}:e"


def test_a_mega_has_another_chip_and_another_bootloader(plugged: Path) -> None:
    need_emulator()
    assert main(["--port", f"{plugged}/ttyACM0", "--board", "mega"]) == 0
    arguments = (plugged / "arguments").read_text().split()
    assert arguments[1:5] == ["-c", "wiring", "-p", "m2560"] and arguments[7:9] == ["-b", "115200"]
    assert arguments[-1] == f"flash:w:{firmware(FirmwareConfig(chip='atmega2560'))}:e"


def test_one_board_needs_no_port_and_two_are_listed(plugged: Path, capsys: Capture) -> None:
    need_emulator()
    assert main([]) == 1
    assert (
        capsys.readouterr().err
        == f"say which port the board is on with --port: {plugged}/ttyACM0, {plugged}/ttyACM1.\n"
    )
    (plugged / "ttyACM1").unlink()
    assert main([]) == 0 and f"{plugged}/ttyACM0" in (plugged / "arguments").read_text()
    (plugged / "ttyACM0").unlink()
    assert main([]) == 1
    assert capsys.readouterr().err.startswith("no board is plugged in")
    assert main(["--port", "/dev/ttyACM77"]) == 1
    assert capsys.readouterr().err == "there is no /dev/ttyACM77; the ports here: none.\n"


def test_a_port_without_permission_names_dialout(plugged: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.access", lambda path, mode: False)
    with pytest.raises(BoardError, match="no permission for .*ttyACM0: run 'sudo usermod -aG dialout"):
        programmer.the_port(f"{plugged}/ttyACM0")


def test_a_port_that_a_driver_has_is_not_flashed(plugged: Path) -> None:
    """The driver would go on asking the board, which is a bootloader then, and avrdude would write what it hears."""
    board, after = plugged / "ttyACM0", plugged / "arguments"
    with board.open("r+b") as held:
        fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)  # as pyserial's `exclusive`
        with pytest.raises(BoardError, match="ttyACM0 is in use, as by a driver, .*ttyACM0 names it"):
            programmer.flash(Path("x.elf"), str(board), "uno")
        assert not after.exists()
    programmer.flash(Path("x.elf"), str(board), "uno")
    assert after.exists()
    with pytest.raises(BoardError, match="nowhere cannot be opened"):
        programmer.flash(Path("x.elf"), f"{plugged}/nowhere", "uno")


def test_no_driver_gets_a_port_while_it_is_flashed(plugged: Path) -> None:
    (plugged / "bin" / "avrdude").write_text(
        f"#!/bin/sh\nexec {sys.executable} -c 'import fcntl; fcntl.flock(open(\"{plugged}/ttyACM0\"), 6)'\n"
    )
    with pytest.raises(BoardError, match="avrdude could not flash"):
        programmer.flash(Path("x.elf"), f"{plugged}/ttyACM0", "uno")


def test_an_avrdude_that_fails_or_is_missing_is_one_sentence(plugged: Path, capsys: Capture) -> None:
    need_emulator()
    (plugged / "status").write_text("1")
    assert main(["--port", f"{plugged}/ttyACM0"]) == 1
    assert "avrdude could not flash" in capsys.readouterr().err
    (plugged / "bin" / "avrdude").unlink()
    if shutil.which("avrdude") is None:
        assert main(["--port", f"{plugged}/ttyACM0"]) == 1
        assert capsys.readouterr().err == "avrdude is not installed: sudo apt install avrdude\n"
