"""Detect a speed that no voltage changes: edges of the mains' hum, which are as regular as those of a motor.

Where an encoder's cable is off at its far end, or a pull-up is missing, the line picks up 50 or 60 Hz. A loop that
wants a little more than these edges make raises its voltage to all that there is, and what it sees "obeys". But hum
does not change by a hundredth while the voltage grows, and a motor would only keep its speed so well if a load grew by
as much as the voltage does. `GROWTH` is twice a load that is allowed.

The voltage grows from the least one meanwhile, but that a motor which coasts keeps its speed for a moment with less
than its back-EMF. And it has to last until a motor of the time constant would have left the band: one that is near its
top speed hardly answers, whatever the voltage.

On a coarse disc a loop has gone up to all the voltage before the average has settled on hum. But if the motor ran
before the line was lost, that steady motion says what would hold this speed. A load may have come at once, and the
motor be as slow as that by now: only what no load takes that is let be (`LOAD`) tells.
"""

from dataclasses import dataclass
from math import exp, inf

from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import FAST

BAND = 0.02  # of the speed: hum stays within it
GROWTH = 0.5  # of the voltage limit, while the speed stays
# Of the voltage limit, beyond what the last steady motion needed: a load of `evidence.HEAVY` and what a model is off.
LOAD = 0.65
EXCESS = 0.25  # of stall_time that the whole voltage may be in excess, at least
SLOWEST = 5.0  # [s] time constant of the slowest flywheel, where the model does not say it
SENTENCE = (
    "{:.3g} V turn the motor no faster than {:.3g} V should, at {:.3g} rad/s: see whether the encoder's line is "
    "connected and quiet (hum of the mains has such edges), or what brakes the motor."
)


@dataclass(frozen=True, slots=True)
class State:
    """A speed that stays, what was known of the motor before, and the voltages that it has had."""

    speed: float = 0.0  # [rad/s] average of the last 50 ms
    kept: float = 0.0  # [rad/s] the speed that stays; 0: none
    kv: float = 0.0  # [V·s/rad] at most, by the model or by what was learnt before; 0: nothing is known
    holding: float = inf  # [V] that hold the speed by the last steady motion before; infinite: there was none
    least: float = inf  # [V] average of 0.15 s
    time: float = 0.0  # [s] since the speed stays
    push: float = 0.0  # [V·s] that it has had since then
    excess: float = 0.0  # [s] of the whole voltage


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    speed = state.speed + (1.0 - exp(-seen.dt / FAST)) * (abs(seen.sample.speed) - state.speed)
    limit = seen.voltage_limit
    voltage = min(seen.motion.slow_voltage, limit)  # the limit may have been lowered just now
    if state.kept == 0.0 or abs(speed - state.kept) > BAND * state.kept or limit <= 0.0:
        return "", _begin(config, seen, speed)
    time, push = state.time + seen.dt, state.push + voltage * seen.dt
    state = State(speed, state.kept, state.kv, state.holding, min(state.least, voltage), time, push, state.excess)
    inertia = 2.0 * BAND * (config.time_constant or SLOWEST)
    kept_by = max(state.least, state.kv * state.kept)
    holding, growth = kept_by, (voltage - kept_by) / limit - GROWTH
    share = min(state.kv * state.kept / limit, 1.0) if state.kv > 0.0 else 1.0
    patience = max(EXCESS * config.stall_time, inertia * share)  # top speed times it by its time constant: the band
    # Of a motor of which nothing is known the voltages have to show that it does not coast near its top speed: those
    # before have been too low for long enough, too.
    if state.kv == 0.0 and voltage * time - push < inertia * limit:
        growth = 0.0
    if (voltage - state.holding) / limit - LOAD > growth:
        holding, growth = state.holding, (voltage - state.holding) / limit - LOAD
    after = State(
        *(speed, state.kept, state.kv, state.holding, state.least, time, push),
        excess=state.excess + growth * seen.dt if growth > 0.0 else 0.0,
    )
    told = config.stall_time > 0.0 and after.excess >= patience
    return (SENTENCE.format(voltage, holding, speed) if told else ""), after


def _begin(config: Config, seen: Seen, speed: float) -> State:
    """Begin with a speed [rad/s] that may stay; what is learnt from now on may be learnt of hum."""
    motion, limit = seen.motion, seen.voltage_limit
    kv = config.kv or (limit / motion.fastest(limit) if limit > 0.0 else 0.0)  # 0 where nothing was learnt
    known = motion.steady_voltage > 0.0
    holding = max(motion.steady_voltage + kv * (speed - motion.steady_speed), kv * speed) if known else inf
    return State(speed, speed, kv, holding, motion.slow_voltage)
