"""What can be wrong between a board and its computer: bytes that change, vanish or come late, a plug that is out."""

from collections import deque
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Faults:
    """The switches; as they stand here, nothing is wrong."""

    bit_error_rate: float = 0.0  # share of bits flipped, both ways
    drop_rate: float = 0.0  # share of bytes lost, both ways
    delay: float = 0.0  # [s] bytes come late by 0 … delay, both ways, in order
    plugged: bool = True  # false: the port is gone; the board runs on its own supply
    stuck_telemetry: bool = False  # the board is heard no more, but hears
    encoder_connected: bool = True
    stray_edges: float = 0.0  # [1/s] that the encoder's line picks up
    reset_on_open: bool = False  # as an Uno, which is reset when its port is opened
    clock_error: float = 0.0  # [ppm] by which the board's crystal is fast


class Wire:
    """One direction of a serial line with its faults; time in ns, from the caller."""

    def __init__(self, seed: int) -> None:
        self._random = np.random.default_rng(seed)
        self._late: deque[tuple[int, bytes]] = deque()  # [ns] when due; nothing overtakes what is before it

    def send(self, data: bytes, faults: Faults, now: int) -> None:
        """Bytes go in at `now`."""
        if faults.bit_error_rate > 0.0 or faults.drop_rate > 0.0:
            data = self._damaged(data, faults)
        due = now
        if faults.delay > 0.0:
            due += int(self._random.uniform(0.0, faults.delay) * 1e9)
        if data:
            self._late.append((due, data))

    def receive(self, now: int) -> bytes:
        """What has come out by `now`."""
        out = b""
        while self._late and self._late[0][0] <= now:
            out += self._late.popleft()[1]
        return out

    def cut(self) -> None:
        """What is on its way is lost."""
        self._late.clear()

    def _damaged(self, data: bytes, faults: Faults) -> bytes:
        array = np.frombuffer(data, dtype=np.uint8)
        flips = self._random.random((len(array), 8)) < faults.bit_error_rate
        kept = self._random.random(len(array)) >= faults.drop_rate
        return bytes((array ^ np.packbits(flips, axis=1)[:, 0])[kept])
