"""What the board's tests share: the emulated board on a clock of the test's own, and a client of its real port."""

import os
import select
import termios
import time
import tty
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import TypeVar

import pytest
from patience import PATIENCE
from tiers import keep_fast

from motor_board.build import CHIPS, FirmwareConfig, chip_library, firmware
from motor_board.emulation.emulator import Emulator
from motor_board.emulation.shaft import EncoderConfig
from motor_board.errors import BoardError
from motor_driver.frames.from_board import Hello, OtherVersion, Telemetry
from motor_driver.frames.from_host import Command, Configure, Enable
from motor_driver.frames.table import Frame
from motor_driver.protocol import Arrival, Decoder, Encoder
from motor_model.parameters import Parameters, paper_motor

F = TypeVar("F", bound=Frame)
MS = 16_000  # [cycle]
TICK = 8  # [cycle]
on_each_chip = pytest.mark.parametrize("chip", CHIPS)  # of `bench` and `make_bench`
on_the_larger_chip_slowly = pytest.mark.parametrize("chip", keep_fast(CHIPS, CHIPS[0]))  # what stops no motor


@cache
def missing() -> str:
    """Why there can be no emulated board here; empty if there can."""
    try:
        firmware()
        chip_library()
    except BoardError as error:
        if "refuses" in str(error):
            raise
        return str(error)
    return ""


def need_emulator() -> None:
    """Skip the test where the compiler for the chip or its emulator is missing."""
    if missing():
        pytest.skip(missing())


@dataclass
class Bench:
    """A board in lockstep: nothing happens but what the test runs. Time is the chip's cycle count."""

    parameters: Parameters = field(default_factory=paper_motor)
    encoder: EncoderConfig = field(default_factory=lambda: EncoderConfig(seed=3))
    config: FirmwareConfig = field(default_factory=FirmwareConfig)

    def __post_init__(self) -> None:
        encoder = replace(self.encoder, channels=self.config.channels)
        self.emulator = Emulator(firmware(self.config), self.parameters, encoder)
        self.chip = self.emulator.chip
        self.encode, self.decode = Encoder(), Decoder()
        self.events: list[Arrival | OtherVersion] = []

    def close(self) -> None:
        self.emulator.close()

    def run(self, milliseconds: float) -> None:
        """Let it run, and hear what it says."""
        end = self.chip.cycle + round(milliseconds * MS)
        while self.chip.cycle < end:
            self.emulator.run(min(end, self.chip.cycle + MS))
            self.events += self.decode.receive(self.chip.drain())

    def send(self, *frames: Frame) -> None:
        for frame in frames:
            self.chip.feed(self.encode.send(frame))

    def all(self, kind: type[F]) -> list[F]:
        return [e.frame for e in self.events if isinstance(e, Arrival) and isinstance(e.frame, kind)]

    def last(self, kind: type[F]) -> F:
        return self.all(kind)[-1]

    def start(self, period: int = 10_000, timeout: int = 100, decay: int = 0) -> None:
        """From power-up to an output that is on, at 0."""
        self.run(8)
        self.chip.feed(b"\0")
        self.send(Configure(period, timeout, decay))
        self.run_until(lambda: bool(self.all(Telemetry)) and self.last(Telemetry).latch == 1, 250)
        self.enable()

    def enable(self) -> None:
        telemetry = self.last(Telemetry)
        self.send(Enable(1, telemetry.boot, telemetry.latch))
        self.run_until(lambda: self.last(Telemetry).enabled, 250)
        self.events.clear()

    def drive(self, duty: int, milliseconds: int, every: int = 5) -> None:
        """Keep commanding a duty."""
        for _ in range(milliseconds // every):
            self.send(Command(duty))
            self.run(every)

    def run_until(self, condition: Callable[[], bool], most: float, step: float = 0.25) -> int:
        """Run until something holds, at most `most` ms; the cycle at which it was first seen to."""
        end = self.chip.cycle + most * MS
        while not condition():
            assert self.chip.cycle < end, "it did not happen"
            self.run(step)
        return self.chip.cycle


class Client:
    """A program at the other end of the board's port, as a driver would be."""

    def __init__(self, link: Path) -> None:
        self.descriptor = os.open(link, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        tty.setraw(self.descriptor, termios.TCSANOW)
        self.encode, self.decode = Encoder(), Decoder()
        self.events: list[Arrival | OtherVersion] = []
        os.write(self.descriptor, b"\0")

    def close(self) -> None:
        if self.descriptor >= 0:
            os.close(self.descriptor)
        self.descriptor = -1

    def send(self, frame: Frame) -> None:
        os.write(self.descriptor, self.encode.send(frame))

    def hear(self) -> None:
        """Wait for bytes, and take them."""
        if select.select([self.descriptor], [], [], 0.2)[0]:
            data = os.read(self.descriptor, 4096)
            if not data:
                raise OSError("the port hung up")
            self.events += self.decode.receive(data)

    def all(self, kind: type[F]) -> list[F]:
        return [e.frame for e in self.events if isinstance(e, Arrival) and isinstance(e.frame, kind)]

    def wait(self, condition: Callable[[], bool]) -> None:
        end = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < end, "it did not happen"
            self.hear()

    def wait_for(self, kind: type[F], more: int = 1) -> F:
        """The last of some more frames of a kind."""
        seen = len(self.all(kind))
        self.wait(lambda: len(self.all(kind)) >= seen + more)
        return self.all(kind)[-1]

    def ask(self, frame: Frame, kind: type[F] = Hello) -> F:  # type: ignore[assignment]
        self.send(frame)
        return self.wait_for(kind)
