"""The motor on the emulated board's pins: the one compiled model, advanced along the chip's clock."""

from collections import deque
from dataclasses import dataclass
from fractions import Fraction
from math import inf, tau

import numpy as np
from numpy.typing import NDArray

from motor_board.emulation.chip import FREQUENCY
from motor_board.emulation.edges import Edges, edges_at_captures, edges_at_flanks, level_before
from motor_model.dynamics.bridge import effective_voltage
from motor_model.dynamics.current import current_at
from motor_model.dynamics.state import State, at_rest
from motor_model.effects import INDEX
from motor_model.gearing.gear import exact_gear
from motor_model.parameters import Parameters
from motor_model.sensing.encoder import Lines, make_disc, make_lines_disc, next_flank, shown_angle, turn

DELAY, MISS_RATE = INDEX["delay"], INDEX["miss_rate"]
SLIDING, BREAKAWAY = INDEX["ks"], INDEX["breakaway_voltage"]
MOST_VOLTAGE = 1e4  # [V] that moves no blocked shaft
MOST_EDGES = 2048  # in one step


@dataclass(frozen=True)
class EncoderConfig:
    """The disc and its sensor."""

    edges_per_revolution: int = 96
    slot_irregularity: float = 0.0  # share of a slot
    seed: int = 0  # of the disc, its starting angle and missed edges
    start_angle: float | None = None  # [rad] of the disc; None: drawn from the seed
    channels: int = 1
    lines: Lines | None = None  # every flank of both channels reaches the board; None: A's, and B only at these
    gear: Fraction | None = None  # encoder turns per turn of the output; None: as the motor's


class Shaft:
    """A motor with its encoder, planned ahead under the present voltage and cut back when that changes."""

    def __init__(self, parameters: Parameters, encoder: EncoderConfig) -> None:
        self._p, self._two = parameters.vector(), encoder.channels == 2
        gear = float(exact_gear(parameters.gear_ratio) if encoder.gear is None else encoder.gear)
        self._p[INDEX["gear_ratio"]], self._lines = gear, encoder.lines is not None
        shape = (encoder.slot_irregularity, encoder.seed, gear)
        if encoder.lines is None:
            self._disc = make_disc(encoder.edges_per_revolution, *shape)
        else:
            self._disc = make_lines_disc(encoder.edges_per_revolution, 4, *shape, encoder.lines)
        self._random = np.random.default_rng([encoder.seed, 1])
        drawn = float(self._random.uniform(0.0, tau))
        self._offset = drawn if encoder.start_angle is None else encoder.start_angle
        self._cycle, self._state = 0, at_rest(0.0)  # where the present plan starts
        self._planned, self._then = 0, self._state  # where it ends
        self._commands: deque[tuple[float, float]] = deque([(-inf, 0.0)])  # [s], [V] at the bridge's input
        self._hand, self._free = 0.0, self._p.copy()
        self._times, self._directions = np.empty(MOST_EDGES), np.empty(MOST_EDGES, dtype=np.int64)

    @property
    def speed(self) -> float:
        """[rad/s] true shaft speed, at most one step ago."""
        return float(self._state.speed)

    @property
    def angle(self) -> float:
        """[rad] true shaft angle since power-up, at most one step ago."""
        return float(self._state.angle)

    @property
    def voltage(self) -> float:
        """[V] that the board commands."""
        return self._commands[-1][1]

    def current_at(self, cycle: int) -> float:
        """[A] through the motor at a cycle of the present plan; 0 where its resistance is unknown."""
        if self._p[INDEX["resistance"]] == 0.0:
            return 0.0
        t, delay = cycle / FREQUENCY, float(self._p[DELAY])
        acting = next((volts for at, volts in reversed(self._commands) if at + delay < t), 0.0)
        u = effective_voltage(self._p, acting) + self._hand
        return float(current_at(self._p, u, self._advance(max(cycle, self._cycle))[0], t))

    def hold(self, stuck: bool, hand: float) -> None:
        """From the next plan on, something blocks the shaft, and a hand turns it as if with so many volts more."""
        self._hand = hand
        self._p[BREAKAWAY] = MOST_VOLTAGE if stuck else self._free[BREAKAWAY]
        self._p[SLIDING] = MOST_VOLTAGE if stuck else self._free[SLIDING]

    @property
    def planned(self) -> int:
        """The cycle up to which edges are known if the voltage stays."""
        return self._planned

    def plan(self, until: int) -> Edges:
        """The edges from the end of the present plan to this cycle, if the voltage stays."""
        self._start(self._planned, self._then)
        self._then, times, directions = self._advance(until)
        begun, self._planned = self._planned == 0, until
        if self._lines:
            return self._line_edges(times, directions, begun)
        if self._p[MISS_RATE] > 0.0:
            seen = (self._random.random(len(times)) >= self._p[MISS_RATE]) | (np.abs(directions) == 2)
            times, directions = times[seen], directions[seen]
        return edges_at_captures(_cycles(times), directions, self._two)

    def _line_edges(self, times: NDArray[np.float64], directions: NDArray[np.int64], begun: bool) -> Edges:
        """All flanks of both lines; at power-up first their levels."""
        flanks, here = self._disc.forward, shown_angle(self._p, self._state.angle) + self._offset
        first = next_flank(flanks, here, 1, tau / self._p[INDEX["gear_ratio"]])
        edges = edges_at_flanks(_cycles(times), directions, first)
        return level_before(first).joined(edges) if begun else edges

    def drive(self, cycle: int, share: float) -> None:
        """The pins ask for a share of the full voltage (−1 to 1) from a cycle on; what was planned beyond it is void.

        A cycle before the present plan (the chip runs behind by some 60 cycles) counts as that plan's start.
        """
        if cycle > self._cycle:
            self._start(cycle, self._advance(cycle)[0])
        self._planned, self._then = self._cycle, self._state
        self._commands.append((self._cycle / FREQUENCY, share * float(self._p[INDEX["max_voltage"]])))

    def _start(self, cycle: int, state: State) -> None:
        """Move to a cycle for good, and forget commands that are over by then."""
        self._cycle, self._state = cycle, state
        while len(self._commands) > 1 and self._commands[1][0] + float(self._p[DELAY]) <= cycle / FREQUENCY:
            self._commands.popleft()

    def _advance(self, until: int) -> tuple[State, NDArray[np.float64], NDArray[np.int64]]:
        """State at a cycle, and the times [s] and directions of the edges up to there, under the delayed commands."""
        t, end, delay = self._cycle / FREQUENCY, until / FREQUENCY, float(self._p[DELAY])
        state, count = self._state, 0
        switches = [at + delay for at, _ in self._commands][1:]
        for (_, command), switch in zip(self._commands, [*switches, inf], strict=True):
            stop = min(switch, end)
            if stop > t:
                u = effective_voltage(self._p, command) + self._hand
                times, directions = self._times[count:], self._directions[count:]
                disc = self._disc
                state, passed = turn(
                    *(self._p, u, state, t, stop - t, disc.forward, disc.backward, self._offset),
                    *(times, directions, self._two and not self._lines),
                )
                t, count = stop, count + passed
        return state, self._times[:count].copy(), self._directions[:count].copy()


def _cycles(times: NDArray[np.float64]) -> NDArray[np.uint64]:
    return np.rint(times * FREQUENCY).astype(np.uint64)
