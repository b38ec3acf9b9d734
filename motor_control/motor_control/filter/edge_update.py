"""Correction by an edge: where the shaft was when a flank passed, and which way it turned.

Turning on, a flank stands one slot after the last. After a reversal the other flank of a hole is seen, somewhere in
between (half a slot is taken, with the doubt `turn`), and angles count from there anew. A single channel does not say
which of the two it was: that is decided by how likely each makes the angle and the sign of the predicted speed. Only
under a voltage against the motion there is a choice; with one that drives it on, a motor does not turn round.
"""

from math import copysign, erfc, floor, inf, log, sqrt

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.filter_state import Belief, Noise, Spread, Trail, corrected, moved, widened
from motor_control.filter.load_jump import UNEARNED, explained, forgotten, levelled
from motor_model.compiled import compiled
from motor_model.dynamics.forces import drive_of
from motor_model.effects import INDEX

KA, KS, BIAS = INDEX["ka"], INDEX["ks"], INDEX["bias_voltage"]
MEMORY = 0.8  # of the sum of innovations; its standard deviation is then 1/sqrt(1 - MEMORY²) = 1.67
ALARM = 4.0 / sqrt(1.0 - MEMORY * MEMORY)  # of that sum: the load has changed, or the speed
JUMP = 0.5  # [V] by which the load may have changed then
SHOCK = 6.0  # standard deviations of a single innovation: the speed itself has jumped
FAR = 0.25  # of a slot: an edge is missed then rather than a load changed
FORGIVEN = 0.05  # of the edges may be missed in the long run; more is another speed
SLOW = 0.05  # [s] for a slot: the speed assumed where an edge comes and nothing explains it

Floats = NDArray[np.float64]


@compiled
def _log_normal(x: float) -> float:
    """The logarithm of the normal distribution function, far out too."""
    if x < -8.0:
        return -0.5 * x * x - log(-x) - 0.919
    return log(0.5 * erfc(-x / sqrt(2.0)))


@compiled
def _flank(noise: Noise, b: Belief, side: float, steps: float) -> tuple[float, float, float]:
    """The angle [rad] of the flank passed in a direction, its variance [rad²], the likelihood's logarithm."""
    s, c = b.motor, b.spread
    where, sigma = s.angle, noise.slot
    if side == b.trail.side:
        where, sigma = side * steps * noise.slot, noise.flank
    elif b.trail.side != 0.0:
        where, sigma = (floor(s.angle / noise.slot) + 0.5) * noise.slot, noise.turn
    variance = sigma * sigma
    total = c.aa + variance
    shift = where - s.angle
    this_way = _log_normal(side * s.speed / sqrt(c.ss + 1e-30))
    return where, variance, this_way - 0.5 * (shift * shift / total + log(total))


@compiled
def _anchored(noise: Noise, b: Belief, where: float, side: float, carry_on: bool) -> Belief:
    """The belief with its angle counted from the flank that was passed; after a reversal that flank is the origin."""
    s, c = b.motor, b.spread
    speed = s.speed
    if speed * side <= 0.0:  # an edge passed this way is not passed while turning that way
        speed = side * sqrt(c.ss)
    if carry_on:
        return Belief(moved(s, s.angle - where, speed, side), b.load, c, b.trail, b.elapsed)
    spread = Spread(noise.flank * noise.flank, 0.0, 0.0, c.ss, c.sl, c.ll)
    return Belief(moved(s, 0.0, speed, side), b.load, spread, b.trail, b.elapsed)


@compiled
def _started(p: Floats, noise: Noise, b: Belief, u: float, steps: float) -> Belief:
    """An edge from a motor that was believed to stand: it has just broken loose, and its speed is a guess."""
    net = drive_of(p, u)[0] - p[BIAS]
    side = copysign(1.0, net)
    if not noise.single and steps != 0.0:
        side = copysign(1.0, steps)
    elif net == 0.0 and b.trail.side != 0.0:
        side = b.trail.side
    push = max(abs(net - b.load) - p[KS], 0.0) / p[KA]
    speed = max(sqrt(push * noise.slot), noise.slot / SLOW)
    c = b.spread
    spread = Spread(noise.flank * noise.flank, 0.0, 0.0, 0.25 * speed * speed, 0.0, c.ll + JUMP * JUMP)
    return Belief(moved(b.motor, 0.0, side * speed, side), b.load, spread, b.trail, b.elapsed)


@compiled
def _alarmed(p: Floats, b: Belief, shift: float, variance: float, drift: float, memory: float) -> tuple[Belief, float]:
    """The belief, less certain where innovations say that something has happened, and their sum from there on.

    A load that has changed some time ago has moved speed and angle since, and so has a blow.
    """
    c = b.spread
    if abs(drift) > ALARM:
        ago = 0.5 * memory
        c, drift = widened(c, -0.5 * JUMP * ago * ago / p[KA], -JUMP * ago / p[KA], JUMP), 0.0
    if abs(shift) > SHOCK * sqrt(c.aa + variance):
        ago = max(b.trail.since, 1e-3)
        c = widened(c, shift, shift / ago, 0.0)
    return Belief(b.motor, b.load, c, b.trail, b.elapsed), drift


@compiled
def _side(p: Floats, noise: Noise, b: Belief, u: float, steps: float) -> tuple[float, float, bool]:
    """Which way the shaft turned, how much more likely than the other way, and whether that was open."""
    told = steps if steps != 0.0 and not noise.single else b.motor.speed
    if noise.single and (u - p[BIAS]) * b.trail.side < 0.0:  # a motor that is driven on does not turn round
        choice = _flank(noise, b, 1.0, steps)[2] - _flank(noise, b, -1.0, steps)[2]
        return copysign(1.0, choice), abs(choice), True
    if noise.single and b.trail.side != 0.0:
        told = b.trail.side
    return copysign(1.0, told), inf, False


@compiled
def _caught_up(
    noise: Noise, b: Belief, where: float, variance: float, side: float, missed: float
) -> tuple[float, float]:
    """The angle [rad] of a flank, and how many edges were missed, if the motion should have shown some more."""
    lacking = floor(side * (b.motor.angle - where) / noise.slot + 0.5)
    there = where + side * lacking * noise.slot
    if 0.5 < lacking < 2.5 and abs(there - b.motor.angle) < 3.0 * sqrt(b.spread.aa + variance):
        return there, missed + lacking
    return where, missed


@compiled
def edge_passed(
    p: Floats, noise: Noise, b: Belief, jumps: Floats, u: float, steps: float
) -> tuple[Belief, float, float]:
    """The belief once an edge has come, `steps` after the last one that was used; u: effective voltage [V].

    A second channel gives steps a sign; 0 of them is there and back. Beside the belief: the edge's log-likelihood, and
    how much more likely the chosen direction was than the other (infinite where there is no question).
    """
    t = b.trail
    if b.motor.speed == 0.0:
        b, level = _started(p, noise, b, u, steps), max(t.level, UNEARNED)
        forgotten(jumps)
        trail = Trail(b.motor.direction, 0.0, 0.0, False, 0.0, 0.0, 0.0, 0.0, 0.0, b.load, level)
        return Belief(b.motor, b.load, b.spread, trail, b.elapsed), 0.0, inf
    side, choice, is_open = _side(p, noise, b, u, steps)
    carry_on = side == t.side and steps != 0.0
    where, variance, _likelihood = _flank(noise, b, side, abs(steps))
    missed = max(t.missed - FORGIVEN * abs(steps), 0.0)
    if noise.missing and carry_on and missed < 1.0:
        where, missed = _caught_up(noise, b, where, variance, side, missed)
    shift, total = where - b.motor.angle, b.spread.aa + variance
    score, memory = shift / sqrt(total), MEMORY * t.memory + t.since
    drift = MEMORY * t.drift + score
    if is_open and (abs(drift) > ALARM or abs(score) > SHOCK):
        choice = 0.0
    after, jumped = explained(p, b, jumps, shift, total, carry_on and abs(shift) < FAR * noise.slot)
    if jumped:
        drift = 0.0
    else:
        after, drift = _alarmed(p, b, shift, variance, drift, memory)
        if after.spread.aa != b.spread.aa:
            forgotten(jumps)
        after = corrected(after, shift, after.spread.aa + variance, 1.0)
    level = levelled(t.level, score, carry_on)
    trail = Trail(side, 0.0, 0.0, False, drift, memory, missed, t.doubt, shift, after.load, level)
    after = Belief(after.motor, after.load, after.spread, trail, after.elapsed)
    return _anchored(noise, after, where, side, carry_on), -0.5 * (score * score + log(total)), choice
