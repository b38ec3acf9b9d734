"""The firmware as a sketch folder: the same firmware, and nothing overwritten."""

import subprocess
from pathlib import Path

import pytest
from emulated_board import Bench, need_emulator

from motor_board.build import AVR, FirmwareConfig
from motor_board.errors import BoardError
from motor_board.sketch import write_sketch
from motor_driver.frames.from_board import Hello


def test_the_sketch_is_the_same_firmware(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Compiled as the Arduino IDE does: every file of one folder, no options of ours."""
    need_emulator()
    folder = tmp_path / "motor"
    ino = write_sketch(folder, FirmwareConfig("tb6612", board_id=77, channels=2))
    assert ino == folder / "motor.ino" and all(line.startswith("//") for line in ino.read_text().splitlines())
    elf = folder / "sketch.elf"
    options = [option for option in AVR if not option.startswith(("-std", "-O"))]
    files = sorted(map(str, folder.glob("*.c")))
    subprocess.run(
        ["avr-gcc", "-mmcu=atmega328p", "-std=gnu11", "-Os", "-w", *options, *files, "-o", str(elf)], check=True
    )
    monkeypatch.setattr("emulated_board.firmware", lambda config: elf)
    bench = Bench()
    bench.run(4)
    assert (bench.last(Hello).board_id, bench.last(Hello).channels) == (77, 2)
    bench.close()


def test_a_sketch_overwrites_nothing(tmp_path: Path) -> None:
    (tmp_path / "mine").write_text("precious")
    with pytest.raises(BoardError, match="is not an empty folder"):
        write_sketch(tmp_path, FirmwareConfig())


def test_a_name_that_no_folder_can_have_is_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(BoardError, match=r"cannot write .*a \(File name too long\): name another folder\."):
        write_sketch(tmp_path / ("a" * 256), FirmwareConfig())
