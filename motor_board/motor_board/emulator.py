"""The emulated board: firmware on its chip, motor on its pins, advanced in lockstep; no wall clock, no port."""

from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from motor_board.chip import FREQUENCY, Chip
from motor_board.shaft import Edges, EncoderConfig, Shaft
from motor_model.parameters import Parameters

STEP = FREQUENCY // 1000  # [cycle] the motor is planned ahead by at most
AHEAD = 64  # [cycle] more than the chip can run beyond its goal
Cycles: TypeAlias = NDArray[np.uint64]
Levels: TypeAlias = NDArray[np.uint8]
NO_CYCLES, NO_LEVELS = np.empty(0, dtype=np.uint64), np.empty(0, dtype=np.uint8)


class Emulator:
    """A board that runs when told to; time is the chip's cycle count."""

    def __init__(self, elf: Path, parameters: Parameters, encoder: EncoderConfig | None = None) -> None:
        """Raises: BoardError: the ELF or the emulator's library cannot be used."""
        self.chip = Chip(elf)
        self.encoder = encoder or EncoderConfig()
        self.shaft = Shaft(parameters, self.encoder)
        self.encoder_connected = True
        self.stray_edges = 0.0  # [1/s] that the line picks up, at random
        self._random = np.random.default_rng([self.encoder.seed, 2])
        self._edges = Edges(NO_CYCLES, NO_LEVELS)  # of the latest plan
        self._passed = 0  # of the next plan, those that have come already

    def run(self, until: int) -> None:
        """Run to a cycle (at most 5 beyond it).

        Raises:
            BoardError: the firmware has crashed.
        """
        while self.chip.cycle < until:
            goal = min(until, self.chip.cycle + STEP)
            if self.shaft.planned < goal + AHEAD:
                self._plan(goal + AHEAD)
            if self.chip.run(goal):
                self._drive(self.chip.written)

    def _plan(self, until: int) -> None:
        """Tell the chip which edges come up to a cycle, in place of what was void."""
        known = self.shaft.planned
        self._edges = self.shaft.plan(until)
        cycles, what = self._edges.cycle[self._passed :], self._edges.what[self._passed :]
        self._passed = 0
        if not self.encoder_connected:
            cycles, what = NO_CYCLES, NO_LEVELS
        if self.stray_edges > 0.0:
            cycles, what = self._with_strays(max(known, self.chip.cycle + AHEAD), until, cycles, what)
        self.chip.set_edges(known, cycles, what)

    def _with_strays(self, start: int, until: int, cycles: Cycles, what: Levels) -> tuple[Cycles, Levels]:
        """Add pulses that no flank has made."""
        count = self._random.poisson(self.stray_edges * max(until - start, 0) / FREQUENCY)
        strays = self._random.integers(start, max(until, start + 1), count).astype(np.uint64)
        every = np.concatenate([cycles, strays])
        order = np.argsort(every, kind="stable")
        return every[order], np.concatenate([what, np.zeros(count, dtype=np.uint8)])[order]

    def _drive(self, cycle: int) -> None:
        """The motor gets what the pins say since a cycle; the edges that came since are not to come again."""
        self.shaft.drive(cycle, self.chip.pins.share)
        since = self._edges.cycle > self.shaft.planned
        self._passed = int(np.count_nonzero(since & (self._edges.cycle <= self.chip.cycle)))

    def reset(self) -> None:
        """Press the board's reset button: its pins let go at once."""
        self.chip.reset()
        self._drive(self.chip.cycle)

    def close(self) -> None:
        """Give the memory back."""
        self.chip.close()
