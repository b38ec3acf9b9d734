"""The board's firmware on the emulated chips: size, interrupt load, highest edge rate, speed of emulation.

Cycle counts are the emulated processor's and the same on every machine; only the last table depends on the computer.
"""

import subprocess
import sys
import time
from pathlib import Path

import numpy as np
from board_link import EDGES, KHZ, MS, Link, load_rows
from board_quadrature import TWO, TWO_MEGA, quadrature, quadrature_on_mega
from machine import commit, machine

from motor_board.build import FirmwareConfig, firmware
from motor_board.emulation.chip import FREQUENCY
from motor_board.emulation.edges import Edges

RESULTS = Path(__file__).with_name("results")
MEGA = FirmwareConfig(chip="atmega2560")

MEGA_NOTE = """\
There the serial port's interrupts come before the capture unit's (25 and 26 before 46; on the ATmega328P 18 and 19
after 10), so that an edge may wait 48 us for its turn instead of 24. Its time is none the worse, but B's level is read
that late: it has to hold for as long after A's flank, or counts are lost, at ×1 and ×2 without an error. With 50 us
between A's and B's flanks nothing is lost: 14,000 line edges a second of this sensor, whose channels are 61° apart, and
by the same sum 20,000 of one with 90°."""


def size() -> list[str]:
    """Flash and RAM."""
    rows = ["| flashed for | flash [bytes] | static RAM [bytes] |", "|---|---:|---:|"]
    for name, config in (
        ("ATmega328P (of 32,256 and 2,048), one channel", FirmwareConfig()),
        ("two channels (×1, ×2, ×4)", TWO),
        ("ATmega2560 (of 253,952 and 8,192), one channel", MEGA),
        ("two channels (×1, ×2, ×4)", TWO_MEGA),
    ):
        done = subprocess.run(["avr-size", str(firmware(config))], capture_output=True, text=True, check=True)
        text, data, bss = map(int, done.stdout.splitlines()[1].split()[:3])
        rows.append(f"| {name} | {text + data:,} | {data + bss} |")
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


def edges(rate: int, config: FirmwareConfig | None = None) -> tuple[int, list[str]]:
    """Edges lost at a rate [1/s] under full traffic at 1 kHz, and the interrupts' table."""
    link = Link(KHZ, config)
    first = link.chip.cycle + 5 * MS
    cycles = (first + (FREQUENCY / rate + 0.37) * np.arange(EDGES)).astype(np.uint64)  # drifts through all phases
    plan = link.emulator.shaft.plan
    link.emulator._plan = lambda until: plan(until)  # type: ignore[method-assign,assignment,return-value]
    link.chip.set_edges(first - 1, Edges(cycles, np.zeros(EDGES, dtype=np.uint8)))
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


def mega() -> list[str]:
    """What is other on the ATmega2560."""
    lost, table = edges(20_000, MEGA)
    lines = ["## ATmega2560", "", "1 kHz, 20,000 edges/s on one channel:", "", *table]
    lines += [f"Edges lost: {lost} of {EDGES:,}; at 30,000 a second {edges(30_000, MEGA)[0]}, at 40,000"]
    lines += [f"{edges(40_000, MEGA)[0]}. Two channels, the same uneven sensor:", "", *quadrature_on_mega()]
    return [*lines, MEGA_NOTE, ""]


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
    lines = ["# The board's firmware on the emulated chips (16 MHz)", "", *size()]
    lines += [f"`python benchmarks/board.py` at {commit()}. Unless it says otherwise, on the ATmega328P.", ""]
    lines += full_speed()
    lost, table = edges(20_000)
    lines += ["## 1 kHz, 20,000 edges/s", "", *table, f"Edges lost: {lost} of {EDGES:,}.", ""]
    lines += ["## Highest edge rate without loss", "", f"| edges/s | lost of {EDGES:,} |", "|---:|---:|"]
    for rate in (25_000, 30_000, 35_000, 40_000, 50_000):
        lines.append(f"| {rate:,} | {edges(rate)[0]} |")
        print(lines[-1], flush=True)
    lines += ["", *quadrature(), *mega(), f"## Speed of the emulation ({machine()})", "", *speed()]
    (RESULTS / "board.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
