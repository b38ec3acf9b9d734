"""Detect hum of the mains in the place of a motor's edges, by their rhythm and by what they do not answer to.

`insensitive_speed` tells any speed that no voltage changes, and has to let be what a heavy load may do. Edges in the
rhythm of the mains (`Rhythm.hums`) are doubtful by themselves, so that less is enough:

    under 0 V    a motor that is driven by nothing becomes slower; hum from the start is told before the motor moves
    beside more  they are not at the speed that is wanted, and the voltage is `LOAD` more than a steady motion before,
                 or the model, needed for theirs; a load may have come, but it would have to have brought the motor to
                 such a rate just so

A motor that does as it is told at such a rate is none, whatever its load. What brakes a motor on a disc that is more
even than 0.6 % to 50, 60, 100 or 120 edges a second is stopped for hum: it gets more voltage than it needs, and does
not reach its speed.
"""

from dataclasses import dataclass
from math import inf

from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.faults.insensitive_speed import SLOWEST
from motor_model.sensing.mains_rhythm import EVEN, WITHIN

AT_REST = 0.5  # [s] of hum under 0 V; and as long as a flywheel that coasts would take to cross the rate of the mains
SOME_REST = 0.1  # [s] of it after which nothing holds this speed
ELSEWHERE = 0.02  # of the reference, from which they are away: a loop with an integral is nearer
LOAD = 0.25  # of the voltage limit, that a load may take beside what is known of it
EXCESS = 0.15  # of stall_time that the whole voltage may be in excess
SENTENCE = (
    "The encoder's line hums with {:.0f} Hz: {}. See whether the encoder is connected, its line has a pull-up and is "
    "away from the mains."
)
UNDER_NOTHING = "the edges come with the motor at 0 V, and become no fewer"
UNDER_MORE = "{:.3g} V change nothing, and {:.3g} V are enough for such a speed"


@dataclass(frozen=True, slots=True)
class State:
    """What held the motor before the rhythm began, and what it has had beyond that."""

    edges: int = 0  # in the rhythm
    holding: float = inf  # [V] for the speed of the rhythm; infinite: not known
    excess: float = 0.0  # [s] of the whole voltage


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    rhythm, limit = seen.rhythm, seen.voltage_limit
    if config.slot == 0.0 or config.stall_time == 0.0 or rhythm.period == 0.0 or limit <= 0.0:
        return "", State()
    speed = config.slot / rhythm.period
    if rhythm.edges < max(state.edges, 1):  # another rhythm: what is learnt from now on may be learnt of hum
        return "", State(rhythm.edges, find_holding_voltage(config, seen, speed))
    state = State(rhythm.edges, state.holding, state.excess)
    if not rhythm.hums:
        return "", state
    rate, time_constant = 1.0 / rhythm.period, config.time_constant or SLOWEST
    if rhythm.at_rest >= max(AT_REST, 2.0 * WITHIN * time_constant):
        return SENTENCE.format(rate, UNDER_NOTHING), state
    voltage = seen.motion.slow_voltage
    if rhythm.at_rest >= SOME_REST:
        state = State(rhythm.edges, 0.0, state.excess)
    excess = (voltage - state.holding) / limit - LOAD
    elsewhere = abs(abs(seen.reference) - speed) > ELSEWHERE * abs(seen.reference)  # false under a plain voltage
    state = State(rhythm.edges, state.holding, state.excess + excess * seen.dt if elsewhere and excess > 0.0 else 0.0)
    patience = max(EXCESS * config.stall_time, 2.0 * EVEN * time_constant)
    told = state.excess >= patience
    return (SENTENCE.format(rate, UNDER_MORE.format(voltage, state.holding)) if told else ""), state


def find_holding_voltage(config: Config, seen: Seen, speed: float) -> float:
    """Find the voltage [V] that holds a speed [rad/s], by the model or the last steady motion; infinite: not known."""
    motion, limit = seen.motion, seen.voltage_limit
    kv = config.kv or limit / motion.fastest(limit)
    if motion.steady_voltage > 0.0:
        return max(motion.steady_voltage + kv * (speed - motion.steady_speed), kv * speed)
    return config.friction + kv * speed if config.kv else inf
