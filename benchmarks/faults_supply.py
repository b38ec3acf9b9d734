"""Supplies that go away while the motor runs, and come back, for `faults_board.py`: the motor's, the board's."""

from dataclasses import replace

from faults_board_loop import BoardLoop


def lose_motor_supply(loop: BoardLoop, seconds: float) -> None:
    """The supply of motor and bridge is off for a time."""
    loop.emulator.wiring = replace(loop.emulator.wiring, powered=False)
    loop.run(seconds)
    loop.emulator.wiring = replace(loop.emulator.wiring, powered=True)


def lose_board_supply(loop: BoardLoop, seconds: float) -> None:
    """The microcontroller has no supply for a time; its USB chip is the computer's, and the port stays."""
    loop.powered = False
    loop.run(seconds)
    loop.powered = True


def lose_hub(loop: BoardLoop, seconds: float) -> None:
    """The hub of the board is off for a time: it has no supply, and there is no port."""
    loop.plugged = False
    loop.driver.closed("the port is gone")
    lose_board_supply(loop, seconds)
    loop.plug()
