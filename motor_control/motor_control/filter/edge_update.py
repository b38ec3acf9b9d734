"""Correct the state by an edge: the shaft was where the `flank` stands that passed.

Innovations that no noise explains mean that something has happened: a load has changed, or the speed has jumped. The
covariance grows then, so that the edges that follow are believed rather than the prediction.
"""

from math import copysign, inf, log, sqrt
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
from motor_control.filter.flank import find_passed_flank
from motor_control.filter.load_jump import FAR, UNEARNED, Jumps, detect_jump, forget_jumps, track_level
from motor_model.compiled import compiled
from motor_model.dynamics.forces import drive_of
from motor_model.effects import INDEX

KA, KS, BIAS, U_MAX = INDEX["ka"], INDEX["ks"], INDEX["bias_voltage"], INDEX["max_voltage"]
MEMORY = 0.8  # of the sum of innovations; its standard deviation is then 1/sqrt(1 - MEMORY²) = 1.67
ALARM = 4.0 / sqrt(1.0 - MEMORY * MEMORY)  # of that sum: the load has changed, or the speed
JUMP = 0.5 / 12.0  # of the supply, by which the load may have changed then
SHOCK = 6.0  # standard deviations of a single innovation: the speed itself has jumped
SLOW = 0.05  # [s] for a slot: the speed assumed where an edge comes and nothing explains it

Floats = NDArray[np.float64]


class Alarm(NamedTuple):
    """The covariance after a look at the innovations, and their sum from there on."""

    covariance: Covariance
    drift: float
    raised: bool


class EdgeUpdate(NamedTuple):
    """What an edge leads to."""

    state: FilterState
    jumps: Jumps
    log_likelihood: float
    margin: float  # how much more likely the chosen direction was than the other; infinite: no question


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

    A second channel gives steps a sign; 0 of them is there and back. bare: an edge without a period.
    """
    e, h = x.estimate, x.history
    if e.motor.speed == 0.0:
        return EdgeUpdate(start_motion(p, noise, x, u, steps), forget_jumps(jumps), 0.0, inf)
    way, where, variance, missed, carry_on = find_passed_flank(p, noise, x, u, steps, bare)
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
