"""A million damaged frames through the driver's decoder: how many are lost, and that none comes out wrong.

1 bit in 1,000 flips, bytes are lost and doubled, frames are cut by resets and swapped for noise; every frame that is
returned has to be the one that was sent under its number.
"""

import sys
import time
from pathlib import Path

import numpy as np
from machine import machine
from numpy.typing import NDArray

from motor_driver.frames.from_board import Telemetry
from motor_driver.protocol import Arrival, Decoder, pack

RESULTS = Path(__file__).with_name("results")
BLOCK = 50_000  # frames, fewer than numbers
DAMAGED = 1_000_000
Damage = tuple[str, float]  # kind, rate
Bytes = NDArray[np.uint8]
DAMAGES: tuple[Damage, ...] = (
    ("bits flip", 1e-3),
    ("bits flip", 1e-2),
    ("bytes are lost", 1e-2),
    ("bytes are doubled", 1e-2),
    ("runs of noise", 1e-2),
)


def damaged(wire: Bytes, damage: Damage, random: np.random.Generator) -> tuple[bytes, NDArray[np.bool_]]:
    """The bytes after what happens to them, and which of the original ones it happened to."""
    kind, rate = damage
    if kind == "bits flip":
        flips = np.packbits(random.random((len(wire), 8)) < rate, axis=1)[:, 0]
        return bytes(wire ^ flips), flips != 0
    hit = random.random(len(wire)) < rate
    if kind == "bytes are lost":
        return bytes(wire[~hit]), hit
    if kind == "bytes are doubled":
        return bytes(np.repeat(wire, 1 + hit)), hit
    noise = np.convolve(hit, np.ones(5), mode="same") > 0
    after = np.where(noise, random.integers(0, 256, len(wire), dtype=np.uint8), wire)
    return bytes(after), after != wire


def run(damage: Damage, random: np.random.Generator) -> tuple[int, int, int, int, int]:
    """Frames sent, damaged, returned, wrong, and undamaged ones missing after another undamaged one."""
    sent = touched = returned = wrong = beyond = 0
    while touched < DAMAGED // len(DAMAGES):
        values = random.integers(0, 2**16, (BLOCK, 9)) & ([65535] * 7 + [255] * 2)
        frames = [Telemetry(int(row[0]), int(row[1]) - 2**15, *map(int, row[2:9]), boot=1, latch=0) for row in values]
        wires = [pack(frame, seq) for seq, frame in enumerate(frames)]
        wire = np.frombuffer(b"".join(wires), dtype=np.uint8)
        after, hit = damaged(wire, damage, random)
        starts = np.cumsum([0, *map(len, wires[:-1])])
        intact = ~np.logical_or.reduceat(hit, starts)
        events = [event for event in Decoder().receive(after) if isinstance(event, Arrival)]
        whole = np.zeros(BLOCK, dtype=bool)
        whole[[event.seq for event in events if event.seq < BLOCK]] = True
        wrong += sum(event.seq >= BLOCK or event.frame != frames[event.seq] for event in events)
        beyond += int(np.sum(intact[1:] & intact[:-1] & ~whole[1:]))
        sent, touched, returned = sent + BLOCK, touched + int(np.sum(~intact)), returned + len(events)
    return sent, touched, returned, wrong, beyond


def main() -> int:
    """Write results/wire_fuzz.md."""
    random = np.random.default_rng(1)
    lines = [
        "# A million damaged frames",
        "",
        f"Through `motor_driver.protocol.Decoder`. {machine()}.",
        "",
        "| what happens | rate | frames sent | damaged | returned | wrong | undamaged after undamaged, missing |",
        "|---|---:|---:|---:|---:|---:|---:|",
    ]
    began, all_wrong = time.perf_counter(), 0
    for damage in DAMAGES:
        sent, touched, returned, wrong, beyond = run(damage, random)
        all_wrong += wrong + beyond
        lines.append(f"| {damage[0]} | {damage[1]:g} | {sent:,} | {touched:,} | {returned:,} | {wrong} | {beyond} |")
        print(lines[-1], flush=True)
    print(f"{time.perf_counter() - began:.0f} s")
    (RESULTS / "wire_fuzz.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return all_wrong > 0


if __name__ == "__main__":
    sys.exit(main())
