"""Detect a motor that has left the speed which its voltage held, where that voltage may not be raised.

A controller that is held up keeps the voltage near what held the speed (`timekeeping`), so that no check that waits for
more voltage ever speaks: a motor that is stuck, whose supply is off or whose encoder is lost kept that voltage, and a
supply that came back started it. There, too few edges for the voltage that held the speed are told by their count: each
sets the clock back if it came at more than `FEW` of the speed. A motor that has not reached its speed yet may be
spinning up: there only a standstill counts.
"""

from dataclasses import dataclass

from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.timing.timekeeping import MARGIN, find_holding_voltage

FEW = 0.5  # of the reference
REACHED = 0.8  # of it, once reached
SLOTS = 5.0  # in which edges should have come at `FEW` of it
SENTENCE = (
    "The voltage that held {:.3g} rad/s holds the motor no more: {:.3g} V for {:.2g} s, and {:.3g} rad/s, while the "
    "controller is held up now and then and may give no more. See whether the shaft is blocked, the motor's supply is "
    "on, and the encoder is connected."
)


@dataclass(frozen=True, slots=True)
class State:
    """For how long edges have been too few, and how far the motor has turned by them."""

    time: float = 0.0  # [s]
    travel: float = 0.0  # [rad]
    reached: bool = False


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    wanted = abs(seen.reference)
    volts = find_holding_voltage(seen.motion, seen.reference) if seen.cautious else 0.0
    if volts == 0.0 or config.stall_time == 0.0:
        return "", State()
    reached = state.reached or seen.motion.slow_speed >= REACHED * wanted
    given = abs(seen.sample.voltage)
    if given < (1.0 - 2.0 * MARGIN) * abs(volts) or seen.sample.voltage * seen.reference < 0.0:
        return "", State(state.time, state.travel, reached)  # for now: 0 V for an old sample is no other motion
    turned = seen.motion.edges * config.slot if config.slot > 0.0 else abs(seen.sample.speed) * seen.dt
    time, travel = state.time + seen.dt, state.travel + turned
    if travel >= FEW * wanted * time or (travel > 0.0 and not reached):
        return "", State(reached=reached)
    long = time >= config.stall_time and FEW * wanted * time >= SLOTS * config.slot
    return SENTENCE.format(wanted, given, time, travel / time) if long else "", State(time, travel, reached)
