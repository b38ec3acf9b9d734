"""Estimate a sample's age from two clocks that nobody has set: the plant's and ours.

The difference between them is smallest for the sample that took the least time to get here, so a sample is as old as
its own difference is larger (plus that least time, which no one can know). The two clocks may run apart: the smallest
difference is let rise by `DRIFT`, more than a ceramic resonator is off.
"""

from dataclasses import dataclass

DRIFT = 0.01  # [s/s] twice the 0.5 % of a board with a ceramic resonator
PAUSE = 0.4  # [s] without a sample, in which a plant's clock may have stood still: a simulation that was held up


@dataclass(frozen=True, slots=True)
class LatencyState:
    """The smallest difference so far."""

    sample_time: int  # [ns] of the latest sample
    now: float  # [s] when it came
    offset: float  # [s] the smallest of now − sample_time


def track_latency(state: LatencyState | None, sample_time: int, now: float) -> tuple[float, LatencyState]:
    """Estimate the age [s] of a sample that is answered at `now` [s]; a clock that steps back or pauses begins anew."""
    difference = now - sample_time * 1e-9
    if state is None or sample_time < state.sample_time or now - state.now > PAUSE:
        return 0.0, LatencyState(sample_time, now, difference)
    offset = min(state.offset + DRIFT * max(now - state.now, 0.0), difference)
    return difference - offset, LatencyState(sample_time, now, offset)
