"""Detect edges that are counted to and fro, and lead nowhere, under a voltage that turns any motor.

One of two channels is lost, as `motor_model.sensing.to_and_fro` says: the motor is reported to stand, and a loop gives
it all the voltage. How soon a motor has moved on follows from what is known of it.
"""

from dataclasses import dataclass
from math import isfinite

from motor_control.controller.faults.evidence import Config, Seen, find_push_time
from motor_model.sensing.to_and_fro import ToAndFro

HELD = 0.45  # of the voltage limit that friction and a load may take together: no motor is let run that needs more
LEAST = 0.1  # of it, beyond that
SLOTS = 2.0  # that what is left moves the motor by
WAIT = 1.5  # times the time that this takes
# [s] at least, with a model, and without: a flywheel of 5 s takes 0.12 s for two slots of 96 at 174 rad/s.
SHORTEST, SHORTEST_UNKNOWN = 0.05, 0.12
SLOWEST = 90.0  # [edges/s] at the top speed, where nothing is known of it
SENTENCE = (
    "Edges are counted to and fro under {:.3g} V, for {:.2g} s, and lead nowhere: see whether both channels of the "
    "encoder are connected, or what holds the shaft."
)


@dataclass(frozen=True, slots=True)
class State:
    """Edges within one slot of each other, under a voltage one way."""

    edges: ToAndFro = ToAndFro()
    voltage: float = 0.0  # [V] the least


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    sample, limit = seen.sample, seen.voltage_limit
    watches = config.two_channels and config.slot > 0.0 and config.stall_time > 0.0
    drives = limit > 0.0 and abs(sample.voltage) >= (HELD + LEAST) * limit
    anew = not (watches and drives and state.voltage * sample.voltage > 0.0)
    edges = state.edges.see(sample, anew)
    voltage = sample.voltage if edges.edges == 0 else min(state.voltage, sample.voltage, key=abs)
    patience = 0.0 if anew else _find_patience(config, seen, abs(voltage) / limit - HELD)
    lasts = not anew and edges.lasts(sample.sample_time, patience)
    took = (sample.sample_time - edges.since) * 1e-9
    return (SENTENCE.format(sample.voltage, took) if lasts else ""), State(edges, voltage)


def _find_patience(config: Config, seen: Seen, torque: float) -> float:
    """Find the time [s] after which a motor has moved on, by a torque as a share of the stall torque."""
    fastest = min(config.fastest, seen.motion.fastest(seen.voltage_limit))
    top = fastest if isfinite(fastest) and fastest > 0.0 else SLOWEST * config.slot
    least = SHORTEST if config.time_constant > 0.0 else SHORTEST_UNKNOWN
    return max(least, WAIT * find_push_time(config, top, max(torque, LEAST), SLOTS))
