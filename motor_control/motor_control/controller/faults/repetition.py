"""Detect a plant that repeats one sample: nothing in it changes, the voltage neither, although another is asked for.

Below some 40 edges a second a standstill is no contradiction, and the repeated voltage is a small one, which no check
minds; but the loop asks for more and more, and the motor gets it. A plant that applies nothing, or all that there is,
may well say the same again and again.
"""

from typing import NamedTuple

from motor_control.controller.faults.evidence import Config, Seen

# Of the voltage limit, between what is applied and what was asked for. A duty of 8 bits is rounded to 0.004 of it, and
# a supply smoothed by a driver is off by 0.05 while it sags.
OTHER = 0.1
# [s], beside samples that were on their way, for which it does: a link that loses a few frames repeats nothing.
LASTS, ANSWERS = 0.15, 3.0
SENTENCE = (
    "The plant has repeated one sample on motor/speed for {:.2g} s, with {:.3g} V although {:.3g} V were asked for: "
    "see whether the driver, or what reads for it, hangs."
)


class State(NamedTuple):
    """The latest sample but for its time, and for how long it has been repeated beside another voltage."""

    said: tuple[float, ...] = ()
    time: float = 0.0  # [s]


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    sample, asked = seen.sample, seen.asked
    said = sample.speed, sample.voltage, sample.edge_count, sample.edge_time, sample.edge_period
    other = abs(asked - sample.voltage) > OTHER * seen.voltage_limit
    limited = seen.full and asked * sample.voltage > 0.0 and abs(asked) >= abs(sample.voltage)
    repeated = said == state.said and other and sample.voltage != 0.0 and not limited
    time = state.time + seen.dt if repeated else 0.0
    lasts = time > LASTS + ANSWERS * seen.dt and config.stall_time > 0.0
    return (SENTENCE.format(time, sample.voltage, asked) if lasts else ""), State(said, time)
