"""The emulated chip: what runs on it."""

from pathlib import Path

import pytest
from emulated_board import need_emulator

from motor_board.emulation.chip import Chip
from motor_board.errors import BoardError


def test_a_file_that_is_no_program_is_refused(tmp_path: Path) -> None:
    need_emulator()
    (tmp_path / "text.elf").write_text("no program")
    for name in ("text.elf", "missing.elf"):
        with pytest.raises(BoardError, match=f"{name} is no program for an ATmega328P or ATmega2560: build it again"):
            Chip(tmp_path / name)
