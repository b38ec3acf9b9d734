"""What an encoder board reports of stamped edges at each sample: counts, the latest stamp and period, a signed speed.

A single channel does not measure direction. The rule of `MotorSpeed.msg`, read here as an honest board would run it,
edge by edge, with nothing but stamps and the voltages it latched:

- After 0.1 s without an edge (and before the first) the motor stands; the next edge has the sign of the latest voltage
  other than 0 that was latched before it.
- While moving, the sign turns at the edge that shows a period maximum to have passed after the latched voltage turned
  against the sign: its period is below 0.8 of the longest one since then (1 % of irregular slots makes no such step).
  A motor that was still speeding up when the voltage turned gets no maximum before its periods have grown again, as
  a delayed bridge goes on speeding it up. A voltage that turns back disarms the rule.

So the sign is wrong for a slot or two around a fast reversal, and for longer where a load drives the motor against the
voltage or a reversal leaves no maximum: that is what one channel can know. Before the second edge the speed is 0.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
STANDSTILL = 100_000_000  # [ns] without an edge


@dataclass(frozen=True)
class Report:
    """The encoder's columns of a recording; every array has shape (K,)."""

    speed: Floats  # [rad/s]
    edge_count: Integers
    edge_time: Integers  # [ns] 0 before the first
    edge_period: Floats  # [s] 0 before the second
    latest_edge: Integers  # number of the edge that edge_time is; -1 before the first


@dataclass
class SignOfOneChannel:
    """The direction a single channel may claim, told of voltages and periods in order of time."""

    sign: int = 0
    wanted: int = 1  # of the latest voltage other than 0
    armed: bool = False
    speeding_up: bool = False
    longest: float = 0.0  # [s] period since the voltage turned
    periods: list[float] = field(default_factory=lambda: [0.0, 0.0])

    def voltage(self, volts: float) -> None:
        """A voltage is latched."""
        wanted = (volts > 0.0) - (volts < 0.0) or self.wanted
        if wanted != self.wanted:
            self.armed = wanted == -self.sign
            self.speeding_up = not self.periods[1] >= 0.9 * self.periods[0] > 0.0  # or has only just started
            self.longest = self.periods[1]
        self.wanted = wanted

    def edge(self, period: float, stood: bool) -> None:
        """An edge has come, `period` seconds after the one before it, which may have been before a standstill."""
        if stood:
            self.sign, self.armed, period = self.wanted, False, 0.0
        elif self.armed and self.speeding_up:
            self.speeding_up = period < 1.1 * self.periods[1]
            self.longest = period
        elif self.armed and period < 0.8 * self.longest:
            self.sign, self.armed = -self.sign, False
        elif period > self.longest:
            self.longest = period
        self.periods = [self.periods[1], period]


def report(
    sample_time: Integers,
    voltage: Floats,
    seen: Integers,
    stamps: Integers,
    ways: Integers,
    slots: int,
    single: bool,
    back: NDArray[np.bool_] | None = None,
) -> Report:
    """What the board says at each sample.

    Args:
        sample_time: [ns] shape (K,).
        voltage: [V] latched at each sample, shape (K,).
        seen: edges that have been counted by each sample, shape (K,).
        stamps: [ns] of the edges that are counted, shape (E,).
        ways: +1 or -1, true direction of those edges, shape (E,); only a second channel sees it.
        slots: edges of one polarity a turn.
        single: one channel counts every edge up; two count down backward and know the sign at each edge.
        back: which edges are the way back over the flank of the edge before, shape (E,): beside them is no period.
    """
    latest = seen - 1
    periods = np.diff(stamps, prepend=stamps[:1]) * 1e-9
    if back is not None:
        periods[back | np.concatenate([[False], back[:-1]])] = 0.0
    moved = np.ones_like(ways) if single else ways
    counts = np.concatenate([[0], np.cumsum(moved)])[seen]
    signs = _signs(voltage, seen, stamps, periods) if single else np.concatenate([[0], ways])[seen]
    if len(stamps) == 0:
        nothing = np.zeros(len(sample_time))
        return Report(nothing, counts, counts.copy(), nothing.copy(), latest)
    edge_time = np.where(seen > 0, stamps[np.maximum(latest, 0)], 0)
    edge_period = np.where(seen > 1, periods[np.maximum(latest, 0)], 0.0)
    since = sample_time - edge_time
    moving = (seen > 1) & (since <= STANDSTILL) & (edge_period > 0.0)
    slowest = np.maximum(np.where(moving, edge_period, 1.0), since * 1e-9)
    speed = np.where(moving, signs * 2.0 * np.pi / slots / slowest, 0.0)
    return Report(speed, counts, edge_time, edge_period, latest)


def _signs(voltage: Floats, seen: Integers, stamps: Integers, periods: Floats) -> Integers:
    """Sign that one channel claims at each sample, shape (K,)."""
    rule = SignOfOneChannel()
    stood = np.diff(stamps, prepend=np.iinfo(np.int64).min // 2) > STANDSTILL
    edges = list(zip(periods.tolist(), stood.tolist(), strict=True))
    signs, told, before = [], 0, np.nan
    for volts, count in zip(voltage.tolist(), seen.tolist(), strict=True):
        for period, after_standstill in edges[told:count]:
            rule.edge(period, after_standstill)
        told = count
        signs.append(rule.sign)
        if volts != before:  # the same again tells the rule nothing
            rule.voltage(volts)
            before = volts
    return np.array(signs, dtype=np.int64)
