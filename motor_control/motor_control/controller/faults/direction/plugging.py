"""Detect a motion that all the voltage which `plug_limit` leaves against it does not slow down.

Without a model the back-EMF is that of the last steady motion, friction included. A motor that has only crawled has
shown nearly nothing but friction: by it a fifth of the top speed seems to be three quarters, and the voltage against
such a motion is kept below a quarter, which a load may take (`spare`). With exchanged channels that voltage drives the
motion, and the motor keeps a steady speed for ever. But a load that is allowed and makes a motor turn backward is
braked by voltage and back-EMF together, so that the motion becomes slower; it is a fault that one does not.
"""

from dataclasses import dataclass

from motor_control.controller.faults.evidence import Config, Seen

KEEPS = 0.95  # of its speed: a motor that is plugged keeps more of it only with a time constant of 8 s and more
PLUG_TIME = 0.4  # [s] for which it does, at least
# Of the time constant, where the model says it: a motor that coasts without friction keeps more than 95 % for 0.051 of
# it, and less than that against a voltage.
PLUG_SHARE = 0.06
SENTENCE = (
    "The motor turns at {:.3g} rad/s against {:.3g} V, and does not become slower: see whether motor and encoder agree "
    "on the direction, or a load drives the motor."
)


@dataclass(frozen=True, slots=True)
class State:
    """A motion that is plugged."""

    time: float = 0.0  # [s]
    begun: float = 0.0  # [rad/s] its speed then


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    speed, voltage = seen.motion.slow_speed, seen.sample.voltage
    against = seen.plugs and voltage * seen.sample.speed < 0.0
    if not config.two_channels or config.stall_time == 0.0 or not against or speed < KEEPS * state.begun:
        return "", State(begun=speed if against else 0.0)
    after = State(state.time + seen.dt, state.begun or speed)
    patience = max(PLUG_TIME, PLUG_SHARE * config.time_constant)
    return (SENTENCE.format(speed, abs(voltage)) if after.time >= patience else ""), after
