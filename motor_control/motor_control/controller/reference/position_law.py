"""Bring the shaft to an angle: a speed for the speed loop from what is missing, and rest where it has come.

With the angle counted in slots (edges of one polarity, both channels), `off` slots are missing. The speed is the least
of three: what the loop follows without overshoot (`gain` times what is missing), what can still be braked in time
(sqrt(2 a e)), and the fastest; and at least `slowest`, for a speed that goes to 0 with what is missing is stopped by
friction on the way. At the wanted slot the loop brakes; where the motor then stands within one slot, it rests at 0 V
and friction holds it. It moves again only when it is pushed further than that, or asked elsewhere; where that happens
again and again, a load is larger than friction, which an angle's loop without a brake does not hold, and it gives up.

A motor that jumps over the slot comes back more slowly, half as fast each time; after `TRIES` times it stays where
friction lets it, and that is said: it never hunts.
"""

from dataclasses import dataclass, replace
from math import sqrt

TRIES = 4
BRAKE_SHARE, FAST_SHARE = 0.25, 0.9  # of what the motor can
SLOTS_PER_SECOND = 25.0  # the slowest approach: the observer has an edge every 40 ms to go by
PUSHES = 10
FARTHEST = 2.0**31  # [slots] from the plant's start: days of any motor's motion, and so a mistake
PUSHED = (
    "The motor was pushed out of the angle that it had reached {} times: friction does not hold the load. It gets 0 V; "
    "ask for an angle again."
)
STAYS = "It stands {} counts from the angle that was asked for: friction lets it move no less."


@dataclass(frozen=True, slots=True)
class Config:
    """How to approach."""

    slot: float  # [rad]
    gain: float  # [1/s]
    deceleration: float  # [rad/s²]
    fastest: float  # [rad/s]


@dataclass(frozen=True, slots=True)
class State:
    """What is remembered of one approach."""

    target: int = 0  # [slots]
    resting: bool = False
    side: int = 0  # from which it came; 0: not moved yet
    overshoots: int = 0
    pushes: int = 0  # out of its rest


@dataclass(frozen=True, slots=True)
class Aim:
    """What the speed loop shall do."""

    speed: float  # [rad/s]
    rests: bool = False  # 0 V
    note: str = ""


def design(slot: float, kp: float, ka: float, voltage_limit: float, top_speed: float) -> Config:
    """Design an approach for a speed loop of the gain kp [V/(rad/s)] on a motor of ka [V·s²/rad].

    The loop's time constant is ka/kp; an outer loop four times as slow does not overshoot. A quarter of what the
    voltage alone could brake with leaves the rest to the loop.
    """
    return Config(slot, 0.25 * kp / ka, BRAKE_SHARE * voltage_limit / ka, FAST_SHARE * top_speed)


def begin(config: Config, wanted: float) -> State:
    """Begin an approach to an angle [rad]."""
    return State(round(wanted / config.slot))


def approach(config: Config, state: State, wanted: float, edge_count: int, stands: bool) -> tuple[Aim, State]:
    """Find the speed for one sample on the way to an angle [rad]; stands: the motor does not move."""
    if round(wanted / config.slot) != state.target:
        state = begin(config, wanted)
    off = state.target - edge_count
    if state.pushes >= PUSHES:
        return Aim(0.0, True, PUSHED.format(state.pushes)), state
    if state.resting or stands:
        given_up = state.overshoots >= TRIES
        if abs(off) <= 1 or (given_up and state.resting):
            return Aim(0.0, True, STAYS.format(abs(off)) if abs(off) > 1 else ""), replace(state, resting=True)
        if given_up and state.side * off < 0:
            return Aim(0.0, True, STAYS.format(abs(off))), replace(state, resting=True)
    if off == 0:
        return Aim(0.0), replace(state, resting=False)
    side = 1 if off > 0 else -1
    overshoots = state.overshoots + (side == -state.side)
    pushes = state.pushes + state.resting
    state = replace(state, resting=False, side=side, overshoots=overshoots, pushes=pushes)
    return Aim(side * _speed(config, abs(off) * config.slot, overshoots)), state


def _speed(config: Config, missing: float, overshoots: int) -> float:
    """Compute the speed [rad/s] at a distance [rad]."""
    share = 0.5**overshoots
    fast = min(config.gain * missing, sqrt(2.0 * config.deceleration * missing), config.fastest)
    return share * max(fast, SLOTS_PER_SECOND * config.slot)
