"""The driver's logic against the real firmware on the emulated chip, in lockstep: the test owns both clocks."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

from emulated_board import MS, TICK

from motor_board.build import FirmwareConfig, firmware
from motor_board.emulation.emulator import Emulator
from motor_board.emulation.faults import Faults
from motor_board.emulation.serial_line import SerialLine
from motor_board.emulation.shaft import EncoderConfig
from motor_driver import status
from motor_driver.config import Config
from motor_driver.driver import Driver, Reading
from motor_model.parameters import Parameters, paper_motor
from motor_model.sample import Sample
from motor_ros.gate import Gate

HOST = 7_000_000_000_000_000  # [ns] of the host's clock at the chip's cycle 0


@dataclass
class Rig:
    """Board, wire with faults, driver and gate, as the node joins them; `voltage` is what a user keeps asking for."""

    config: Config = field(default_factory=Config)
    parameters: Parameters = field(default_factory=paper_motor)
    firmware: FirmwareConfig = field(default_factory=lambda: FirmwareConfig(edges_per_revolution=96))
    encoder: EncoderConfig = field(default_factory=lambda: EncoderConfig(seed=3))
    enabled: bool = True
    cautious: bool = True  # the user begins with 0 V whenever a board has begun to run
    step: int = MS // 4  # [cycle] between two looks at the port
    emulator: Emulator = None  # type: ignore[assignment]  # of a rig before, or made
    hear: Callable[[Sample], None] = lambda sample: None  # a controller, which answers before the next order is made

    def __post_init__(self) -> None:
        if self.emulator is None:
            encoder = replace(self.encoder, channels=self.firmware.channels)
            self.emulator = Emulator(firmware(self.firmware), self.parameters, encoder)
        self.driver = Driver(self.config)
        self.gate = Gate(self.enabled, self.config.command_timeout, 1.0 / self.config.sample_rate)
        self.faults = Faults()
        self.readings: list[Reading] = []
        self.stops: list[str] = []
        self.clean = b""  # what the board said before any fault
        self.voltage: float | None = None
        self.plugged, self.alive = False, True
        self._in, self._out = SerialLine(1), SerialLine(2)
        self._asked = self._told = self._begun = self._said = 0

    @property
    def now(self) -> int:
        """[ns] the host's clock."""
        return HOST + self.emulator.chip.cycle * 125 // 2

    @property
    def pins(self) -> float:
        """[V] at the motor."""
        return self.emulator.shaft.voltage

    def host(self, sample_time: int) -> float:
        """[ns] the host's clock at a sample of a board that has not been reset."""
        ticks = (sample_time - 1_000_000_000) // 500
        return HOST + (self.emulator.chip.clock_zero + ticks * TICK) * 62.5

    def close(self) -> None:
        self.emulator.close()

    def plug(self) -> None:
        """The port opens."""
        self._in.cut()
        self._out.cut()
        self.plugged = True
        self.driver.opened("the port", self.now)

    def unplug(self) -> None:
        """The port is gone."""
        self.plugged = False
        self.driver.closed("the port is gone")

    def exchange(self, other: FirmwareConfig) -> None:
        """Another board, with a motor of its own, has been where this one is, for as long."""
        old, encoder = self.emulator, replace(self.encoder, channels=other.channels)
        self.emulator = Emulator(firmware(other), self.parameters, encoder)
        self.emulator.run(old.chip.cycle)
        self.emulator.chip.drain()
        old.close()

    def enable(self, on: bool = True) -> str:
        """Call motor/enable; the refusal."""
        refusal = self.gate.refusal(self.now) or self.driver.refusal() if on else ""
        if not refusal:
            self.gate = self.gate.enable(on)
        return refusal

    def run(self, milliseconds: float) -> None:
        """Let time pass."""
        chip = self.emulator.chip
        end = chip.cycle + round(milliseconds * MS)
        while (cycle := chip.cycle) < end:
            self._step(cycle + min(self.step, end - cycle))

    def until(self, condition: Callable[[], bool], most: float) -> float:
        """[ms] until something holds, which it does within `most`."""
        begin = self.emulator.chip.cycle
        while not condition():
            assert self.emulator.chip.cycle - begin < most * MS, "it did not happen"
            self._step(self.emulator.chip.cycle + self.step)
        return (self.emulator.chip.cycle - begin) / MS

    def _step(self, until: int) -> None:
        self.emulator.run(until)
        said, now = self.emulator.chip.drain(), self.now
        self.clean += said
        self._out.send(b"" if self.faults.stuck_telemetry or not self.plugged else said, self.faults, now)
        if self.alive:
            self._drive(now)
        self.emulator.chip.feed(self._in.receive(now))

    def _drive(self, now: int) -> None:
        """What the node does with what has come."""
        data = self._out.receive(now)
        readings = self.driver.received(data, now) if data and self.plugged else []
        self.readings += readings
        for reading in readings:
            self.hear(reading.sample)
        if self.voltage is not None and now - self._told >= 5_000_000:
            self._told, self._said = now, self._said + 1
            careful = self.cautious and not self.gate.begun
            self.gate = self.gate.take(0.0 if careful else self.voltage, now, "user", self._said)
        if readings or now - self._asked > 10_000_000:
            self._asked = now
            if self.driver.runs_begun > self._begun:
                self._begun = self.driver.runs_begun
                self.gate = self.gate.come_up(now)
            order = self.driver.step(now, self.gate.enabled, self.gate.voltage(now))
            if order.stop:
                self.stops.append(order.stop)
                stopped = self.gate.stop_motor(order.stop, now) if order.motor else self.gate.stop(order.stop)
                self.gate = stopped
            self._in.send(order.data if self.plugged else b"", self.faults, now)


MakeRig = Callable[..., Rig]


def problem(rig: Rig) -> str:
    """What /diagnostics says now, had it been fine a second ago."""
    was = status.Tally(rig.now - 1, rig.driver.readings - 1, rig.driver.counters, True, rig.driver.openings)
    return " ".join(filter(None, (status.problem(rig.driver, was, rig.now), rig.gate.problem(rig.now))))
