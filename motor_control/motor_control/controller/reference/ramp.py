"""Ramp the reference: no faster than the rate limit lets it, and with the slope that is to be fed forward."""

from typing import NamedTuple


class Target(NamedTuple):
    """Where the speed shall be at this sample."""

    reference: float  # [rad/s] behind the rate limit
    slope: float  # [rad/s²]


def approach(wanted: float, start: float, rate: float, dt: float, gentle: float = 0.0) -> Target:
    """Let a reference [rad/s] through as far as the rate limit [rad/s²] lets it; 0 is no limit.

    The slope of a step that takes less than `gentle` [s] is given as 0: feeding it forward would be a kick.
    """
    if rate == 0.0:
        return Target(wanted, 0.0)
    reference = start + min(max(wanted - start, -rate * dt), rate * dt)
    feed = dt > 0.0 and abs(wanted - start) >= rate * gentle
    return Target(reference, (reference - start) / dt if feed else 0.0)
