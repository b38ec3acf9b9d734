"""What can be wrong around a board: its wiring, and between it and its computer bytes, plug and clock."""

from collections import deque
from dataclasses import dataclass

import numpy as np

from motor_board.chip import FREQUENCY, Line
from motor_board.shaft import Edges

HUM_HIGH = 0.4  # of a period of the mains that a floating line is high


@dataclass(frozen=True)
class Wiring:
    """The connections; as they stand here, all is right."""

    motor_swapped: bool = False  # the motor's two wires
    channels_swapped: bool = False  # the encoder's two channels
    a_connected: bool = True
    b_connected: bool = True
    powered: bool = True  # the motor's supply is on
    bridge_stuck: float = 0.0  # share of the full voltage that a broken bridge gives, whatever it is told; 0: it obeys
    shaft_stuck: bool = False
    hum: float = 0.0  # [Hz] of the mains, on lines that no pull-up holds
    hand: float = 0.0  # [V] with which a hand turns the shaft, as if it were at the motor

    def drive(self, share: float) -> float:
        """Of the full voltage, what the motor gets where the pins say this."""
        given = self.bridge_stuck or share
        return (-given if self.motor_swapped else given) if self.powered else 0.0

    def sense(self, edges: Edges, start: int, until: int, two: bool) -> Edges:
        """What of the encoder's edges between two cycles reaches the board's lines."""
        cycle, what = edges.cycle, edges.what
        alone = (what & Line.B_ALONE) != 0
        kept = np.where(alone, self.b_connected, self.a_connected)
        if self.channels_swapped:  # as if B were upside down: a quarter of a slot apart, nobody can tell
            what = what ^ np.uint8(Line.B_HIGH)
        if not self.b_connected:
            what = what | np.uint8(Line.B_HIGH)  # its pull-up
        heard = Edges(cycle[kept], what[kept].astype(np.uint8))
        return heard.joined(self._hum(start, until, two)) if self.hum > 0.0 else heard

    def _hum(self, start: int, until: int, two: bool) -> Edges:
        """A line that floats crosses its threshold once up and once down in a period, where B is low."""
        period = FREQUENCY / self.hum
        rises = np.arange(np.ceil(start / period), np.ceil(until / period)) * period
        falls = np.arange(np.ceil(start / period - HUM_HIGH), np.ceil(until / period - HUM_HIGH)) + HUM_HIGH
        up = Edges.alike(rises.astype(np.uint64), Line.A_STAYS if two else Line(0))
        return up.joined(Edges.alike((falls * period).astype(np.uint64), Line.A_FALLS)) if two else up


@dataclass(frozen=True)
class Faults(Wiring):
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
