"""Detect a stall: full voltage with fewer edges than can be told from a standstill."""

from dataclasses import dataclass

from motor_control.controller.faults.evidence import Config, Seen

REPORTABLE = 10.0  # [edges/s] slower than this, every plant reports a standstill
STALL = (
    "The motor got {:.3g} V for {:.2g} s, all it may get, and no edge came (or not 10 a second): see whether the shaft "
    "is blocked, the encoder or the motor is not connected, or voltage_limit is too low."
)


@dataclass(frozen=True, slots=True)
class State:
    """For how long, and how many edges came meanwhile."""

    time: float = 0.0  # [s]
    edges: int = 0


NONE = State()


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    if not seen.full:
        return "", NONE
    time, edges = state.time + seen.dt, state.edges + seen.motion.edges
    still = edges <= 1.0 + REPORTABLE * time if config.slot > 0.0 else seen.sample.speed == 0.0
    if not still:
        return "", NONE
    reason = STALL.format(seen.sample.voltage, time) if 0.0 < config.stall_time <= time else ""
    return reason, State(time, edges)
