"""Detect a stall: full voltage with fewer edges than can be told from a standstill, or an end of all edges at once.

A motor that comes to rest needs an angle for that: from a speed w, under a torque that is twice the one of full voltage
at rest (voltage, back-EMF and a load may help one another), w² τ/(4 w_top). If that is several slots by the speed at
the latest edge, and no edge has come for long, the line is lost, or the shaft has been caught; whatever the voltage is
meanwhile, as long as there is one. An observer that takes the silence for a load raises it slowly where the time
constant is long.
"""

from dataclasses import dataclass
from math import inf

from motor_control.controller.faults.evidence import Config, Seen

REPORTABLE = 10.0  # [edges/s] slower than this, every plant reports a standstill
SILENT = 0.1  # [s] without an edge, and so many slots that the motor should have gone:
SLOTS = 5.0
AT_ONCE = (
    "Edges do not fit the motor: they came at {:.3g} rad/s, and then for {:.2g} s none, but it does not stop within a "
    "slot. See whether the encoder is connected, or what has caught the shaft."
)
STALL = (
    "The motor got {:.3g} V for {:.2g} s, all it may get, and no edge came (or not 10 a second): see whether the shaft "
    "is blocked, the encoder or the motor is not connected, or voltage_limit is too low."
)


@dataclass(frozen=True, slots=True)
class State:
    """For how long, and how many edges came meanwhile."""

    time: float = 0.0  # [s]
    edges: int = 0
    speed: float = 0.0  # [rad/s] at the latest edge; 0: not known, or it does not matter any more
    idle: float = 0.0  # [s] of 0 V


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    idle = state.idle + seen.dt if seen.sample.voltage == 0.0 else 0.0
    speed = follow_speed(config, state.speed, seen) if idle < SILENT else 0.0
    if not seen.full:
        return explain_end(config, speed, seen), State(speed=speed, idle=idle)
    time, edges = state.time + seen.dt, state.edges + seen.motion.edges
    still = edges <= 1.0 + REPORTABLE * time if config.slot > 0.0 else seen.sample.speed == 0.0
    if not still:
        return explain_end(config, speed, seen), State(speed=speed, idle=idle)
    reason = STALL.format(seen.sample.voltage, time) if 0.0 < config.stall_time <= time else ""
    return reason or explain_end(config, speed, seen), State(time, edges, speed)


def follow_speed(config: Config, before: float, seen: Seen) -> float:
    """Follow the speed [rad/s] at the latest edge: by its period and the last 0.15 s, as a flank may chatter."""
    period, motion = seen.sample.edge_period, seen.motion
    if motion.edges == 0:
        return before
    return min(config.slot / period, motion.speed, motion.slow_speed) if period > 0.0 else 0.0


def explain_end(config: Config, speed: float, seen: Seen) -> str:
    """Explain that edges have ended within fewer slots than the model's motor needs to stop; "": they have not."""
    if config.kv == 0.0 or config.fastest == inf or config.stall_time == 0.0:
        return ""
    if seen.motion.silent < SILENT or seen.sample.voltage == 0.0:  # under 0 V it does not matter
        return ""
    angle = speed**2 * config.time_constant / (4.0 * config.fastest)
    return AT_ONCE.format(speed, seen.motion.silent) if angle >= SLOTS * config.slot > 0.0 else ""
