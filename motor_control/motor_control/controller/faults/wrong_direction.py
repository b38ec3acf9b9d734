"""Detect a wrong direction in pulses: voltages against a motion that make it faster, one after the other.

A loop that lets a fast motor coast until it is slow (`plug_limit`, where the back-EMF is not known) pushes a motor
whose channels are exchanged from one standstill to the next: each pulse is too short to last, and at 0 V a load could
drive it too. But a pulse beyond what a load takes makes a motion against it slower, whatever the load. `PULSES` that
made it faster, and not one that did anything else or any motion along with them in between, are a wrong direction.
"""

from dataclasses import dataclass, replace
from math import inf

from motor_control.controller.faults.evidence import Config, Seen

STRONG = 0.5  # of the voltage limit: twice a load that is allowed
GROWTH, EDGES = 1.5, 50.0  # of the least speed in the pulse, and on top edges a second: a disc's slots are irregular
LATE = 2  # edges after which the period shows what a pulse has done
PULSES = 3  # one may be a hit from outside
SENTENCE = (
    "{} pulses against the motion, of {:.3g} V, made it faster, to {:.3g} rad/s: see whether motor and encoder agree "
    "on the direction."
)


@dataclass(frozen=True, slots=True)
class State:
    """What the latest pulses have done."""

    direction: int = 0  # of the latest pulse; 0: there was none
    voltage: float = 0.0  # [V] of it
    pushes: bool = False  # it has not ended
    edges: int = LATE  # since it ended
    slowest: float = inf  # [rad/s] against it
    fastest: float = 0.0  # [rad/s] likewise
    pulses: int = 0  # that made the motion faster


NONE = State()


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    voltage, speed = seen.sample.voltage, seen.sample.speed
    direction = (voltage > 0.0) - (voltage < 0.0) if abs(voltage) >= STRONG * seen.voltage_limit > 0.0 else 0
    along = speed * (direction or state.direction) > 0.0
    if not config.two_channels or along or direction * state.direction < 0 or config.stall_time == 0.0:
        return "", NONE
    state = replace(state, fastest=max(state.fastest, abs(speed)))  # also where the voltage was on until now
    if direction and not state.pushes:
        state = replace(state, pushes=True, edges=0) if state.edges < LATE else _begin_pulse(state, speed)
    if direction:
        return "", replace(state, direction=direction, voltage=abs(voltage), slowest=min(state.slowest, abs(speed)))
    if state.edges >= LATE:
        return "", state
    state = replace(state, pushes=False, edges=state.edges + seen.motion.edges)
    return _count_pulse(config, state) if state.edges >= LATE else ("", state)


def _begin_pulse(state: State, speed: float) -> State:
    """Begin a pulse, at a speed [rad/s] against it, after one whose edges are all in."""
    return State(pushes=True, edges=0, fastest=abs(speed), pulses=state.pulses)


def _count_pulse(config: Config, state: State) -> tuple[str, State]:
    """Count a pulse that has ended if it made the motion faster; else begin anew."""
    faster = state.fastest > GROWTH * state.slowest + EDGES * config.slot
    pulses = state.pulses + 1 if faster else 0
    reason = SENTENCE.format(pulses, state.voltage, state.fastest) if pulses >= PULSES else ""
    return reason, replace(state, pulses=pulses)
