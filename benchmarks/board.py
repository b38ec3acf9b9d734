"""The board's firmware on the emulated ATmega328P: size, interrupt load, highest edge rate, speed of emulation.

Cycle counts are the emulated processor's and the same on every machine; only the last table depends on the computer.
"""

import subprocess
import sys
import time
from pathlib import Path

import numpy as np
from machine import machine

from motor_board.build import FirmwareConfig, firmware
from motor_board.chip import FREQUENCY, InterruptLoad, Line
from motor_board.emulator import Emulator
from motor_board.shaft import EncoderConfig
from motor_driver.frames import Command, Configure, Enable, Ping, Setup, Telemetry
from motor_driver.protocol import Arrival, Decoder, Encoder
from motor_model.parameters import paper_motor

RESULTS = Path(__file__).with_name("results")
MS = FREQUENCY // 1000
EDGES = 8_000  # at each rate
KHZ = 2_000  # [tick] sample period
TWO = FirmwareConfig(channels=2)
# Both lines: A rises, B rises, A falls, B falls; a sensor with duty cycles of 44 % and 54 % and a phase of 61°.
QUARTERS = np.array(
    [Line.A_STAYS, Line.B_ALONE | Line.B_HIGH, Line.A_FALLS | Line.B_HIGH, Line.B_ALONE], dtype=np.uint8
)
BACK = np.array([Line.A_FALLS, Line.B_ALONE, Line.A_STAYS | Line.B_HIGH, Line.B_ALONE | Line.B_HIGH], dtype=np.uint8)
UNEVEN = np.array([0.0, 0.17, 0.44, 0.71])
ROOM = 4_000  # edges given to the chip at once


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


def size() -> list[str]:
    """Flash and RAM."""
    rows = ["| flashed for | flash, of 32,256 bytes | static RAM, of 2,048 bytes |", "|---|---:|---:|"]
    for name, config in (("one channel", FirmwareConfig()), ("two channels (×1, ×2, ×4)", TWO)):
        done = subprocess.run(["avr-size", str(firmware(config))], capture_output=True, text=True, check=True)
        text, data, bss = map(int, done.stdout.splitlines()[1].split()[:3])
        rows.append(f"| {name} | {text + data:,} | {data + bss} |")
    return [*rows, ""]


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


def folded(fold: int, cycles: np.ndarray, what: np.ndarray) -> tuple[Link, dict[str, InterruptLoad], int, int]:
    """A board that counts `fold` edges in a period of A through these line events, under full traffic at 1 kHz."""
    link = Link(KHZ, TWO)
    link.run(4, link.encoder.send(Setup(fold, 0)))
    plan = link.emulator.shaft.plan
    link.emulator._plan = lambda until: plan(until)  # type: ignore[method-assign,assignment,return-value]
    cycles = (cycles + link.chip.cycle + 2 * MS).astype(np.uint64)
    link.chip.load()
    began, link.samples = link.chip.cycle, 0
    link.drifted.clear()
    for start in range(0, len(cycles), ROOM):
        part = slice(start, start + ROOM)
        link.chip.set_edges(int(cycles[start]) - 1, cycles[part], what[part])
        while link.chip.cycle < int(cycles[part][-1]) - MS // 2:
            ping = link.encoder.send(Ping(1)) if link.samples % 50 == 0 else b""
            left = (int(cycles[part][-1]) - MS // 4 - link.chip.cycle) / MS
            link.run(min(1.0, left), link.encoder.send(Command(0)) + ping)
    loads, slept = link.chip.load()
    ran = link.chip.cycle - began
    link.run(5, link.encoder.send(Ping(2)))
    return link, loads, slept, ran


def turning(fold: int, rate: int) -> tuple[str, list[str]]:
    """A row on what came of so many line edges a second (four in a period of A), and the interrupts' table."""
    periods = np.arange(EDGES / 4) + 1e-3 * np.sin(np.arange(EDGES / 4))
    cycles = ((periods[:, None] + UNEVEN).ravel() * 4 * FREQUENCY / rate).astype(np.int64)
    link, loads, slept, ran = folded(fold, cycles, np.tile(QUARTERS, EDGES // 4))
    lost = EDGES * fold // 4 - link.telemetry.edge_count
    due = round(ran / MS)
    share = sum(load.cycles for load in loads.values()) / ran
    row = (
        f"| ×{fold} | {rate:,} | {rate * fold // 4:,} | {lost} of {EDGES * fold // 4:,} | {link.telemetry.errors} "
        f"| {max(due - link.samples, 0)} of {due} | {share:.0%} | {slept / ran:.0%} |"
    )
    table = load_rows(loads, slept, ran)
    link.close()
    return row, table


def dithering(seconds: float) -> list[str]:
    """To and fro over each of the four flanks in turn, a quarter of the time each, 20 us to 5 ms apart."""
    rows = ["| about | turns back | counts seen | drift | errors |", "|---|---:|---|---:|---:|"]
    random = np.random.default_rng(0)
    for flank, name in enumerate(("A's rising flank", "B's rising flank", "A's falling flank", "B's falling flank")):
        gaps = np.exp(random.uniform(np.log(20e-6), np.log(5e-3), int(seconds / 4 / 0.9e-3)))
        gaps = gaps[: len(gaps) // 2 * 2]
        what = np.concatenate([QUARTERS[:flank], np.tile([QUARTERS[flank], BACK[flank]], len(gaps) // 2)])
        times = np.concatenate([1e-3 * np.arange(flank), 1e-3 * flank + np.cumsum(gaps)])
        link, *_ = folded(4, (times * FREQUENCY).astype(np.int64), what)
        seen = sorted(link.drifted - set(range(flank)) | {flank})
        rows.append(
            f"| {name} | {len(gaps):,} | {', '.join(map(str, seen))} | {link.telemetry.edge_count - flank} "
            f"| {link.telemetry.errors} |"
        )
        link.close()
    return [*rows, ""]


def quadrature() -> list[str]:
    """The part of the page on both channels."""
    row, table = turning(4, 20_000)
    lines = [
        "## Both channels",
        "",
        "An uneven sensor (flanks at 0, 17, 44 and 71 % of a period), commands and telemetry at 1 kHz. ×1 counts one",
        "polarity of A with B's level, as before.",
        "",
        "| counts | line edges/s | counts/s | counts lost | errors told | frames not sent | interrupts | asleep |",
        "|---|---:|---:|---:|---:|---:|---:|---:|",
        row,
    ]
    for fold, rate in ((2, 20_000), (1, 20_000), (4, 22_000), (4, 25_000), (4, 30_000), (2, 30_000), (2, 40_000)):
        lines.append(turning(fold, rate)[0])
        print(lines[-1], flush=True)
    lines += ["", "### ×4, 20,000 edges/s", "", *table, "### A minute of dither, ×4", "", *dithering(60.0)]
    return lines


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
    lines += ["", *quadrature(), f"## Speed of the emulation ({machine()})", "", *speed()]
    (RESULTS / "board.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
