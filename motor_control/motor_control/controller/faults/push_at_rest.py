"""Detect a motor that is pushed where it shall stand, by voltages that no load needs.

Where an encoder's line is lost at a reference of 0, an observer takes every stray edge for a motion and pushes against
it; the shaft turns to and fro by as many slots as stray edges come, so that their number tells nothing. But a motor
with two channels that has come to rest needs no more than what a load takes (`spare`) and friction, a third of the
voltage. `STRONG` voltages, summed up and forgotten again, are a fault. (One channel gets 0 V there; a loop on the
measured speed makes 8 % of the top speed of it at most, and needs strong voltages for loads that are allowed.)

Nor does any loop need them both ways in turn for long. One whose gains are too large for its encoder swings by itself:
a load is held by one sign, and a motion is braked by one. What is left of the sum of strong voltages where the two
signs cancel is a fault, whatever the source of the speed.
"""

from dataclasses import dataclass
from math import exp, isfinite

from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.voltage_range import AT_REST

STRONG = 0.98 * AT_REST  # of the voltage limit: all that there is at rest, twice a load that is allowed
FORGET = 1.0  # [s] time constant
# [s] of strong voltages. Of 62 random motors with two channels (25 minutes, conditions of `no_false_stops`) one had
# 0.06, beside a random torque of 5 %, all others none. A hit of the stall torque for 0.1 s, which takes the shaft to
# half of its top speed, does not make as much; one for 0.2 s does with a slow motor.
MOST = 0.2
# [s] of strong voltages that cancel: seven swinging loops had 0.65 and more, 41 random motors with two channels (14
# minutes) 0.01 at most.
TO_AND_FRO = 0.4
SENTENCE = (
    "The motor shall stand and was pushed by up to {:.3g} V for {:.2g} s in all: see what turns the shaft, and whether "
    "the encoder's line is connected and quiet."
)
SWINGS = (
    "The motor shall stand and is pushed to and fro, by up to {:.3g} V for {:.2g} s in all: lower kp and ki, or see "
    "whether the encoder's line is connected and quiet."
)


@dataclass(frozen=True, slots=True)
class State:
    """What was given where the motor shall stand, and is not forgotten."""

    rested: bool = False  # it has come to rest
    time: float = 0.0  # [s] of strong voltages since then
    largest: float = 0.0  # [V] of them
    forward: float = 0.0  # [s] of strong voltages forward, also before it has come to rest
    backward: float = 0.0  # [s] likewise

    @property
    def to_and_fro(self) -> float:
        """[s] of strong voltages whose signs cancel."""
        return 2.0 * min(self.forward, self.backward)


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    if not config.two_channels or config.stall_time == 0.0 or seen.reference != 0.0:
        return "", State()
    voltage, kept = seen.sample.voltage, exp(-seen.dt / FORGET)
    strong = abs(voltage) >= STRONG * seen.voltage_limit > 0.0
    rested = state.rested or seen.speed == 0.0
    after = State(
        rested,
        state.time * kept + (seen.dt if strong and rested and isfinite(seen.innovation) else 0.0),
        max(state.largest, abs(voltage)) if strong else state.largest,
        state.forward * kept + (seen.dt if strong and voltage > 0.0 else 0.0),
        state.backward * kept + (seen.dt if strong and voltage < 0.0 else 0.0),
    )
    if after.to_and_fro >= TO_AND_FRO:
        return SWINGS.format(after.largest, after.to_and_fro), after
    return (SENTENCE.format(after.largest, after.time) if after.time >= MOST else ""), after
