"""Find the flank that passed at an edge: where it was, which way the shaft turned, and how many edges were missed.

Turning on, a flank stands one slot after the last. After a reversal the other flank of a hole is seen, somewhere in
between (half a slot is taken, with the doubt `turn`), and angles count from there anew. A single channel does not say
which of the two it was: that is decided by how likely each makes the angle and the sign of the predicted speed. Only
under a voltage against the motion there is a choice; with one that drives it on, a motor does not turn round.
"""

from math import copysign, erfc, floor, inf, log, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.filter_state import Estimate, FilterState, Noise
from motor_model.compiled import compiled
from motor_model.effects import INDEX

BIAS = INDEX["bias_voltage"]
FORGIVEN = 0.05  # of the edges may be missed in the long run; more is another speed

Floats = NDArray[np.float64]


class Flank(NamedTuple):
    """A flank that may have been passed."""

    angle: float  # [rad]
    variance: float  # [rad²]
    log_likelihood: float


class Direction(NamedTuple):
    """Which way the shaft turned at an edge."""

    side: float
    margin: float  # log-likelihood by which it beats the other way
    is_open: bool  # there was a choice


class Found(NamedTuple):
    """A flank's place with the edges that were missed before it."""

    angle: float  # [rad]
    missed: float


class Passed(NamedTuple):
    """The flank that passed."""

    way: Direction
    angle: float  # [rad]
    variance: float  # [rad²]
    missed: float  # edges before it
    carry_on: bool  # the shaft turned on, so that angles count from the flank before


@compiled
def log_normal_cdf(x: float) -> float:
    """Compute the logarithm of the normal distribution function, far out too."""
    if x < -8.0:
        return -0.5 * x * x - log(-x) - 0.919
    return log(0.5 * erfc(-x / sqrt(2.0)))


@compiled
def locate_flank(noise: Noise, x: FilterState, side: float, steps: float) -> Flank:
    """Locate the flank that was passed if the shaft turned this way, `steps` after the last one."""
    s, c, last = x.estimate.motor, x.estimate.covariance, x.history.edge.side
    where, sigma = s.angle, noise.slot
    if side == last:
        where, sigma = side * steps * noise.slot, noise.flank
    elif last != 0.0:
        where, sigma = (floor(s.angle / noise.slot) + 0.5) * noise.slot, noise.turn
    variance = sigma * sigma
    total = c.aa + variance
    shift = where - s.angle
    this_way = log_normal_cdf(side * s.speed / sqrt(c.ss + 1e-30))
    return Flank(where, variance, this_way - 0.5 * (shift * shift / total + log(total)))


@compiled
def locate_taken_back(noise: Noise, x: FilterState, side: float) -> Flank:
    """Locate the flank of an edge without a period: two channels take back an edge where its hole is left backwards.

    The first such edge is the last flank, passed the other way; the next one the other flank of the hole behind.
    """
    if side == x.history.edge.side:
        return Flank(0.5 * side * noise.slot, noise.turn * noise.turn, 0.0)
    return Flank(0.0, noise.flank * noise.flank, 0.0)


@compiled
def choose_direction(p: Floats, noise: Noise, x: FilterState, u: float, steps: float) -> Direction:
    """Choose the way the shaft turned, under an effective voltage u [V]."""
    side = x.history.edge.side
    told = steps if steps != 0.0 and not noise.single else x.estimate.motor.speed
    if noise.single and (u - p[BIAS]) * side < 0.0:  # a motor that is driven on does not turn round
        ahead, back = locate_flank(noise, x, 1.0, steps), locate_flank(noise, x, -1.0, steps)
        margin = ahead.log_likelihood - back.log_likelihood
        return Direction(copysign(1.0, margin), abs(margin), True)
    if noise.single and side != 0.0:
        told = side
    return Direction(copysign(1.0, told), inf, False)


@compiled
def find_missed_edges(noise: Noise, x: Estimate, flank: Flank, side: float, missed: float) -> Found:
    """Move a flank on by the edges that were missed, if the motion should have shown some more."""
    lacking = floor(side * (x.motor.angle - flank.angle) / noise.slot + 0.5)
    there = flank.angle + side * lacking * noise.slot
    if 0.5 < lacking < 2.5 and abs(there - x.motor.angle) < 3.0 * sqrt(x.covariance.aa + flank.variance):
        return Found(there, missed + lacking)
    return Found(flank.angle, missed)


@compiled
def find_passed_flank(p: Floats, noise: Noise, x: FilterState, u: float, steps: float, bare: bool) -> Passed:
    """Find the flank that passed, `steps` after the last one that was used, under an effective voltage u [V].

    bare: an edge without a period, see `locate_taken_back`.
    """
    h = x.history
    way = choose_direction(p, noise, x, u, steps)
    taken_back = bare and not noise.single and h.edge.side != 0.0
    carry_on = way.side == h.edge.side and steps != 0.0 and not taken_back
    flank = locate_flank(noise, x, way.side, abs(steps))
    if taken_back:
        flank = locate_taken_back(noise, x, way.side)
    where, missed = flank.angle, max(h.missed - FORGIVEN * abs(steps), 0.0)
    if noise.missing and carry_on and missed < 1.0:
        where, missed = find_missed_edges(noise, x.estimate, flank, way.side, missed)
    return Passed(way, where, flank.variance, missed, carry_on)
