"""Both channels of the board's firmware: edge rates at which no count is lost, and flanks that it dithers over."""

import numpy as np
from board_link import EDGES, KHZ, MS, Link, load_rows

from motor_board.build import FirmwareConfig
from motor_board.emulation.chip import FREQUENCY
from motor_board.emulation.edges import Edges, Line
from motor_board.emulation.interrupts import InterruptLoad
from motor_driver.frames.from_host import Command, Ping, Setup

TWO, TWO_MEGA = FirmwareConfig(channels=2), FirmwareConfig(channels=2, chip="atmega2560")
# Both lines: A rises, B rises, A falls, B falls; a sensor with duty cycles of 44 % and 54 % and a phase of 61°.
QUARTERS = np.array(
    [Line.A_STAYS, Line.B_ALONE | Line.B_HIGH, Line.A_FALLS | Line.B_HIGH, Line.B_ALONE], dtype=np.uint8
)
BACK = np.array([Line.A_FALLS, Line.B_ALONE, Line.A_STAYS | Line.B_HIGH, Line.B_ALONE | Line.B_HIGH], dtype=np.uint8)
UNEVEN = np.array([0.0, 0.17, 0.44, 0.71])
ROOM = 4_000  # edges given to the chip at once


def folded(
    fold: int, cycles: np.ndarray, what: np.ndarray, config: FirmwareConfig = TWO
) -> tuple[Link, dict[str, InterruptLoad], int, int]:
    """A board that counts `fold` edges in a period of A through these line events, under full traffic at 1 kHz."""
    link = Link(KHZ, config)
    link.run(4, link.encoder.send(Setup(fold, 0)))
    plan = link.emulator.shaft.plan
    link.emulator._plan = lambda until: plan(until)  # type: ignore[method-assign,assignment,return-value]
    cycles = (cycles + link.chip.cycle + 2 * MS).astype(np.uint64)
    link.chip.load()
    began, link.samples = link.chip.cycle, 0
    link.drifted.clear()
    for start in range(0, len(cycles), ROOM):
        part = slice(start, start + ROOM)
        link.chip.set_edges(int(cycles[start]) - 1, Edges(cycles[part], what[part]))
        while link.chip.cycle < int(cycles[part][-1]) - MS // 2:
            ping = link.encoder.send(Ping(1)) if link.samples % 50 == 0 else b""
            left = (int(cycles[part][-1]) - MS // 4 - link.chip.cycle) / MS
            link.run(min(1.0, left), link.encoder.send(Command(0)) + ping)
    loads, slept = link.chip.load()
    ran = link.chip.cycle - began
    link.run(5, link.encoder.send(Ping(2)))
    return link, loads, slept, ran


def turning(fold: int, rate: int, config: FirmwareConfig = TWO) -> tuple[str, list[str]]:
    """A row on what came of so many line edges a second (four in a period of A), and the interrupts' table."""
    periods = np.arange(EDGES / 4) + 1e-3 * np.sin(np.arange(EDGES / 4))
    cycles = ((periods[:, None] + UNEVEN).ravel() * 4 * FREQUENCY / rate).astype(np.int64)
    link, loads, slept, ran = folded(fold, cycles, np.tile(QUARTERS, EDGES // 4), config)
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


HEAD = [
    "| counts | line edges/s | counts/s | counts lost | errors told | frames not sent | interrupts | asleep |",
    "|---|---:|---:|---:|---:|---:|---:|---:|",
]


def quadrature_on_mega() -> list[str]:
    """The same on the second chip."""
    rates = ((4, 10_000), (4, 14_000), (2, 14_000), (1, 14_000), (4, 16_000), (4, 20_000), (2, 20_000), (1, 20_000))
    return [*HEAD, *(turning(fold, rate, TWO_MEGA)[0] for fold, rate in rates), ""]


def quadrature() -> list[str]:
    """The part of the page on both channels."""
    row, table = turning(4, 20_000)
    lines = [
        "## Both channels",
        "",
        "An uneven sensor (flanks at 0, 17, 44 and 71 % of a period), commands and telemetry at 1 kHz. ×1 counts one",
        "polarity of A with B's level, as before.",
        "",
        *HEAD,
        row,
    ]
    for fold, rate in ((2, 20_000), (1, 20_000), (4, 22_000), (4, 25_000), (4, 30_000), (2, 30_000), (2, 40_000)):
        lines.append(turning(fold, rate)[0])
        print(lines[-1], flush=True)
    lines += ["", "### ×4, 20,000 edges/s", "", *table, "### A minute of dither, ×4", "", *dithering(60.0)]
    return lines
