"""Building and flashing: what reaches a board, and the sentences of whoever lacks something."""

import shutil
import subprocess
from pathlib import Path

import pytest
from emulated_board import Bench, need_emulator

from motor_board import build, programmer
from motor_board.build import AVR, FirmwareConfig, firmware
from motor_board.chip import Chip
from motor_board.cli.flash import main
from motor_board.errors import BoardError
from motor_board.sketch import write_sketch
from motor_driver.frames import Hello

Capture = pytest.CaptureFixture[str]


def test_a_build_is_kept_and_made_anew_for_another_setting() -> None:
    need_emulator()
    first, again, other = firmware(), firmware(FirmwareConfig()), firmware(FirmwareConfig(board_id=9))
    assert first == again != other and first.exists() and other.exists()


def test_firmware_and_emulator_compile_without_a_warning() -> None:
    need_emulator()
    for config in (FirmwareConfig(), FirmwareConfig("tb6612", channels=2, supply_full_scale=20_000)):
        assert firmware(config, strict=True).exists()
    assert build.chip_library(strict=True).exists()


def test_the_firmware_leaves_most_of_the_chip_free() -> None:
    need_emulator()
    size = subprocess.run(["avr-size", str(firmware())], capture_output=True, text=True, check=True)
    text, data, bss = map(int, size.stdout.splitlines()[1].split()[:3])
    assert 3_000 < text + data < 8_192  # of 32 kB flash
    assert 300 < data + bss < 768  # of 2 kB RAM; the rest is stack


def test_the_sketch_is_the_same_firmware(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Compiled as the Arduino IDE does: every file of one folder, no options of ours."""
    need_emulator()
    folder = tmp_path / "motor"
    ino = write_sketch(folder, FirmwareConfig("tb6612", board_id=77, channels=2))
    assert ino == folder / "motor.ino" and all(line.startswith("//") for line in ino.read_text().splitlines())
    elf = folder / "sketch.elf"
    options = [option for option in AVR if not option.startswith(("-std", "-O"))]
    files = sorted(map(str, folder.glob("*.c")))
    subprocess.run(["avr-gcc", "-std=gnu11", "-Os", "-w", *options, *files, "-o", str(elf)], check=True)
    monkeypatch.setattr("emulated_board.firmware", lambda config: elf)
    bench = Bench()
    bench.run(4)
    assert (bench.last(Hello).board_id, bench.last(Hello).channels) == (77, 2)
    bench.close()


def test_a_file_that_is_no_program_is_refused(tmp_path: Path) -> None:
    need_emulator()
    (tmp_path / "text.elf").write_text("no program")
    for name in ("text.elf", "missing.elf"):
        with pytest.raises(BoardError, match=f"{name} is no program for an ATmega328P: build it again"):
            Chip(tmp_path / name)


def test_a_sketch_overwrites_nothing(tmp_path: Path) -> None:
    (tmp_path / "mine").write_text("precious")
    with pytest.raises(BoardError, match="is not an empty folder"):
        write_sketch(tmp_path, FirmwareConfig())


@pytest.mark.parametrize(
    ("config", "said"),
    [
        (FirmwareConfig("h-bridge"), "there is no bridge 'h-bridge': choose one of l298n, tb6612"),
        (FirmwareConfig(channels=3), "1 or 2 channels, not 3"),
        (FirmwareConfig(board_id=-1), "board_id is -1: it must be from 0 to 65535"),
        (FirmwareConfig(edges_per_revolution=70_000), "from 0 to 65535"),
    ],
)
def test_a_setting_that_no_board_can_have_is_refused(config: FirmwareConfig, said: str) -> None:
    with pytest.raises(BoardError, match=said):
        firmware(config)


def test_without_the_compiler_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    assert main(["--build"]) == 1
    said = capsys.readouterr().err
    assert said.startswith("avr-gcc is not installed: sudo apt install gcc-avr avr-libc") and said.count("\n") == 1


def test_without_libsimavr_the_emulator_says_what_to_install(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "lacking.c").write_text("#include <simavr/sim_avr_that_is_not_here.h>\n")
    monkeypatch.setattr(build, "sources", lambda *folders, **suffixes: [tmp_path / "lacking.c"])
    with pytest.raises(BoardError, match=r"libraries are missing here: sudo apt install .*libsimavr-dev libelf-dev"):
        build.chip_library()


def test_what_the_compiler_refuses_is_shown(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    need_emulator()
    (tmp_path / "wrong.c").write_text("int main(void) { int unused; }\n")
    monkeypatch.setattr(build, "sources", lambda *folders, **suffixes: [tmp_path / "wrong.c"])
    with pytest.raises(BoardError, match=r"(?s)refuses:\n.*unused"):
        firmware(strict=True)


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


def test_an_avrdude_that_fails_or_is_missing_is_one_sentence(plugged: Path, capsys: Capture) -> None:
    need_emulator()
    (plugged / "status").write_text("1")
    assert main(["--port", f"{plugged}/ttyACM0"]) == 1
    assert "avrdude could not flash" in capsys.readouterr().err
    (plugged / "bin" / "avrdude").unlink()
    if shutil.which("avrdude") is None:
        assert main(["--port", f"{plugged}/ttyACM0"]) == 1
        assert capsys.readouterr().err == "avrdude is not installed: sudo apt install avrdude\n"
