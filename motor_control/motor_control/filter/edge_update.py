"""Correct the state by an edge: where the shaft was when a flank passed, and which way it turned.

Turning on, a flank stands one slot after the last. After a reversal the other flank of a hole is seen, somewhere in
between (half a slot is taken, with the doubt `turn`), and angles count from there anew. A single channel does not say
which of the two it was: that is decided by how likely each makes the angle and the sign of the predicted speed. Only
under a voltage against the motion there is a choice; with one that drives it on, a motor does not turn round.
"""

from math import copysign, erfc, floor, inf, log, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.filter_state import (
    Consistency,
    Covariance,
    Estimate,
    FilterState,
    History,
    LatestEdge,
    Noise,
    Silence,
    correct_angle,
    inflate_covariance,
    place_motor,
)
from motor_control.filter.load_jump import FAR, UNEARNED, Jumps, detect_jump, forget_jumps, track_level
from motor_model.compiled import compiled
from motor_model.dynamics.forces import drive_of
from motor_model.effects import INDEX

KA, KS, BIAS, U_MAX = INDEX["ka"], INDEX["ks"], INDEX["bias_voltage"], INDEX["max_voltage"]
MEMORY = 0.8  # of the sum of innovations; its standard deviation is then 1/sqrt(1 - MEMORY²) = 1.67
ALARM = 4.0 / sqrt(1.0 - MEMORY * MEMORY)  # of that sum: the load has changed, or the speed
JUMP = 0.5 / 12.0  # of the supply, by which the load may have changed then
SHOCK = 6.0  # standard deviations of a single innovation: the speed itself has jumped
FORGIVEN = 0.05  # of the edges may be missed in the long run; more is another speed
SLOW = 0.05  # [s] for a slot: the speed assumed where an edge comes and nothing explains it

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


class Alarm(NamedTuple):
    """The covariance after a look at the innovations, and their sum from there on."""

    covariance: Covariance
    drift: float
    raised: bool


class Found(NamedTuple):
    """A flank's place with the edges that were missed before it."""

    angle: float  # [rad]
    missed: float


class EdgeUpdate(NamedTuple):
    """What an edge leads to."""

    state: FilterState
    jumps: Jumps
    log_likelihood: float
    margin: float  # how much more likely the chosen direction was than the other; infinite: no question


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
def raise_alarm(p: Floats, x: FilterState, shift: float, variance: float, drift: float, memory: float) -> Alarm:
    """Inflate the covariance where innovations say that something has happened.

    A load that has changed some time ago has moved speed and angle since, and so has a blow.
    """
    c = x.estimate.covariance
    drifted = abs(drift) > ALARM
    if drifted:
        ago, jump = 0.5 * memory, JUMP * p[U_MAX]
        c, drift = inflate_covariance(c, -0.5 * jump * ago * ago / p[KA], -jump * ago / p[KA], jump), 0.0
    shocked = abs(shift) > SHOCK * sqrt(c.aa + variance)
    if shocked:
        ago = max(x.history.edge.since, 1e-3)
        c = inflate_covariance(c, shift, shift / ago, 0.0)
    return Alarm(c, drift, drifted or shocked)


@compiled
def count_from_flank(noise: Noise, x: Estimate, where: float, side: float, carry_on: bool) -> Estimate:
    """Count the angle from the flank that was passed; after a reversal that flank is the origin."""
    s, c = x.motor, x.covariance
    speed = s.speed
    if speed * side <= 0.0:  # an edge passed this way is not passed while turning that way
        speed = side * sqrt(c.ss)
    if carry_on:
        return Estimate(place_motor(s, s.angle - where, speed, side), x.load, c)
    c = Covariance(noise.flank * noise.flank, 0.0, 0.0, c.ss, c.sl, c.ll)
    return Estimate(place_motor(s, 0.0, speed, side), x.load, c)


@compiled
def start_motion(p: Floats, noise: Noise, x: FilterState, u: float, steps: float) -> FilterState:
    """Start a motor that was believed to stand: an edge says that it has broken loose, and its speed is a guess."""
    e, h = x.estimate, x.history
    net = drive_of(p, u)[0] - p[BIAS]
    side = copysign(1.0, net)
    if not noise.single and steps != 0.0:
        side = copysign(1.0, steps)
    elif net == 0.0 and h.edge.side != 0.0:
        side = h.edge.side
    push = max(abs(net - e.load) - p[KS], 0.0) / p[KA]
    speed = max(sqrt(push * noise.slot), noise.slot / SLOW)
    c = Covariance(
        noise.flank * noise.flank, 0.0, 0.0, 0.25 * speed * speed, 0.0, e.covariance.ll + (JUMP * p[U_MAX]) ** 2
    )
    level = max(h.consistency.level, UNEARNED)
    history = History(LatestEdge(side, 0.0, 0.0, e.load), Silence(0.0, False), Consistency(0.0, 0.0, level), 0.0, 0.0)
    return FilterState(Estimate(place_motor(e.motor, 0.0, side * speed, side), e.load, c), history, x.elapsed)


@compiled
def update_at_edge(
    p: Floats, noise: Noise, x: FilterState, jumps: Jumps, u: float, steps: float, bare: bool
) -> EdgeUpdate:
    """Update the state at an edge, `steps` after the last one that was used, under an effective voltage u [V].

    A second channel gives steps a sign; 0 of them is there and back. bare: an edge without a period, see
    `locate_taken_back`.
    """
    e, h = x.estimate, x.history
    if e.motor.speed == 0.0:
        return EdgeUpdate(start_motion(p, noise, x, u, steps), forget_jumps(jumps), 0.0, inf)
    way = choose_direction(p, noise, x, u, steps)
    taken_back = bare and not noise.single and h.edge.side != 0.0
    carry_on = way.side == h.edge.side and steps != 0.0 and not taken_back
    flank = locate_flank(noise, x, way.side, abs(steps))
    if taken_back:
        flank = locate_taken_back(noise, x, way.side)
    where, variance = flank.angle, flank.variance
    missed = max(h.missed - FORGIVEN * abs(steps), 0.0)
    if noise.missing and carry_on and missed < 1.0:
        where, missed = find_missed_edges(noise, e, flank, way.side, missed)
    shift, total = where - e.motor.angle, e.covariance.aa + variance
    score, memory = shift / sqrt(total), MEMORY * h.consistency.memory + h.edge.since
    drift = MEMORY * h.consistency.drift + score
    surprised = abs(drift) > ALARM or abs(score) > SHOCK
    test = detect_jump(p, x, jumps, shift, total, carry_on and abs(shift) < FAR * noise.slot)
    after, jumps = test.estimate, test.jumps
    if test.found:
        drift = 0.0
    else:
        alarm = raise_alarm(p, x, shift, variance, drift, memory)
        drift = alarm.drift
        if alarm.raised:
            jumps = forget_jumps(jumps)
        after = correct_angle(Estimate(e.motor, e.load, alarm.covariance), shift, alarm.covariance.aa + variance, 1.0)
    history = History(
        LatestEdge(way.side, 0.0, shift, after.load),
        Silence(0.0, False),
        Consistency(drift, memory, track_level(h.consistency.level, score, carry_on)),
        missed,
        h.doubt,
    )
    after = count_from_flank(noise, after, where, way.side, carry_on)
    margin = 0.0 if way.is_open and surprised else way.margin
    return EdgeUpdate(FilterState(after, history, x.elapsed), jumps, -0.5 * (score * score + log(total)), margin)
