"""Bring the shaft to an angle: a speed for the speed loop from what is missing, and rest where it has come.

With the angle counted in slots (edges of one polarity, both channels), `off` slots are missing. The speed is the least
of three: what the loop follows without overshoot (`gain` times what is missing), what can still be braked in time
(sqrt(2 a e)), and the fastest; and at least `slowest`, for a speed that goes to 0 with what is missing is stopped by
friction on the way. At the wanted slot the loop brakes; where the motor then stands within one slot, it rests at 0 V
and friction holds it. It moves again only when it is pushed further than that, or asked elsewhere; where that happens
again and again, a load is larger than friction, which an angle's loop without a brake does not hold, and it gives up.

A motor that jumps over the slot comes back more slowly, half as fast each time; after `TRIES` times it stays where
friction lets it, and that is said: it never hunts. Nor does it push on for ever: an angle that it had reached and was
pushed out of has to come nearer again, or a hand holds the shaft, or the edges are those of a line that is lost, and
the motor runs. Who asks for other angles meanwhile, for a speed, or for no number, does not begin anew.
"""

from dataclasses import dataclass, replace
from math import sqrt

TRIES = 4
BRAKE_SHARE, FAST_SHARE = 0.25, 0.9  # of what the motor can
SLOTS_PER_SECOND = 25.0  # the slowest approach: the observer has an edge every 40 ms to go by
PUSHES = 10
NEARER, RETURN_TIME = 2, 0.9  # [slots] toward the angle, [s] in which a motor that was pushed out of it goes so far
CALM = 1.0  # [s] of rest, or of no other angle where it was given up, after which a push is over: no stream leaves it
FARTHEST = 2.0**31  # [slots] from the plant's start: days of any motor's motion, and so a mistake
PUSHED = (
    "The motor was pushed out of the angle that it had reached {} times: friction does not hold the load. It gets 0 V; "
    "ask for an angle again."
)
AWAY = (
    "The motor was pushed out of the angle that it had reached, and does not come back: see what turns the shaft, and "
    "the encoder's line. It gets 0 V; ask for another angle after a second."
)
STAYS = "It stands {} counts from the angle that was asked for: friction lets it move no less."


@dataclass(frozen=True, slots=True)
class Config:
    """How to approach."""

    slot: float  # [rad]
    gain: float  # [1/s]
    deceleration: float  # [rad/s²]
    fastest: float  # [rad/s]
    return_time: float = RETURN_TIME  # [s]


@dataclass(frozen=True, slots=True)
class State:
    """What is remembered of one approach."""

    target: int | None = 0  # [slots] None: something else than an angle was asked for
    resting: bool = False
    side: int = 0  # from which it came; 0: not moved yet
    overshoots: int = 0
    pushes: int = 0  # out of its rest at this target
    count: int | None = None  # [slots] of the sample before
    pushed: bool = False  # edges have come while it rested; it has not rested for long since
    calm: float = 0.0  # [s] for which it has rested, or no other angle was asked for
    farthest: int = 0  # [slots] the count farthest from the target since then, or since it last came nearer
    lost: float = 0.0  # [s] for which it has not come nearer


@dataclass(frozen=True, slots=True)
class Aim:
    """What the speed loop shall do."""

    speed: float  # [rad/s]
    rests: bool = False  # 0 V
    note: str = ""


def design(slot: float, kp: float, ka: float, voltage_limit: float, top_speed: float) -> Config:
    """Design an approach for a speed loop of the gain kp [V/(rad/s)] on a motor of ka [V·s²/rad].

    The loop's time constant is ka/kp; an outer loop four times as slow does not overshoot. A quarter of what the
    voltage alone could brake with leaves the rest to the loop. A flywheel gets the time that it needs for two slots.
    """
    gain, deceleration = 0.25 * kp / ka, BRAKE_SHARE * voltage_limit / ka
    slow = 2.0 * sqrt(2.0 * NEARER * slot / deceleration) if deceleration > 0.0 else 0.0
    return Config(slot, gain, deceleration, FAST_SHARE * top_speed, max(RETURN_TIME, slow))


def begin(config: Config, wanted: float) -> State:
    """Begin an approach to an angle [rad]."""
    return State(round(wanted / config.slot))


def approach(
    config: Config, state: State, wanted: float, edge_count: int, stands: bool, dt: float = 0.0
) -> tuple[Aim, State]:
    """Find the speed for one sample, dt [s] after the last one, to an angle [rad]; stands: the motor does not move."""
    state, target = _follow_rest(config, state, edge_count, dt), round(wanted / config.slot)
    if target != state.target:
        state = _turn_to(config, state, target, edge_count)
    off = target - edge_count
    if state.pushes >= PUSHES:
        return Aim(0.0, True, PUSHED.format(state.pushes)), state
    state = _follow_return(config, state, off, edge_count, dt)
    if state.lost >= config.return_time:
        return Aim(0.0, True, AWAY), state
    if state.resting or stands:
        given_up = state.overshoots >= TRIES
        if abs(off) <= 1 or (given_up and state.resting):
            return Aim(0.0, True, STAYS.format(abs(off)) if abs(off) > 1 else ""), replace(state, resting=True)
        if given_up and state.side * off < 0:
            return Aim(0.0, True, STAYS.format(abs(off))), replace(state, resting=True)
    if off == 0:
        return Aim(0.0), replace(state, resting=False)
    side = 1 if off > 0 else -1
    overshoots = state.overshoots + (side == -state.side and not state.resting)  # a push is no jump
    pushes = state.pushes + state.resting
    pushed = state.pushed or state.resting
    state = replace(state, resting=False, side=side, overshoots=overshoots, pushes=pushes, pushed=pushed)
    return Aim(side * _speed(config, abs(off) * config.slot, overshoots)), state


def leave(state: State | None, dt: float) -> State | None:
    """Remember of an approach what lasts while something else is asked for, dt [s] after the last sample.

    Nobody can tell what moves the motor then: who asks for an angle again within a second has to come nearer to it.
    """
    calm = 0.0 if state is None or state.target is not None else state.calm + dt
    if state is None or calm >= CALM:
        return None
    return replace(state, target=None, resting=False, overshoots=0, pushes=0, pushed=True, calm=calm)


def _turn_to(config: Config, state: State, target: int, count: int) -> State:
    """Turn to another angle: a push out of the one before is not over by that."""
    given_up = state.lost >= config.return_time
    if given_up and state.calm < CALM:
        return replace(state, target=target, calm=0.0)
    if given_up or not state.pushed:
        return State(target, count=count)
    side = state.side if state.side * (target - count) > 0 else 0
    after = State(target, side=side, count=count, pushed=True, calm=state.calm)
    return replace(after, farthest=state.farthest, lost=state.lost)


def _follow_rest(config: Config, state: State, count: int, dt: float) -> State:
    """Follow how long it has rested, and whether edges have come meanwhile."""
    moved = state.resting and state.count not in (None, count)
    calm = state.calm + dt if (state.resting and not moved) or state.lost >= config.return_time else 0.0
    pushed = moved or (state.pushed and not (state.resting and calm >= CALM))
    return replace(state, count=count, calm=calm, pushed=pushed)


def _follow_return(config: Config, state: State, off: int, count: int, dt: float) -> State:
    """Follow a motor that was pushed out of an angle: for how long it has not come nearer.

    It counts toward the angle wherever that is by now. Who comes back more slowly has more time.
    """
    if state.lost >= config.return_time:
        return state
    if state.resting or not state.pushed or state.side * (count - state.farthest) >= NEARER:
        return replace(state, farthest=count, lost=0.0)
    back = state.side * off <= 0 or state.side * (state.farthest - count) > 0
    return replace(state, farthest=count if back else state.farthest, lost=state.lost + dt * 0.5**state.overshoots)


def _speed(config: Config, missing: float, overshoots: int) -> float:
    """Compute the speed [rad/s] at a distance [rad]."""
    share = 0.5**overshoots
    fast = min(config.gain * missing, sqrt(2.0 * config.deceleration * missing), config.fastest)
    return share * max(fast, SLOTS_PER_SECOND * config.slot)
