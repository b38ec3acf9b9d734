"""Detect a wrong direction in pulses: voltages against a motion that make it faster, one after the other.

A loop that lets a fast motor coast until it is slow (`plug_limit`, where the back-EMF is not known) pushes a motor
whose channels are exchanged from one standstill to the next: each pulse is too short to last, and at 0 V a load could
drive it too. But a pulse beyond what a load takes makes a motion against it slower, whatever the load. `PULSES` that
made it faster, and not one that made it slower or any motion along with them in between, are a wrong direction. Pulses
of a few milliseconds, after which the speed is much what it was, tell nothing.

A timer that ticks hardly faster than edges come tells one speed as another: of periods of two and of three ticks the
shorter may be the longer one. What that may be does not count.
"""

from dataclasses import dataclass
from math import inf

from motor_control.controller.faults.evidence import Config, Seen
from motor_model.frozen_record import replace

STRONG = 0.5  # of the voltage limit: twice a load that is allowed
GROWTH, EDGES = 1.4, 30.0  # of the least speed in the pulse, and on top edges a second: a disc's slots are irregular
SLOWER = 0.9  # of the speed before the pulse
LATE = 2  # edges after which the period shows what a pulse has done
PULSES = 3  # one may be a hit from outside
SENTENCE = (
    "{} pulses against the motion, of {:.3g} V, made it faster, to {:.3g} rad/s: see whether motor and encoder agree "
    "on the direction."
)


@dataclass(frozen=True)
class State:
    """What the latest pulses have done."""

    direction: int = 0  # of the latest pulse; 0: there was none
    voltage: float = 0.0  # [V] of it
    pushes: bool = False  # it has not ended
    edges: int = LATE  # since it ended
    begun: float = 0.0  # [rad/s] against it
    slowest: float = inf  # [rad/s] likewise, since it has begun
    fastest: float = 0.0  # [rad/s] after that
    pulses: int = 0  # that made the motion faster


NONE = State()


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    voltage, speed = seen.sample.voltage, seen.sample.speed
    direction = (voltage > 0.0) - (voltage < 0.0) if abs(voltage) >= STRONG * seen.voltage_limit > 0.0 else 0
    along = speed * (direction or state.direction) > 0.0
    if not config.two_channels or along or direction * state.direction < 0 or config.stall_time == 0.0:
        return "", NONE
    if direction and not state.pushes:
        state = replace(state, pushes=True, edges=0) if state.edges < LATE else _begin_pulse(state, abs(speed))
    state = _follow_speed(state, abs(speed))  # also where the voltage was on until now
    if direction:
        return "", replace(state, direction=direction, voltage=abs(voltage))
    if state.edges >= LATE:
        return "", state
    state = replace(state, pushes=False, edges=state.edges + seen.motion.edges)
    return _count_pulse(config, state) if state.edges >= LATE else ("", state)


def _begin_pulse(state: State, speed: float) -> State:
    """Begin a pulse, at a speed [rad/s] against it, after one whose edges are all in."""
    return State(pushes=True, edges=0, begun=speed, pulses=state.pulses)


def _follow_speed(state: State, speed: float) -> State:
    """Follow the speed [rad/s] against a pulse: its least, and its largest after that."""
    if speed < state.slowest:
        return replace(state, slowest=speed, fastest=speed)
    return replace(state, fastest=max(state.fastest, speed))


def _count_pulse(config: Config, state: State) -> tuple[str, State]:
    """Count a pulse that has ended if it made the motion faster; begin anew after one that made it slower."""
    fastest, slowest = _shift_period(config, state.fastest, 1.0), _shift_period(config, state.slowest, -1.0)
    faster = fastest > GROWTH * slowest + EDGES * config.slot
    pulses = state.pulses + faster if state.fastest >= SLOWER * state.begun else 0
    reason = SENTENCE.format(pulses, state.voltage, state.fastest) if pulses >= PULSES else ""
    return reason, replace(state, pulses=pulses)


def _shift_period(config: Config, speed: float, ticks: float) -> float:
    """Give the speed [rad/s] of a period that is longer by so many ticks of the timer; infinite: of none."""
    if config.slot == 0.0 or speed == 0.0:
        return speed
    period = config.slot / speed + ticks * config.tick
    return config.slot / period if period > 0.0 else inf
