"""How motor, encoder and supply are connected to the emulated board, and what of that can be wrong."""

from dataclasses import dataclass

import numpy as np

from motor_board.emulation.chip import FREQUENCY
from motor_board.emulation.edges import Edges, Line

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
        if self.a_connected and self.b_connected and not self.channels_swapped and self.hum <= 0.0:
            return edges
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
