"""The driver's node in the test's own process: a dead thread, and the right one of two boards."""

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest
import rclpy
from emulated_board import need_emulator
from patience import PATIENCE
from workbench import DOMAIN

from motor_board.build import FirmwareConfig, firmware
from motor_board.emulator import Emulator
from motor_board.live import LiveBoard
from motor_board.port import Port
from motor_driver import link
from motor_driver.node import NO_THREAD, MotorDriver
from motor_model.errors import MotorError
from motor_model.parameters import paper_motor
from motor_ros.loopback import stay_on_this_machine

Make = Callable[..., MotorDriver]


@pytest.fixture
def make() -> Iterator[Make]:
    """Makes a driver with parameters, which ends with the test."""
    made: list[MotorDriver] = []

    def make(*parameters: str) -> MotorDriver:
        stay_on_this_machine()
        words = [word for parameter in parameters for word in ("-p", parameter)]
        rclpy.init(args=["--ros-args", *words], domain_id=int(DOMAIN))
        made.append(MotorDriver())
        return made[0]

    yield make
    made[0].destroy_node()
    rclpy.shutdown()


class Dead:
    """A link whose thread has ended."""

    alive = False

    def take(self) -> list[object]:
        return []

    def write(self, data: bytes) -> None:
        assert data == b""

    def close(self) -> None:
        pass


def test_a_port_that_nobody_looks_after_is_said(make: Make) -> None:
    node = make("port:=nowhere")
    node._link.close()
    node._link = Dead()  # type: ignore[assignment]
    node._work()
    assert node._driver.refusal() == NO_THREAD and node._said == ""
    node._on_second()
    assert node._said == NO_THREAD


@pytest.mark.parametrize("text", ["two", "70000", "-1", "1.5"])
def test_a_number_that_no_board_has_is_one_sentence(text: str) -> None:
    stay_on_this_machine()
    rclpy.init(args=["--ros-args", "-p", f"board_id:={text}"], domain_id=int(DOMAIN))
    try:
        with pytest.raises(MotorError, match=f"board_id '{text}' is no number from 0 to 65535: say the one"):
            MotorDriver()
    finally:
        rclpy.shutdown()


def test_finds_the_board_with_its_number(make: Make, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two boards, alike but for the number that was flashed."""
    need_emulator()
    boards, found = [], []
    for name, number in (("left", 1), ("right", 2)):
        elf = firmware(FirmwareConfig(board_id=number))
        boards.append(LiveBoard(Emulator(elf, paper_motor()), Port(tmp_path / name)))
        found.append(SimpleNamespace(device=str(tmp_path / name), vid=1, description="Nano"))
    monkeypatch.setattr(link.list_ports, "comports", lambda: found)
    node, begin = make("board_id:=2"), time.monotonic()
    while not node._driver.runs:
        assert time.monotonic() - begin < PATIENCE
        node._work()
        time.sleep(0.005)
    assert node._driver.board is not None and node._driver.board.board_id == 2
    assert node._driver.session is not None and node._driver.session.port == str(tmp_path / "right")
    node._link.close()
    for board in boards:
        board.close()
