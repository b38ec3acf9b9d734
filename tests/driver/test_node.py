"""The driver's node in the test's own process: a dead thread, and the right one of two boards."""

import re
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from emulated_board import need_emulator
from patience import PATIENCE
from workbench import DOMAIN

from motor_board.build import FirmwareConfig, firmware
from motor_board.emulation.emulator import Emulator
from motor_board.emulation.live import LiveBoard
from motor_board.emulation.port import Port
from motor_driver.node import NO_THREAD, MotorDriver
from motor_model.errors import MotorError
from motor_model.parameters import paper_motor
from motor_ros.loopback import stay_on_this_machine
from motor_ros.run import quick_executor

Make = Callable[..., MotorDriver]
Capture = pytest.CaptureFixture[str]


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


@pytest.mark.parametrize("most", [3.0, 24.0])
def test_a_supply_that_is_only_assumed_is_warned_of_once(
    make: Make, boards: Callable[..., list[LiveBoard]], most: float, tmp_path: Path, capfd: Capture
) -> None:
    """In the log wherever max_voltage was set, in /diagnostics where it was lowered."""
    boards(port=0)
    node = make(f"port:={tmp_path}/port", f"max_voltage:={most}")
    told: list[DiagnosticArray] = []
    node._plant._diagnostics.publish = told.append
    work(node, lambda: node._driver.readings > 0)
    for _ in range(3):
        node._on_second()
    said = f"Full duty is taken for the {most:g} V of max_voltage: the board measures no supply"
    assert capfd.readouterr().err.count(said) == 1
    assert (said in told[-1].status[0].message) == (most < 12.0)
    assert most > 12.0 or told[-1].status[0].level == DiagnosticStatus.WARN
    values = {value.key: value.value for value in told[-1].status[0].values}
    assert values["voltage at full duty from"].startswith("max_voltage")
    node._link.close()


@pytest.mark.parametrize("text", ["two", "70000", "-1", "1.5"])
def test_a_number_that_no_board_has_is_one_sentence(text: str) -> None:
    stay_on_this_machine()
    rclpy.init(args=["--ros-args", "-p", f"board_id:={text}"], domain_id=int(DOMAIN))
    try:
        with pytest.raises(MotorError, match=f"board_id '{text}' is no number from 0 to 65535: say the one"):
            MotorDriver()
    finally:
        rclpy.shutdown()


@pytest.fixture
def boards(tmp_path: Path) -> Iterator[Callable[..., list[LiveBoard]]]:
    """Makes boards, alike but for the number that was flashed, at tmp_path/NAME."""
    need_emulator()
    made: list[LiveBoard] = []

    def make(**numbers: int) -> list[LiveBoard]:
        for name, number in numbers.items():
            elf = firmware(FirmwareConfig(board_id=number))
            made.append(LiveBoard(Emulator(elf, paper_motor()), Port(tmp_path / name)))
        return made

    yield make
    for board in made:
        board.close()


def work(node: MotorDriver, condition: Callable[[], bool]) -> None:
    """Let the node work until something holds."""
    begin = time.monotonic()
    while not condition():
        assert time.monotonic() - begin < PATIENCE
        node._work()
        time.sleep(0.005)


@pytest.mark.parametrize("numbers", [{"left": 1, "right": 2}, {"left": 2, "right": 1}])
def test_finds_the_board_with_its_number_whichever_port_it_is_on(
    make: Make, boards: Callable[..., list[LiveBoard]], numbers: dict[str, int], tmp_path: Path
) -> None:
    boards(**numbers)
    node = make(f"port:={tmp_path}/*", "board_id:=2")
    work(node, lambda: node._driver.runs)
    assert node._driver.board is not None and node._driver.board.board_id == 2
    port = next(name for name, number in numbers.items() if number == 2)
    assert node._driver.session is not None and node._driver.session.port == str(tmp_path / port)
    node._link.close()


@pytest.mark.parametrize(
    ("wanted", "says"), [(7, "Several boards have that board_id"), (9, "None of .* has the board")]
)
def test_a_number_that_two_boards_have_or_none_is_a_sentence_and_nothing_runs(
    make: Make, boards: Callable[..., list[LiveBoard]], wanted: int, says: str, tmp_path: Path
) -> None:
    boards(left=7, right=7)
    node = make(f"port:={tmp_path}/*", f"board_id:={wanted}")
    work(node, lambda: re.match(says, node._driver.trouble) is not None)
    assert not node._driver.runs and node._driver.board is None
    assert "retrying" in node._driver.trouble
    node._link.close()


def test_a_mistake_that_a_chunk_of_bytes_shows_ends_the_node(make: Make, monkeypatch: pytest.MonkeyPatch) -> None:
    """In a task of the quick executor it ended the process, without closing the port or saying what it was."""
    node, executor = make(), quick_executor()

    def mistaken() -> None:
        raise ValueError("of the driver")

    executor.add_node(node)
    with monkeypatch.context() as patch:
        patch.setattr(node, "_work", mistaken)
        node._on_wake()
    with pytest.raises(ValueError, match="of the driver"):
        for _ in range(100):
            executor.spin_once(timeout_sec=0.05)
    executor.shutdown()
