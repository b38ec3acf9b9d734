"""Detect a runaway: a speed that grows without a voltage that drives it."""

from dataclasses import dataclass
from math import inf

from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import FAST

RUNAWAY_TIME = 0.25  # [s] longer than any plant takes to see that a single channel has turned round
# Of the smallest speed since then, by a model and without one; and on top the share of the top speed to which a load
# that is allowed (`spare`) drives a motor, and at least EDGES in the average's 50 ms.
GROWTH, GROWTH_UNKNOWN = 1.2, 2.0
EDGES = 2.0
STRONG = 0.5  # of the voltage limit; below, and not 0 V, a loop answers a load that drives the motor
SENTENCE = (
    "The speed grew from {:.3g} to {:.3g} rad/s although the voltage was 0 or against it: see whether motor and encoder"
    " agree on the direction, the bridge obeys, or a load drives the motor."
)


@dataclass(frozen=True, slots=True)
class State:
    """For how long nothing has driven the motor."""

    time: float = 0.0  # [s]
    slowest: float = inf  # [rad/s] since then; 0 from a standstill on
    pushed: bool = False  # a strong voltage has been on meanwhile


STANDING, DRIVEN = State(0.0, 0.0), State()


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    fast, voltage = seen.motion.speed, seen.sample.voltage
    if seen.speed == 0.0:
        return "", STANDING
    growth, rise = needed_growth(config, seen)
    if voltage * seen.speed > 0.0 or 0.0 < abs(voltage) < STRONG * seen.voltage_limit:
        return "", DRIVEN
    if rise == inf and not state.pushed:
        return "", DRIVEN
    state = State(
        state.time + seen.dt,
        min(state.slowest, max(fast, abs(seen.speed))),  # the average is late, the reported speed irregular
        state.pushed or voltage != 0.0,
    )
    grown = min(fast, abs(seen.speed))
    away = state.time >= RUNAWAY_TIME and grown > growth * state.slowest + rise
    return (SENTENCE.format(state.slowest, grown) if away else ""), state


def needed_growth(config: Config, seen: Seen) -> tuple[float, float]:
    """Find the factor and the rise [rad/s] by which the speed has to grow: by the model, or by what was learnt.

    Where neither says what a load can do, a motor at 0 V is left alone: a stop would give it no less. What it did there
    is not held against the first voltage that follows (a random torque beside no friction: seed 812089).
    """
    learnt, least = seen.motion.fastest(seen.voltage_limit), EDGES / FAST * config.slot
    if config.fastest < inf:
        return GROWTH, max(config.spare * config.fastest, least)
    if learnt < inf or seen.sample.voltage:  # a motor only seen under a load may be much faster than that says
        return GROWTH_UNKNOWN, max(config.spare * learnt if learnt < inf else 0.0, least)
    return GROWTH_UNKNOWN, inf
