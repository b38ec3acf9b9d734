"""A board on the emulated chip that is driven as a driver would, in lockstep, and the table of its interrupts."""

from motor_board.build import FirmwareConfig, firmware
from motor_board.emulation.chip import FREQUENCY
from motor_board.emulation.emulator import Emulator
from motor_board.emulation.interrupts import InterruptLoad
from motor_board.emulation.shaft import EncoderConfig
from motor_driver.frames.from_board import Telemetry
from motor_driver.frames.from_host import Command, Configure, Enable, Ping
from motor_driver.protocol import Arrival, Decoder, Encoder
from motor_model.parameters import paper_motor

MS = FREQUENCY // 1000
EDGES = 8_000  # at each rate
KHZ = 2_000  # [tick] sample period


class Link:
    """A board that is driven as a driver would, in lockstep."""

    def __init__(self, period: int, config: FirmwareConfig | None = None) -> None:
        self.emulator = Emulator(firmware(config), paper_motor(), EncoderConfig(seed=1))
        self.chip, self.encoder, self.decoder = self.emulator.chip, Encoder(), Decoder()
        self.samples, self.drifted = 0, set[int]()
        self.period, self.telemetry = period, Telemetry(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0)
        self.run(8)
        self.run(1, b"\0" + self.encoder.send(Configure(period, 100, 0)))
        self.run(30)
        self.run(10, self.encoder.send(Enable(1, self.telemetry.boot, self.telemetry.latch)))

    def run(self, milliseconds: float, data: bytes = b"") -> None:
        self.chip.feed(data)
        self.emulator.run(self.chip.cycle + round(milliseconds * MS))
        for event in self.decoder.receive(self.chip.drain()):
            if isinstance(event, Arrival) and isinstance(event.frame, Telemetry):
                self.telemetry, self.samples = event.frame, self.samples + 1
                self.drifted.add(event.frame.edge_count)

    def drive(self, duty: int, milliseconds: int) -> None:
        """A command every sample, a ping every 50 of them."""
        step = self.period * 500 // 1_000_000
        for k in range(milliseconds // step):
            ping = self.encoder.send(Ping(k)) if k % 50 == 0 else b""
            self.run(step, self.encoder.send(Command(duty)) + ping)

    def close(self) -> None:
        self.emulator.close()


def load_rows(loads: dict[str, InterruptLoad], slept: int, cycles: int) -> list[str]:
    """A table of one run's interrupts."""
    rows = [
        "| interrupt | calls a second | cycles each | longest | longest wait | share |",
        "|---|---:|---:|---:|---:|---:|",
    ]
    for name, load in loads.items():
        rate = load.calls * FREQUENCY / cycles
        rows.append(
            f"| {name} | {rate:,.0f} | {load.cycles / load.calls:.0f} | {load.longest} | {load.waited} "
            f"| {load.cycles / cycles:.1%} |"
        )
    interrupts = sum(load.cycles for load in loads.values()) / cycles
    idle = slept / cycles
    rows.append(f"| all interrupts | | | | | {interrupts:.1%} |")
    rows.append(f"| frames, in the main loop | | | | | {1 - interrupts - idle:.1%} |")
    rows.append(f"| asleep | | | | | {idle:.1%} |")
    return [*rows, ""]
