"""A board in real time in the test's own process, whose truth can be looked at; ends with the test."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from emulated_board import need_emulator

from motor_board.build import FirmwareConfig, firmware
from motor_board.emulation.emulator import Emulator
from motor_board.emulation.live import LiveBoard
from motor_board.emulation.port import Port
from motor_board.emulation.shaft import EncoderConfig
from motor_model.parameters import paper_motor


@pytest.fixture
def live(tmp_path: Path) -> Iterator[LiveBoard]:
    """A board in real time behind tmp_path/port."""
    need_emulator()
    elf = firmware(FirmwareConfig(edges_per_revolution=96))
    board = LiveBoard(Emulator(elf, paper_motor(), EncoderConfig(seed=3)), Port(tmp_path / "port"))
    yield board
    board.close()
    assert board.error is None
