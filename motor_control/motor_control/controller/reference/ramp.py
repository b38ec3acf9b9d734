"""Ramp the reference: 0 where it is next to 0, no faster than the rate limit lets it, with the slope to feed forward.

All rules for a motor that shall stand go by a reference of exactly 0, and a joystick or a planner sends 1e-6.
"""

from typing import NamedTuple

# [edges/s] slower than one edge in 20 s is 0. It cannot be much more: an observer follows 0.1 edges a second. At
# 174 rad/s and 96 edges a turn it is 2e-5 of the top speed.
REST = 0.05


class Target(NamedTuple):
    """Where the speed shall be at this sample."""

    reference: float  # [rad/s] behind the rate limit
    slope: float  # [rad/s²]


def round_to_rest(wanted: float, slot: float) -> float:
    """Round a speed [rad/s] to 0 where less than `REST` slots [rad] a second are wanted: the motor shall stand."""
    return 0.0 if abs(wanted) < REST * slot else wanted


def approach(wanted: float, start: float, rate: float, dt: float, gentle: float = 0.0) -> Target:
    """Let a reference [rad/s] through as far as the rate limit [rad/s²] lets it; 0 is no limit.

    The slope of a step that takes less than `gentle` [s] is given as 0: feeding it forward would be a kick.
    """
    if rate == 0.0:
        return Target(wanted, 0.0)
    reference = start + min(max(wanted - start, -rate * dt), rate * dt)
    feed = dt > 0.0 and abs(wanted - start) >= rate * gentle
    return Target(reference, (reference - start) / dt if feed else 0.0)
