"""Detect a speed that no voltage changes: edges of the mains' hum, which are as regular as those of a motor.

Where an encoder's cable is off at its far end, or a pull-up is missing, the line picks up 50 or 60 Hz. A loop that
wants a little more than these edges make raises its voltage to all that there is, and what it sees "obeys". But hum
does not change by a hundredth while the voltage grows, and a motor would only keep its speed so well if a load grew by
as much as the voltage does. `GROWTH` is twice a load that is allowed.
"""

from dataclasses import dataclass
from math import exp, inf

from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import FAST

BAND = 0.02  # of the speed: hum stays within it, and a flywheel of 5 s leaves it under full voltage in a second
GROWTH = 0.5  # of the voltage limit
EXCESS = 0.25  # of stall_time that the whole voltage may be in excess
SENTENCE = (
    "{:.3g} V turn the motor no faster than {:.3g} V did, at {:.3g} rad/s: see whether the encoder's line is connected "
    "and quiet (hum of the mains has such edges), or what brakes the motor."
)


@dataclass(frozen=True, slots=True)
class State:
    """A speed that stays, and the least voltage that it has had."""

    speed: float = 0.0  # [rad/s] average of the last 50 ms
    kept: float = 0.0  # [rad/s] the speed that stays; 0: none
    least: float = inf  # [V] average of 0.15 s
    excess: float = 0.0  # [s] of the whole voltage


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    speed = state.speed + (1.0 - exp(-seen.dt / FAST)) * (abs(seen.sample.speed) - state.speed)
    voltage, limit = seen.motion.slow_voltage, seen.voltage_limit
    if state.kept == 0.0 or abs(speed - state.kept) > BAND * state.kept or limit <= 0.0:
        return "", State(speed, speed, voltage)
    least = min(state.least, voltage)
    growth = voltage / limit - least / limit - GROWTH
    excess = state.excess + growth * seen.dt if growth > 0.0 else 0.0
    after = State(speed, state.kept, least, excess)
    told = excess >= EXCESS * config.stall_time > 0.0
    return (SENTENCE.format(voltage, least, speed) if told else ""), after
