"""Two drivers that look for their boards at the same time, on the same ports."""

import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from emulated_board import need_emulator
from patience import PATIENCE

from motor_board.build import FirmwareConfig, firmware
from motor_board.emulation.emulator import Emulator
from motor_board.emulation.live import LiveBoard
from motor_board.emulation.port import Port
from motor_driver.config import Config
from motor_driver.driver import Driver
from motor_driver.link import Link
from motor_driver.link_events import Closed, Opened, Received
from motor_model.parameters import paper_motor


class Looking:
    """Link and driver, as the node joins them, without ROS."""

    def __init__(self, ports: str, board_id: int) -> None:
        self.driver, self._woken = Driver(Config(board_id=board_id)), threading.Event()
        self.link = Link(ports, 500_000, self._woken.set, search=True)

    def work(self) -> None:
        for event in self.link.take():
            match event:
                case Received(data, at):
                    self.driver.received(data, at)
                case Opened(port, at, roll_call):
                    self.driver.opened(port, at, roll_call)
                case Closed(why):
                    self.driver.closed(why)
        now = time.monotonic_ns()
        self.link.write(self.driver.step(now, False, 0.0).data)
        if self.driver.unsuitable(now):
            self.link.pass_over(self.driver.matches)


@pytest.fixture
def swapped(tmp_path: Path) -> Iterator[Path]:
    """Board 2 on the port that is looked at first, board 1 on the other."""
    need_emulator()
    boards = [
        LiveBoard(Emulator(firmware(FirmwareConfig(board_id=number)), paper_motor()), Port(tmp_path / name))
        for name, number in (("usb0", 2), ("usb1", 1))
    ]
    yield tmp_path
    for board in boards:
        board.close()


def test_each_finds_its_own(swapped: Path) -> None:
    drivers = [Looking(f"{swapped}/usb*", number) for number in (1, 2)]
    end = time.monotonic() + PATIENCE
    while not all(one.driver.runs for one in drivers) and time.monotonic() < end:
        for one in drivers:
            one.work()
        time.sleep(0.003)
    found = [(one.driver.session.port, one.driver.board.board_id) for one in drivers]  # type: ignore[union-attr]
    for one in drivers:
        one.link.close()
    assert found == [(f"{swapped}/usb1", 1), (f"{swapped}/usb0", 2)]
