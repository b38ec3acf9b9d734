"""The board's firmware on the emulated ATmega328P: size, interrupt load, highest edge rate, speed of emulation.

Cycle counts are the emulated processor's and the same on every machine; only the last table depends on the computer.
"""

import subprocess
import sys
import time
from pathlib import Path

import numpy as np
from machine import machine

from motor_board.build import firmware
from motor_board.chip import FREQUENCY, InterruptLoad
from motor_board.emulator import Emulator
from motor_board.shaft import EncoderConfig
from motor_driver.frames import Command, Configure, Enable, Ping, Telemetry
from motor_driver.protocol import Arrival, Decoder, Encoder
from motor_model.parameters import paper_motor

RESULTS = Path(__file__).with_name("results")
MS = FREQUENCY // 1000
EDGES = 8_000  # at each rate
KHZ = 2_000  # [tick] sample period


class Link:
    """A board that is driven as a driver would, in lockstep."""

    def __init__(self, period: int) -> None:
        self.emulator = Emulator(firmware(), paper_motor(), EncoderConfig(seed=1))
        self.chip, self.encoder, self.decoder = self.emulator.chip, Encoder(), Decoder()
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
                self.telemetry = event.frame

    def drive(self, duty: int, milliseconds: int) -> None:
        """A command every sample, a ping every 50 of them."""
        step = self.period * 500 // 1_000_000
        for k in range(milliseconds // step):
            ping = self.encoder.send(Ping(k)) if k % 50 == 0 else b""
            self.run(step, self.encoder.send(Command(duty)) + ping)

    def close(self) -> None:
        self.emulator.close()


def size() -> list[str]:
    """Flash and RAM."""
    done = subprocess.run(["avr-size", str(firmware())], capture_output=True, text=True, check=True)
    text, data, bss = map(int, done.stdout.splitlines()[1].split()[:3])
    return [f"Flash {text + data:,} of 32,256 bytes; RAM {data + bss} of 2,048 bytes (static; the rest is stack).", ""]


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


def full_speed() -> list[str]:
    """1 kHz, commands at 1 kHz, the motor at its largest speed."""
    link = Link(KHZ)
    link.drive(256, 1_000)
    link.chip.load()
    before = link.chip.cycle
    link.drive(256, 2_000)
    loads, slept = link.chip.load()
    cycles, speed, counters = link.chip.cycle - before, link.emulator.shaft.speed, link.decoder.counters
    link.close()
    title = f"## 1 kHz, {speed:.0f} rad/s × 96 edges ({loads['capture'].calls * FREQUENCY / cycles:,.0f} edges/s)"
    return [title, "", *load_rows(loads, slept, cycles), f"Bad frames {counters.bad}, lost {counters.lost}.", ""]


def edges(rate: int) -> tuple[int, list[str]]:
    """Edges lost at a rate [1/s] under full traffic at 1 kHz, and the interrupts' table."""
    link = Link(KHZ)
    first = link.chip.cycle + 5 * MS
    cycles = (first + (FREQUENCY / rate + 0.37) * np.arange(EDGES)).astype(np.uint64)  # drifts through all phases
    plan = link.emulator.shaft.plan
    link.emulator._plan = lambda until: plan(until)  # type: ignore[method-assign,assignment,return-value]
    link.chip.set_edges(first - 1, cycles, np.zeros(EDGES, dtype=np.uint8))
    link.drive(0, 6)
    link.chip.load()
    began = link.chip.cycle
    while link.chip.cycle < cycles[-1] - MS:
        link.drive(0, 1)
    loads, slept = link.chip.load()
    table = load_rows(loads, slept, link.chip.cycle - began)
    link.drive(0, 5)
    lost = EDGES - link.telemetry.edge_count
    link.close()
    return lost, table


def speed() -> list[str]:
    """How much faster than real time the emulation runs on this computer."""
    rows = ["| emulated | times real time |", "|---|---:|"]
    for name, period, duty in (
        ("200 Hz, at rest", 10_000, 0),
        ("200 Hz, full speed", 10_000, 256),
        ("1 kHz, full speed", KHZ, 256),
    ):
        link = Link(period)
        link.drive(duty, 1_000)
        began = time.perf_counter()
        link.drive(duty, 5_000)
        rows.append(f"| {name} | {5.0 / (time.perf_counter() - began):.1f} |")
        link.close()
    return [*rows, ""]


def main() -> int:
    """Write results/board.md."""
    lines = ["# The board's firmware on the emulated ATmega328P (16 MHz)", "", *size(), *full_speed()]
    lost, table = edges(20_000)
    lines += ["## 1 kHz, 20,000 edges/s", "", *table, f"Edges lost: {lost} of {EDGES:,}.", ""]
    lines += ["## Highest edge rate without loss", "", f"| edges/s | lost of {EDGES:,} |", "|---:|---:|"]
    for rate in (25_000, 30_000, 35_000, 40_000, 50_000):
        lines.append(f"| {rate:,} | {edges(rate)[0]} |")
        print(lines[-1], flush=True)
    lines += ["", f"## Speed of the emulation ({machine()})", "", *speed()]
    (RESULTS / "board.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
