"""What a sampled encoder says about the speed: the period of the latest two edges, with a sign that is never guessed.

A single channel does not measure direction. Under a voltage against the motion the speed can only fall, pass zero and
rise again the other way; so the sign changes where the period has passed its maximum while the voltage was reversed, or
at a standstill (then the voltage decides which way the next motion goes). The voltage alone never changes it.
"""

from dataclasses import dataclass
from math import copysign

from motor_model.frozen_record import replace

STANDSTILL = 100_000_000  # [ns] without an edge is a standstill
DIP = 0.5  # of the speed at which the voltage turned against the motion: below that the motor may have passed zero
RISE = 1.2  # over its minimum: more than irregular slots (1 % of a slot: ±4 % in the period) ever show
LEAP = 2.0  # over its minimum: a rise that tells even without a dip, when the motor was slow to begin with
PATIENCE = 30_000_000  # [ns] after which any rise tells: longer than a bridge still acts on its last command


@dataclass(frozen=True)
class SpeedState:
    """What the rule remembers from sample to sample."""

    direction: int = 0  # −1, 0 (standing), +1
    voltage: float = 0.0  # [V] latest one that was not 0
    opposed_since: int | None = None  # [ns] since when the voltage is against the motion
    begun: float = 0.0  # [rad/s] speed at that time
    low: float = 0.0  # [rad/s] smallest speed since then


def speed_magnitude(slot: float, now: int, edge_time: int, edge_period: float, quadrature: int = 1) -> float:
    """[rad/s] slot/period of the latest two edges, bounded by slot/(time since the latest edge); 0 at a standstill.

    Counted two- or fourfold, edges of a period of channel A are unevenly apart, and the last may not have been reported
    yet: the period is the mean over that period of A, and so is the bound.
    """
    since = now - edge_time
    if edge_period <= 0.0 or edge_time == 0 or since >= STANDSTILL:
        return 0.0
    return slot / max(edge_period, since * 1e-9 / max(quadrature, 1))


def single_channel_speed(state: SpeedState, magnitude: float, voltage: float, now: int) -> tuple[float, SpeedState]:
    """Return the signed speed [rad/s] at a sample and the rule's next state.

    `voltage` [V] is what this sample latches: it acts from now on, so the motion so far is judged by the one before.
    """
    after = replace(state, voltage=voltage) if voltage != 0.0 else state
    if magnitude == 0.0:
        return 0.0, replace(after, direction=0, opposed_since=None)
    drive = state.voltage
    if state.direction == 0:
        direction = int(copysign(1, drive))
        return direction * magnitude, replace(after, direction=direction, opposed_since=None)
    if drive * state.direction >= 0.0:
        return state.direction * magnitude, replace(after, opposed_since=None)
    direction, after = _against_the_voltage(after, magnitude, now)
    return direction * magnitude, after


def _against_the_voltage(state: SpeedState, magnitude: float, now: int) -> tuple[int, SpeedState]:
    """Follow the speed through its minimum while the voltage is against the motion."""
    if state.opposed_since is None:
        return state.direction, replace(state, opposed_since=now, begun=magnitude, low=magnitude)
    low = min(state.low, magnitude)
    waited = now - state.opposed_since > PATIENCE
    if magnitude > LEAP * low or (magnitude > RISE * low and (low < DIP * state.begun or waited)):
        return -state.direction, replace(state, direction=-state.direction, opposed_since=None)
    return state.direction, replace(state, low=low)
