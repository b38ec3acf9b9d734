"""Test the edges for a jump of the load: a generalised likelihood ratio test over its possible onsets.

A random walk follows a load calmly or quickly. So beside it stand hypotheses that the load has jumped once, in one of
the last slots, each with what a volt of it has done to the filter's error since: the signature (Willsky & Jones, "A
generalized likelihood ratio approach to the detection and estimation of jumps in linear systems", IEEE Transactions on
Automatic Control 21, 1976). With its angle G, the innovations ν and their variance S, jumps ~ N(0, J²) at a rate λ, and
an onset within a span of time,

    l = Σ G ν / S,   I = Σ G²/S + 1/J²,   the jump is N(l/I, 1/I),   odds = λ span exp(l²/2I) / √(I J²)

against none. Where all together are more likely than none, the estimate takes up the mean and covariance of the
mixture. S is scaled by the innovations' own mean square: a disc or a model worse than told shows no jumps. That has to
be earned after every start and turn, because friction is what a model knows least.
"""

from math import exp, log, sqrt
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.filter_state import (
    Covariance,
    Estimate,
    FilterState,
    correct_angle,
    inflate_covariance,
    place_motor,
)
from motor_control.filter.linearisation import linearise_motion
from motor_model.compiled import compiled
from motor_model.effects import INDEX

KA, U_MAX = INDEX["ka"], INDEX["max_voltage"]
PARTS = 2  # of a slot that are told apart; one is too sure of the onset, four change nothing
SLOTS = 3  # that are looked at; what takes longer to show is no matter of one jump, and four find it no sooner
SIZE = 0.5 / 12.0  # of the supply: standard deviation of a jump
RATE = 0.3  # [1/s] of jumps; at 2 there are false alarms, at 1 nothing is found sooner
LONGEST = 0.01  # [s] of a slot: over 12 ms friction that the model lacks is a jump, and the motor hunts
FAR = 0.25  # of a slot: an edge is missed then rather than a load changed
FAINT = -4.0  # logarithm of odds that are not worth the sum
LEVELLING = 0.03  # share of an edge in the mean square of the innovations, so about 33 edges count
MOST = 9.0  # of a square that counts, so that a jump does not hide itself
UNEARNED = 3.0  # mean square that is assumed at first

Floats = NDArray[np.float64]
Jumps = NDArray[Any]  # hypotheses, the newest onset first: records of JUMP, shape (PARTS * SLOTS,); (0,): no test
JUMP = np.dtype(
    [
        ("angle", np.float64),  # [rad/V] what a volt of the jump has done to the filter's error by now
        ("speed", np.float64),  # [rad/s/V]
        ("load", np.float64),  # [V/V]
        ("told", np.float64),  # [1/V] l
        ("known", np.float64),  # [1/V²] I − 1/J²
        ("span", np.float64),  # [s] in which the onset lies; 0: no hypothesis
    ]
)


class JumpEstimate(NamedTuple):
    """What one hypothesis says of its jump."""

    mean: float  # [V]
    variance: float  # [V²]
    log_odds: float  # against no jump


class JumpTest(NamedTuple):
    """The outcome of the test at an edge."""

    estimate: Estimate
    jumps: Jumps
    found: bool


def no_jumps() -> Jumps:
    """Make a table without a hypothesis."""
    return np.zeros(PARTS * SLOTS, dtype=JUMP)


@compiled
def forget_jumps(jumps: Jumps) -> Jumps:
    """Drop all hypotheses."""
    return np.zeros_like(jumps)


@compiled
def predict_jumps(p: Floats, jumps: Jumps, u: float, speed: float, dt: float) -> Jumps:
    """Predict the signatures over dt [s] at an effective voltage u [V] and about this speed [rad/s]."""
    if dt <= 0.0:
        return jumps
    t = linearise_motion(p, u, speed, dt)
    jumps = jumps.copy()
    for j in jumps:
        j.angle += t.reach * j.speed + t.pull * j.load
        j.speed = t.gain * j.speed + t.push * j.load
    return jumps


@compiled
def add_onsets(p: Floats, jumps: Jumps, since: float) -> Jumps:
    """Add hypotheses for the slot that an edge ends, `since` [s] after the last one; the oldest go."""
    after = jumps.copy()
    for k in range(len(jumps)):
        if k >= PARTS:
            after[k] = jumps[k - PARTS]
        else:
            ago = since * (k + 0.5) / PARTS
            after[k].angle, after[k].speed, after[k].load = -0.5 * ago * ago / p[KA], -ago / p[KA], 1.0
            after[k].told, after[k].known, after[k].span = 0.0, 0.0, since / PARTS
    return after


@compiled
def weigh_jumps(jumps: Jumps, c: Covariance, shift: float, variance: float, level: float) -> Jumps:
    """Weigh an innovation `shift` [rad] of a variance [rad²], and reduce the signatures by the filter's correction."""
    jumps = jumps.copy()
    for j in jumps:
        g = j.angle / variance
        j.told += g * shift / level
        j.known += g * j.angle / level
        j.angle -= c.aa * g
        j.speed -= c.as_ * g
        j.load -= c.al * g
    return jumps


@compiled
def estimate_jump(told: float, known: float, span: float, size: float) -> JumpEstimate:
    """Estimate a jump from what a hypothesis has gathered: l [1/V], I − 1/J² [1/V²], its span [s]; size: J [V]."""
    variance = 1.0 / (known + 1.0 / (size * size))
    mean = told * variance
    return JumpEstimate(mean, variance, 0.5 * (told * mean + log(variance / (size * size))) + log(RATE * span + 1e-30))


@compiled
def mix_jumps(x: Estimate, jumps: Jumps, size: float) -> JumpTest:
    """Add the mixture of all jumps to the estimate where they are more likely than none; size: J [V]."""
    top = FAINT
    for j in jumps:
        top = max(top, estimate_jump(j.told, j.known, j.span, size).log_odds)
    if top == FAINT:
        return JumpTest(x, jumps, False)
    none, whole, angle, speed, load = exp(-top), 0.0, 0.0, 0.0, 0.0
    for j in jumps:
        one = estimate_jump(j.told, j.known, j.span, size)
        share = exp(one.log_odds - top)
        whole += share
        angle, speed, load = (
            angle + share * one.mean * j.angle,
            speed + share * one.mean * j.speed,
            load + share * one.mean * j.load,
        )
    n, s = 1.0 / (whole + none), x.motor
    angle, speed, load = n * angle, n * speed, n * load
    if whole < none or abs(load) > 3.0 * size or s.speed * (s.speed + speed) <= 0.0:
        return JumpTest(x, jumps, False)
    root = sqrt(n * none)
    c = inflate_covariance(x.covariance, root * angle, root * speed, root * load)
    for j in jumps:
        one = estimate_jump(j.told, j.known, j.span, size)
        root, mean = sqrt(n * exp(one.log_odds - top)), one.mean
        c = inflate_covariance(
            c, root * (mean * j.angle - angle), root * (mean * j.speed - speed), root * (mean * j.load - load)
        )
        root *= sqrt(one.variance)
        c = inflate_covariance(c, root * j.angle, root * j.speed, root * j.load)
    motor = place_motor(s, s.angle + angle, s.speed + speed, s.direction)
    return JumpTest(Estimate(motor, x.load + load, c), forget_jumps(jumps), True)


@compiled
def detect_jump(p: Floats, x: FilterState, jumps: Jumps, shift: float, variance: float, known: bool) -> JumpTest:
    """Detect whether an innovation `shift` [rad] of a variance [rad²] and those before it show a jump of the load.

    known: the flank is one that follows the last one. Where there is no jump the estimate is returned as it was.
    """
    e, h = x.estimate, x.history
    if len(jumps) == 0:
        return JumpTest(e, jumps, False)
    if not known or h.edge.since > LONGEST:
        return JumpTest(e, forget_jumps(jumps), False)
    jumps = weigh_jumps(
        add_onsets(p, jumps, h.edge.since), e.covariance, shift, variance, max(h.consistency.level, 1.0)
    )
    test = mix_jumps(correct_angle(e, shift, variance, 1.0), jumps, SIZE * p[U_MAX])
    return test if test.found else JumpTest(e, test.jumps, False)


@compiled
def track_level(level: float, score: float, known: bool) -> float:
    """Track the innovations' mean square after one of `score` standard deviations."""
    level += LEVELLING * (min(score * score, MOST) - level)
    return level if known else max(level, UNEARNED)
