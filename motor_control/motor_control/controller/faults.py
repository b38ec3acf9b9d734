"""Faults that stop the motor for good: it does not turn under full voltage, or it turns faster than it should.

    stall      full voltage, and no edge for `stall_time`: the shaft is blocked, or the encoder is not heard
    runaway    the voltage is 0 or against the motion, and yet the speed grows: a wrong sign, a bridge that stays on,
               a load
    overspeed  faster than full voltage can drive the motor of the model: edges that are none, or a load

The speed is the one the law uses, the voltage the one the plant says it applies; times are the plant's.
"""

from dataclasses import dataclass
from math import inf

from motor_control.checks import at_least
from motor_model.sample import Sample

FULL = 0.98  # of the voltage limit
RUNAWAY_TIME = 0.25  # [s] longer than any plant takes to see that a single channel has turned round
RUNAWAY_GROWTH, RUNAWAY_RISE = 1.2, 10.0  # of the smallest speed since then, and [rad/s] on top
OVERSPEED, OVERSPEED_TIME = 1.3, 0.05  # of what the supply gives; [s]: not one period of a doubtful edge

STALL = (
    "The motor got {:.3g} V for {:.2g} s, all it may get, and no edge came: see whether the shaft is blocked, the "
    "encoder or the motor is not connected, or voltage_limit is too low."
)
RUNAWAY = (
    "The speed grew from {:.3g} to {:.3g} rad/s although the voltage was 0 or against it: see whether motor and encoder"
    " agree on the direction, the bridge obeys, or a load drives the motor."
)
OVERSPEED_SAID = (
    "The motor turns at {:.4g} rad/s, and by its model no more than {:.4g} are possible: see whether the encoder's line"
    " is disturbed, or the model is another motor's."
)


@dataclass(frozen=True, slots=True)
class Config:
    """When to stop.

    Raises:
        MotorError: a value is negative or not finite.
    """

    stall_time: float = 0.5  # [s] 0: never
    fastest: float = inf  # [rad/s] by the model; infinite without one

    def __post_init__(self) -> None:
        at_least(0.0, stall_time=self.stall_time)


@dataclass(frozen=True, slots=True)
class State:
    """For how long each has been so [s]."""

    edge_count: int = 0
    stalled: float = 0.0
    undriven: float = 0.0
    slowest: float = inf  # [rad/s] since then
    too_fast: float = 0.0


def update(
    config: Config, state: State, sample: Sample, speed: float, dt: float, voltage_limit: float
) -> tuple[str, State]:
    """A sentence if the motor has to stop, else "": speed [rad/s], dt [s] since the sample before, limit [V]."""
    fast = abs(speed)
    full = abs(sample.voltage) >= FULL * voltage_limit > 0.0
    silent = sample.speed == 0.0 and sample.edge_count == state.edge_count
    stalled = state.stalled + dt if full and silent else 0.0
    undriven, slowest = 0.0, inf
    if sample.voltage * speed <= 0.0 and speed != 0.0:
        undriven, slowest = state.undriven + dt, min(state.slowest, fast)
    too_fast = state.too_fast + dt if fast > OVERSPEED * config.fastest else 0.0
    reason = ""
    if 0.0 < config.stall_time <= stalled:
        reason = STALL.format(sample.voltage, stalled)
    elif undriven >= RUNAWAY_TIME and fast > RUNAWAY_GROWTH * slowest + RUNAWAY_RISE:
        reason = RUNAWAY.format(slowest, fast)
    elif too_fast >= OVERSPEED_TIME:
        reason = OVERSPEED_SAID.format(fast, config.fastest)
    return reason, State(sample.edge_count, stalled, undriven, slowest, too_fast)
