"""The faults of `faults.py` on the emulated board, as a table: what happens, how long it may last."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from faults_board_loop import BoardLoop
from faults_loop import Outcome, outcome
from faults_motor import Motor
from faults_rows import KNOWN, MOTION
from faults_supply import lose_board_supply, lose_hub, lose_motor_supply

from motor_board.emulation.chip import Hang
from motor_board.emulation.edges import Edges, Line
from motor_board.emulation.wiring import Wiring
from motor_model.effects import INDEX


@dataclass(frozen=True)
class BoardFault:
    """One fault; it comes after 1.5 s at half of the top speed, or at a plain voltage."""

    name: str
    most: float  # [s]
    apply: Callable[[BoardLoop], None]
    channels: int = 1
    raw: float = 0.0  # of the motor's voltage
    measured: bool = False  # the supply


def kill_controller(loop: BoardLoop) -> None:
    """The controller is gone."""
    loop.alive = False


def kill_driver(loop: BoardLoop) -> None:
    """The driver is gone."""
    loop.driving = False


def restart_driver(loop: BoardLoop) -> None:
    """The driver is killed and started again, under a sender that goes on."""
    loop.start()


def unplug(loop: BoardLoop) -> None:
    """The plug is pulled."""
    loop.plugged = False
    loop.driver.closed("the port is gone")


def plug_another(loop: BoardLoop) -> None:
    """The plug is pulled and another board is plugged in; somebody calls motor/enable after 0.6 s, and again."""
    unplug(loop)
    loop.run(0.2)
    loop.exchange(number=9)
    loop.plug()
    for _ in range(2):
        loop.run(0.6)
        loop.enable()


def stick(loop: BoardLoop) -> None:
    """The board is heard no more."""
    loop.stuck = True


def hang(loop: BoardLoop) -> None:
    """The firmware falls into an endless loop."""
    loop.emulator.chip.hang(Hang.LOOPING)


def press_reset(loop: BoardLoop) -> None:
    """The board's button."""
    loop.emulator.reset()


def cable_off(stray: float = 0.0) -> Callable[[BoardLoop], None]:
    """The encoder's cable is off."""

    def apply(loop: BoardLoop) -> None:
        loop.emulator.encoder_connected, loop.emulator.stray_edges = False, stray

    return apply


def block(loop: BoardLoop) -> None:
    """Something holds the shaft."""
    for name in ("ks", "breakaway_voltage"):
        loop.emulator.shaft._p[INDEX[name]] = 10.0 * loop.motor.voltage


def exchange_channels(loop: BoardLoop) -> None:
    """B tells the other direction."""
    plan = loop.emulator.shaft.plan

    def other(until: int) -> Edges:
        edges = plan(until)
        return replace(edges, what=(edges.what ^ np.uint8(Line.B_HIGH)).astype(np.uint8))

    loop.emulator.shaft.plan = other  # type: ignore[method-assign]


def lose_channel(loop: BoardLoop) -> None:
    """B's wire is off, and its pull-up holds it."""
    loop.emulator.wiring = Wiring(b_connected=False)


def hold_back(loop: BoardLoop) -> None:
    """The link loses nothing, and is late by half of the time since then, up to 1 s, either way."""
    loop.holds_back = loop.time


BOARD_FAULTS = (
    BoardFault("controller killed", KNOWN, kill_controller),
    BoardFault("driver killed", KNOWN, kill_driver),
    BoardFault("driver started again under a held reference", KNOWN, restart_driver),
    BoardFault("driver started again under a plain voltage", KNOWN, restart_driver, raw=0.6),
    BoardFault("plug pulled", KNOWN, unplug),
    BoardFault("plug pulled, another board plugged in, `motor/enable`, plain voltage", KNOWN, plug_another, raw=0.6),
    BoardFault("no telemetry", KNOWN, stick),
    BoardFault("the link holds bytes back, up to 1 s", MOTION, hold_back),
    BoardFault("the link holds bytes back, up to 1 s, plain voltage", MOTION, hold_back, raw=0.6),
    BoardFault("firmware hangs", KNOWN, hang),
    BoardFault("board reset", KNOWN, press_reset),
    BoardFault("motor's supply off for 0.5 s, and back", KNOWN, partial(lose_motor_supply, seconds=0.5)),
    BoardFault("motor's supply off for 3 s, and back", KNOWN, partial(lose_motor_supply, seconds=3.0)),
    *(
        BoardFault(
            f"motor's supply off for 3 s, and back, plain voltage of {raw:g}{how}",
            KNOWN,
            partial(lose_motor_supply, seconds=3.0),
            raw=raw,
            measured=measured,
        )
        for raw, how, measured in ((0.6, "", False), (0.3, ", measured", True))
    ),
    *(
        BoardFault(f"board without supply for {away:g} s", KNOWN, partial(lose_board_supply, seconds=away))
        for away in (0.1, 0.5, 3.0)
    ),
    BoardFault("hub of the board off for 3 s, plain voltage", KNOWN, partial(lose_hub, seconds=3.0), raw=0.6),
    BoardFault("encoder's cable off", MOTION, cable_off()),
    BoardFault("cable off, 50 stray edges a second", MOTION, cable_off(50.0)),
    BoardFault("two channels exchanged", MOTION, exchange_channels, channels=2),
    BoardFault("one of two channels off", MOTION, lose_channel, channels=2),
    BoardFault("plain voltage, shaft blocked", MOTION, block, raw=0.6),
    BoardFault("plain voltage, encoder's cable off", MOTION, cable_off(), raw=0.6),
    BoardFault("plain voltage, two channels exchanged", MOTION, exchange_channels, channels=2, raw=0.6),
    BoardFault("plain voltage, one of two channels off", MOTION, lose_channel, channels=2, raw=0.6),
)


def run_on_board(fault: BoardFault, motor: Motor, rate: float) -> Outcome:
    """What a fault does to a motor on the emulated board's pins."""
    loop = BoardLoop(rate, motor, channels=fault.channels, supply=motor.voltage if fault.measured else 0.0)
    loop.run(0.6)
    if fault.raw:
        loop.raw = 0.0
        loop.run(0.05)
        loop.raw = fault.raw * loop.motor.voltage
    else:
        loop.reference = 0.5 * loop.motor.top
    loop.run(1.5)
    begin = loop.time
    fault.apply(loop)
    loop.run(3.0)
    loop.emulator.close()
    return outcome(loop.moments, begin)
