"""Detect a plant that contradicts itself: the speed that it reports is not the one of its own edges.

A driver that repeats an old sample, or a speed that is worked out by other counts than the edges, makes a loop drive
the motor to full speed: what it regulates does not answer. Both are averaged over the same 0.15 s. At each edge the
reported speed jumps, and in between it falls as one over the time since the latest, so that where edges come in bursts
the two averages differ by a factor of 2 and a half; where they are `MANY`, by a tenth. Below `LEAST` edges a second a
plant may report a standstill. A count that jumps once, as that of a board which was reset, counts as `JUMP` times what
was there and an edge at most.
"""

from dataclasses import dataclass
from math import exp

from motor_control.controller.faults.evidence import Config, Seen
from motor_control.controller.motion import SLOW

FACTOR, CLOSE = 3.0, 1.6  # CLOSE where edges are many: counts of another disc, or of both its polarities, are 2
MANY = 400.0  # [edges/s] of the larger one
LEAST = 40.0  # [edges/s] of the larger one: two edges close together every 60 ms make 33
JUMP = 4.0
SILENT = 0.2  # [s] without an edge, twice that after which 0 is reported: a speed is at most a slot in that time
LASTS = 0.3  # [s] for which it does: a standstill is reported 0.1 s after the latest edge
SENTENCE = (
    "The plant says {:.3g} rad/s on motor/speed, and its edges {:.3g} rad/s: see whether the driver repeats itself, "
    "and what edges_per_revolution is."
)


@dataclass(frozen=True, slots=True)
class State:
    """What was reported, and for how long it has not been true."""

    reported: float = 0.0  # [rad/s] average of the last 0.15 s
    counted: float = 0.0  # [rad/s] likewise, by edges
    time: float = 0.0  # [s]


def begin(speed: float) -> State:
    """Begin with a reported speed [rad/s]."""
    return State(abs(speed), abs(speed))


def check(config: Config, state: State, seen: Seen) -> tuple[str, State]:
    """Check one sample: a sentence if the motor has to stop, else ""."""
    if config.slot == 0.0 or config.stall_time == 0.0:
        return "", state
    share, least = 1.0 - exp(-seen.dt / SLOW), LEAST * config.slot
    reported = state.reported + share * (abs(seen.sample.speed) - state.reported)
    most = 1.0 + JUMP * max(state.counted, reported, least) * seen.dt / config.slot
    now = min(seen.motion.edges, most) * config.slot / seen.dt if seen.dt > 0.0 else state.counted
    counted = state.counted + share * (now - state.counted)
    low, high = sorted((reported, counted))
    silent = seen.motion.silent
    false = high >= least and high > (CLOSE if high >= MANY * config.slot else FACTOR) * low
    false |= silent >= SILENT and abs(seen.sample.speed) > FACTOR * config.slot / silent
    after = State(reported, counted, state.time + seen.dt if false else 0.0)
    return (SENTENCE.format(reported, counted) if after.time >= LASTS else ""), after
