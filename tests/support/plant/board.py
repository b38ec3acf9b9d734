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

from dataclasses import dataclass

import numpy as np
from numba import njit
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


# sign; that of the latest voltage other than 0; armed; still speeding up; [s] longest period since the voltage turned;
# the last two periods
Rule = tuple[int, int, bool, bool, float, float, float]
AT_FIRST: Rule = (0, 1, False, False, 0.0, 0.0, 0.0)


@njit(cache=True)
def hear_voltage(rule: Rule, volts: float) -> Rule:
    """The rule once a voltage is latched."""
    sign, wanted, armed, speeding_up, longest, before, last = rule
    way = 1 if volts > 0.0 else -1 if volts < 0.0 else wanted
    if way != wanted:
        armed = way == -sign
        speeding_up = not last >= 0.9 * before > 0.0  # or has only just started
        longest = last
    return sign, way, armed, speeding_up, longest, before, last


@njit(cache=True)
def hear_edge(rule: Rule, period: float, stood: bool) -> Rule:
    """The rule once an edge has come, `period` seconds after the one before it, which may be before a standstill."""
    sign, wanted, armed, speeding_up, longest, _, last = rule
    if stood:
        sign, armed, period = wanted, False, 0.0
    elif armed and speeding_up:
        speeding_up = period < 1.1 * last
        longest = period
    elif armed and period < 0.8 * longest:
        sign, armed = -sign, False
    else:
        longest = max(longest, period)
    return sign, wanted, armed, speeding_up, longest, last, period


class SignOfOneChannel:
    """The direction a single channel may claim, told of voltages and periods in order of time."""

    def __init__(self) -> None:
        self._rule = AT_FIRST

    @property
    def sign(self) -> int:
        return self._rule[0]

    def voltage(self, volts: float) -> None:
        """A voltage is latched."""
        self._rule = hear_voltage(self._rule, float(volts))

    def edge(self, period: float, stood: bool) -> None:
        """An edge has come."""
        self._rule = hear_edge(self._rule, float(period), bool(stood))


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
    stood = np.diff(stamps, prepend=np.iinfo(np.int64).min // 2) > STANDSTILL
    signs = _signs(voltage, seen, periods, stood, AT_FIRST) if single else np.concatenate([[0], ways])[seen]
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


@njit(cache=True)
def _signs(voltage: Floats, seen: Integers, periods: Floats, stood: NDArray[np.bool_], rule: Rule) -> Integers:
    """Sign that one channel claims at each sample, shape (K,)."""
    signs = np.empty(len(seen), dtype=np.int64)
    told = 0
    for k in range(len(seen)):
        while told < seen[k]:
            rule = hear_edge(rule, periods[told], stood[told])
            told += 1
        signs[k] = rule[0]
        rule = hear_voltage(rule, voltage[k])
    return signs
