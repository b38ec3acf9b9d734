"""The emulated board: firmware on its chip, motor on its pins, advanced in lockstep; no wall clock, no port."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from motor_board.emulation.chip import FREQUENCY, Chip
from motor_board.emulation.edges import NO_EDGES, Edges, Line
from motor_board.emulation.shaft import EncoderConfig, Shaft
from motor_board.emulation.wiring import Wiring
from motor_model.parameters import Parameters

STEP = FREQUENCY // 1000  # [cycle] the motor is planned ahead by at most
SENSE_NOISE = 0.005  # [V] RMS on A1, one step of the converter
SENSE_HELD = 256  # [cycle] from a conversion's start to the converter's holding its input: 12 to 20 µs
AHEAD = 64  # [cycle] more than the chip can run beyond its goal


@dataclass(frozen=True)
class CurrentSensor:
    """What a Hall sensor, or a shunt with its amplifier, makes of a current: an ACS712-05 by default."""

    gain: float = 0.185  # [V/A]
    offset: float = 2.5  # [V] at 0 A


class Emulator:
    """A board that runs when told to; time is the chip's cycle count."""

    def __init__(self, elf: Path, parameters: Parameters, encoder: EncoderConfig | None = None) -> None:
        """Raises: BoardError: the ELF or the emulator's library cannot be used."""
        self.chip = Chip(elf)
        self.encoder = encoder or EncoderConfig()
        self.shaft = Shaft(parameters, self.encoder)
        self.encoder_connected = True
        self.sensor = CurrentSensor()
        self.stray_edges = 0.0  # [1/s] that the line picks up, at random
        self._random = np.random.default_rng([self.encoder.seed, 2])
        self._wiring, self._volts_at_a0 = Wiring(), 0.0
        self._edges = NO_EDGES  # of the latest plan
        self._passed = 0  # of the next plan, those that have come already

    def run(self, until: int) -> None:
        """Run to a cycle (at most 5 beyond it).

        Raises:
            BoardError: the firmware has crashed.
        """
        while (now := self.chip.cycle) < until:
            goal = min(until, now + STEP)
            if self.shaft.planned < goal + AHEAD:
                self._plan(goal + AHEAD)
            changed, sensing = self.chip.run(goal), self.chip.sensing
            if sensing:  # before what has changed since
                self._sense(sensing)
            if changed:
                self._drive(self.chip.written)

    @property
    def wiring(self) -> Wiring:
        """How motor, encoder and supply are connected; assign to change that."""
        return self._wiring

    @wiring.setter
    def wiring(self, wiring: Wiring) -> None:
        if wiring != self._wiring:
            self._wiring = wiring
            self.shaft.hold(wiring.shaft_stuck, wiring.hand)
            self.supply(self._volts_at_a0)
            self._drive(self.chip.cycle)

    def supply(self, volts_at_a0: float) -> None:
        """What the motor's supply puts on A0 [V], while it is on."""
        self._volts_at_a0 = volts_at_a0
        self.chip.supply(volts_at_a0 if self._wiring.powered else 0.0)

    def _sense(self, cycle: int) -> None:
        """Put the current on A1 that a conversion from this cycle on reads, by a sensor between bridge and motor."""
        current = self.shaft.current_at(cycle + SENSE_HELD) * (-1.0 if self._wiring.motor_swapped else 1.0)
        noise = float(self._random.normal(0.0, SENSE_NOISE))
        self.chip.sense(self.sensor.offset + self.sensor.gain * current + noise)

    def _plan(self, until: int) -> None:
        """Tell the chip which edges come up to a cycle, in place of what was void."""
        known = self.shaft.planned
        self._edges = self.shaft.plan(until)
        edges = self._edges.after(self._passed) if self.encoder_connected else NO_EDGES
        self._passed = 0
        start = max(known, self.chip.cycle + AHEAD)
        edges = self._wiring.sense(edges, start, until, self.encoder.channels == 2)
        if self.stray_edges > 0.0:
            edges = edges.joined(self._strays(start, until))
        self.chip.set_edges(known, edges)

    def _strays(self, start: int, until: int) -> Edges:
        """Pulses that no flank has made."""
        count = self._random.poisson(self.stray_edges * max(until - start, 0) / FREQUENCY)
        return Edges.alike(self._random.integers(start, max(until, start + 1), count).astype(np.uint64), Line(0))

    def _drive(self, cycle: int) -> None:
        """The motor gets what the pins say since a cycle; the edges that came since are not to come again."""
        self.shaft.drive(cycle, self._wiring.drive(self.chip.pins.share))
        since = self._edges.cycle > self.shaft.planned
        self._passed = int(np.count_nonzero(since & (self._edges.cycle <= self.chip.cycle)))

    def reset(self) -> None:
        """Press the board's reset button: its pins let go at once."""
        self.chip.reset()
        self._drive(self.chip.cycle)

    def power_up(self) -> None:
        """Switch the board's power off and on: it has forgotten all but its EEPROM."""
        self.chip.power_up()
        self._drive(self.chip.cycle)

    def close(self) -> None:
        """Give the memory back."""
        self.chip.close()
