"""Building the firmware and the emulator, and the sentences of whoever lacks something."""

import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from emulated_board import need_emulator

from motor_board import build
from motor_board.build import CHIPS, FirmwareConfig, firmware
from motor_board.errors import BoardError


def test_a_build_is_kept_and_made_anew_for_another_setting() -> None:
    need_emulator()
    first, again, other = firmware(), firmware(FirmwareConfig()), firmware(FirmwareConfig(board_id=9))
    assert first == again != other and first.exists() and other.exists()


def test_firmware_and_emulator_compile_without_a_warning() -> None:
    need_emulator()
    for chip in CHIPS:
        for config in (FirmwareConfig(), FirmwareConfig("tb6612", channels=2, supply_full_scale=20_000)):
            assert firmware(replace(config, chip=chip), strict=True).exists()
    assert build.chip_library(strict=True).exists()


@pytest.mark.parametrize("chip", CHIPS)
def test_the_firmware_leaves_most_of_the_chip_free(chip: str) -> None:
    need_emulator()
    size = subprocess.run(
        ["avr-size", str(firmware(FirmwareConfig(chip=chip)))], capture_output=True, text=True, check=True
    )
    text, data, bss = map(int, size.stdout.splitlines()[1].split()[:3])
    assert 3_000 < text + data < 10_240  # of 32 kB flash, or 256
    assert 300 < data + bss < 768  # of 2 kB RAM, or 8; the rest is stack


@pytest.mark.parametrize(
    ("config", "said"),
    [
        (FirmwareConfig("h-bridge"), "there is no bridge 'h-bridge': choose one of l298n, tb6612, drv8871"),
        (FirmwareConfig(chip="atmega8"), "no firmware for 'atmega8': choose one of atmega328p, atmega2560"),
        (FirmwareConfig(channels=3), "1 or 2 channels, not 3"),
        (FirmwareConfig(board_id=-1), "board_id is -1: it must be from 0 to 65535"),
        (FirmwareConfig(edges_per_revolution=70_000), "from 0 to 65535"),
    ],
)
def test_a_setting_that_no_board_can_have_is_refused(config: FirmwareConfig, said: str) -> None:
    with pytest.raises(BoardError, match=said):
        firmware(config)


def test_without_libsimavr_the_emulator_says_what_to_install(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "lacking.c").write_text("#include <simavr/sim_avr_that_is_not_here.h>\n")
    monkeypatch.setattr(build, "sources", lambda *folders, **suffixes: [tmp_path / "lacking.c"])
    with pytest.raises(BoardError, match=r"libraries are missing here: sudo apt install .*libsimavr-dev libelf-dev"):
        build.chip_library()


def test_what_the_compiler_refuses_is_shown(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    need_emulator()
    (tmp_path / "wrong.c").write_text("int main(void) { int unused; }\n")
    monkeypatch.setattr(build, "sources", lambda *folders, **suffixes: [tmp_path / "wrong.c"])
    with pytest.raises(BoardError, match=r"refuses: .*wrong\.c:1:22: error: unused variable"):
        firmware(strict=True)


def test_the_line_that_says_what_is_wrong() -> None:
    assert build.first_error("x.c: In function 'main':\nx.c:1:2: error: no\n int x;\n") == "x.c:1:2: error: no"
    assert build.first_error("starting\nout of memory\n") == "out of memory"
    assert build.first_error("") == "it says nothing"
