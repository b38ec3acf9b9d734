"""A board that is not the wanted one, or none at all, is refused in a sentence."""

import re
from dataclasses import replace

import pytest
from driver_rig import MakeRig, Rig, problem

from motor_board.build import FirmwareConfig
from motor_driver.config import Config
from motor_driver.frames.from_host import Identify
from motor_driver.protocol import pack


def test_another_version_is_refused_in_a_sentence(make_rig: MakeRig) -> None:
    rig = make_rig()
    rig.driver.opened("the port", rig.now)
    rig.driver.received(b"\0" + pack(Identify(), 0, version=2), rig.now)
    assert "The board on the port speaks protocol version 2, this driver version 1: update" in problem(rig)
    assert "speaks protocol version 2" in rig.enable()


@pytest.mark.parametrize(
    ("board", "words"),
    [
        (
            FirmwareConfig(edges_per_revolution=20),
            "with 20 edges per revolution, and the parameter .* is 96: set the parameter",
        ),
        (FirmwareConfig(channels=2), r"reads 2 encoder channel\(s\), and single_channel is true: set the parameter"),
    ],
)
def test_a_board_that_does_not_fit_is_refused_in_a_sentence(
    make_rig: MakeRig, board: FirmwareConfig, words: str
) -> None:
    rig = make_rig(firmware=board)
    rig.plug()
    rig.voltage = 6.0
    rig.run(600)
    assert re.search(words, problem(rig)) and rig.readings == [] and rig.pins == 0.0


def test_nothing_that_answers_is_said_to_be_no_board(make_rig: MakeRig) -> None:
    rig = make_rig()
    rig.driver.opened("the port", rig.now - 3_100_000_000)
    rig.run(50)
    assert problem(rig).startswith("Nothing on the port answers as a motor board: flash it")


@pytest.mark.parametrize(
    ("wanted", "there", "words"),
    [
        (None, 7, ""),
        (7, 7, ""),
        (8, 7, "This is the board number 7, and the parameter board_id is 8: plug the right board in"),
        (8, 0, "This is the board without a number, and the parameter board_id is 8"),
    ],
)
def test_another_board_is_refused_in_a_sentence(make_rig: MakeRig, wanted: int | None, there: int, words: str) -> None:
    rig = make_rig(config=Config(board_id=wanted), firmware=FirmwareConfig(board_id=there))
    rig.plug()
    rig.voltage = 6.0
    rig.run(600)
    assert problem(rig).startswith(words) and rig.driver.unsuitable(rig.now) == bool(words)
    assert (rig.readings == []) == bool(words) and (rig.pins == 0.0) == bool(words)


SAME = FirmwareConfig(edges_per_revolution=96)
OTHERS = [
    (replace(SAME, board_id=9), "board_id 9 instead of 0"),
    (replace(SAME, edges_per_revolution=0), "edges per revolution 0 instead of 96"),
    (replace(SAME, bridge="drv8871", chip="atmega2560"), "chip 2 instead of 1"),
]


@pytest.mark.parametrize(("other", "words"), OTHERS)
def test_another_board_on_the_port_does_not_go_on_where_one_ran(
    running: Rig, other: FirmwareConfig, words: str
) -> None:
    """Without a board_id, and however often somebody calls motor/enable: it drives another motor."""
    running.unplug()
    running.run(200)
    running.exchange(other)
    running.plug()
    for _ in range(20):
        running.run(50)
        assert running.pins == 0.0 and running.enable() != ""
    assert problem(running).startswith(f"This is another board than the one that ran ({words}): plug that one in again")
    assert problem(running).startswith(running.enable())


def put_in(rig: Rig, board: FirmwareConfig) -> None:
    """Pull the plug of the board that runs, and plug this one in."""
    rig.unplug()
    rig.exchange(board)
    rig.plug()


def test_the_board_that_ran_goes_on_after_another_one(running: Rig) -> None:
    put_in(running, replace(SAME, board_id=9))
    running.run(600)
    put_in(running, SAME)
    running.until(lambda: running.driver.runs, 600)
    running.run(200)
    assert running.pins == 0.0 and running.enable() == ""
    running.until(lambda: running.pins == 6.0, 30)


def test_a_board_with_the_number_that_is_wanted_may_replace_one_that_ran(make_rig: MakeRig) -> None:
    one, other = FirmwareConfig(board_id=7), FirmwareConfig(board_id=7, edges_per_revolution=96)
    rig = make_rig(config=Config(board_id=7), firmware=one)
    rig.plug()
    rig.voltage = 6.0
    rig.until(lambda: rig.pins == 6.0, 600)
    put_in(rig, other)
    rig.until(lambda: rig.driver.runs, 600)
    rig.run(300)
    assert rig.pins == 0.0 and rig.enable() == ""
    rig.until(lambda: rig.pins == 6.0, 30)
