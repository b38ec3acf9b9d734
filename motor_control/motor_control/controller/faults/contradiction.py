"""Detect a plant that contradicts itself: its speed, or the times of its edges, are not those of the edges it counts.

A driver that repeats an old sample, or a speed that is worked out by other counts than the edges, makes a loop drive
the motor to full speed: what it regulates does not answer. Both are averaged over the same 0.15 s. At each edge the
reported speed jumps, and in between it falls as one over the time since the latest, so that where edges come in bursts
the two averages differ by a factor of 2 and a half; where they are `MANY`, by a tenth. Below `LEAST` edges a second a
plant may report a standstill. A count that jumps once, as that of a board which was reset, counts as `JUMP` times what
was there and an edge at most.

An observer goes by the times of the edges. Of a plant that stamps them with another clock than its samples, or with one
that stands, it hears of no edge in time, and drives the motor to full speed. An edge that was counted since the sample
before has come since then, but for as long as a sample takes on its way.
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
STAMPS = 5  # samples in a row with edges that came at another time
LASTS = 0.3  # [s] for which it does: a standstill is reported 0.1 s after the latest edge
SENTENCE = (
    "The plant says {:.3g} rad/s on motor/speed, and its edges {:.3g} rad/s: see whether the driver repeats itself, "
    "and what edges_per_revolution is."
)
ODD_STAMP = (
    "The plant's edges do not come when it says: the latest was counted in the last {:.3g} s, and is stamped {:+.3g} s "
    "from its sample: edge_time and sample_time on motor/speed have to be of one clock, in ns."
)


@dataclass(frozen=True, slots=True)
class State:
    """What was reported, and for how long it has not been true."""

    reported: float = 0.0  # [rad/s] average of the last 0.15 s
    counted: float = 0.0  # [rad/s] likewise, by edges
    time: float = 0.0  # [s]
    odd: int = 0  # samples in a row whose latest edge came at another time


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
    after = State(reported, counted, state.time + seen.dt if false else 0.0, _count_odd_stamps(config, state.odd, seen))
    if after.odd >= STAMPS:
        return ODD_STAMP.format(seen.dt, -_age(seen)), after
    return (SENTENCE.format(reported, counted) if after.time >= LASTS else ""), after


def _count_odd_stamps(config: Config, before: int, seen: Seen) -> int:
    """Count on, where edges have come: by one if the latest has come at another time, else from 0.

    Without a model nothing goes by these times, and such a plant is let be.
    """
    if seen.motion.edges == 0 or seen.sample.edge_time == 0 or config.tick == 0.0 or config.kv == 0.0:
        return before
    return 0 if -seen.dt <= _age(seen) <= 2.0 * seen.dt else before + 1


def _age(seen: Seen) -> float:
    """[s] of the latest edge at its sample."""
    return (seen.sample.sample_time - seen.sample.edge_time) * 1e-9
