"""A load that jumps: what each possible onset would have done to the edges since, and whether they show it.

A random walk follows a load calmly or quickly. So beside it stand hypotheses that the load has jumped once, in one of
the last slots, each with what a volt of it has done to the filter's error since: the signature (Willsky & Jones, "A
generalized likelihood ratio approach to the detection and estimation of jumps in linear systems", IEEE Transactions on
Automatic Control 21, 1976). With its angle G, the innovations ν and their variance S, jumps ~ N(0, J²) at a rate λ, and
an onset within a span of time,

    l = Σ G ν / S,   I = Σ G²/S + 1/J²,   the jump is N(l/I, 1/I),   odds = λ span exp(l²/2I) / √(I J²)

against none. Where all together are more likely than none, the belief takes up the mean and covariance of the mixture.
S is scaled by the innovations' own mean square: a disc or a model worse than told shows no jumps. That has to be earned
after every start and turn, because friction is what a model knows least.
"""

from math import exp, log, sqrt

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.filter_state import Belief, Spread, corrected, moved, widened
from motor_control.filter.linearisation import transition
from motor_model.compiled import compiled
from motor_model.effects import INDEX

KA = INDEX["ka"]
ANGLE, SPEED, LOAD, TOLD, KNOWN, SPAN = range(6)  # [rad/V], [rad/s/V], [V/V], [1/V] l, [1/V²] I - 1/J², [s] or 0: none
PARTS = 2  # of a slot that are told apart; one is too sure of the onset, four change nothing
SLOTS = 3  # that are looked at; what takes longer to show is no matter of one jump, and four find it no sooner
SHAPE = (PARTS * SLOTS, 6)
SIZE = 0.5  # [V] standard deviation of a jump
RATE = 0.3  # [1/s] of jumps; at 2 there are false alarms, at 1 nothing is found sooner
LONGEST = 0.01  # [s] of a slot: over 12 ms friction that the model lacks is a jump, and the motor hunts
FAINT = -4.0  # logarithm of odds that are not worth the sum
LEVELLING = 0.03  # share of an edge in the mean square of the innovations, so about 33 edges count
MOST = 9.0  # of a square that counts, so that a jump does not hide itself
UNEARNED = 3.0  # mean square that is assumed at first

Floats = NDArray[np.float64]


@compiled
def led_on(p: Floats, jumps: Floats, u: float, speed: float, dt: float) -> None:
    """The signatures dt [s] later, at an effective voltage u [V] and about this speed [rad/s]."""
    if dt <= 0.0:
        return
    gain, reach, push, pull = transition(p, u, speed, dt)
    for j in jumps:
        j[ANGLE] += reach * j[SPEED] + pull * j[LOAD]
        j[SPEED] = gain * j[SPEED] + push * j[LOAD]


@compiled
def forgotten(jumps: Floats) -> None:
    """No hypothesis is left."""
    jumps[:] = 0.0


@compiled
def _added(p: Floats, jumps: Floats, since: float) -> None:
    """Hypotheses of the slot that an edge ends, `since` [s] after the last one; the oldest go."""
    for k in range(len(jumps) - 1, -1, -1):
        if k >= PARTS:
            jumps[k] = jumps[k - PARTS]
        else:
            ago = since * (k + 0.5) / PARTS
            jumps[k] = 0.0
            jumps[k, ANGLE], jumps[k, SPEED], jumps[k, LOAD] = -0.5 * ago * ago / p[KA], -ago / p[KA], 1.0
            jumps[k, SPAN] = since / PARTS


@compiled
def _judged(jumps: Floats, c: Spread, shift: float, variance: float, level: float) -> None:
    """What an innovation [rad] of a variance [rad²] tells, and what its correction leaves of the signatures."""
    for j in jumps:
        g = j[ANGLE] / variance
        j[TOLD] += g * shift / level
        j[KNOWN] += g * j[ANGLE] / level
        j[ANGLE] -= c.aa * g
        j[SPEED] -= c.as_ * g
        j[LOAD] -= c.al * g


@compiled
def _estimate(j: Floats) -> tuple[float, float, float]:
    """The jump's mean [V], its variance [V²], the logarithm of its odds."""
    variance = 1.0 / (j[KNOWN] + 1.0 / (SIZE * SIZE))
    mean = j[TOLD] * variance
    return mean, variance, 0.5 * (j[TOLD] * mean + log(variance / (SIZE * SIZE))) + log(RATE * j[SPAN] + 1e-30)


@compiled
def _taken_up(b: Belief, jumps: Floats) -> Belief:
    """The belief with a jump in it where there is more for one than against; no hypothesis is left then."""
    top = FAINT
    for j in jumps:
        top = max(top, _estimate(j)[2])
    if top == FAINT:
        return b
    none, whole, angle, speed, load = exp(-top), 0.0, 0.0, 0.0, 0.0
    for j in jumps:
        mean, _variance, odds = _estimate(j)
        share = exp(odds - top)
        whole += share
        angle, speed, load = (
            angle + share * mean * j[ANGLE],
            speed + share * mean * j[SPEED],
            load + share * mean * j[LOAD],
        )
    n, s = 1.0 / (whole + none), b.motor
    angle, speed, load = n * angle, n * speed, n * load
    if whole < none or abs(load) > 3.0 * SIZE or s.speed * (s.speed + speed) <= 0.0:
        return b
    root = sqrt(n * none)
    c = widened(b.spread, root * angle, root * speed, root * load)
    for j in jumps:
        mean, variance, odds = _estimate(j)
        root = sqrt(n * exp(odds - top))
        c = widened(
            c, root * (mean * j[ANGLE] - angle), root * (mean * j[SPEED] - speed), root * (mean * j[LOAD] - load)
        )
        root *= sqrt(variance)
        c = widened(c, root * j[ANGLE], root * j[SPEED], root * j[LOAD])
    forgotten(jumps)
    return Belief(moved(s, s.angle + angle, s.speed + speed, s.direction), b.load + load, c, b.trail, b.elapsed)


@compiled
def explained(p: Floats, b: Belief, jumps: Floats, shift: float, variance: float, known: bool) -> tuple[Belief, bool]:
    """The belief corrected by an innovation [rad] of a variance [rad²] and a jump of the load; and whether it is one.

    known: the flank is one that follows the last one.
    """
    c, t = b.spread, b.trail
    if not known or t.since > LONGEST:
        forgotten(jumps)
        return b, False
    if len(jumps) == 0:
        return b, False
    _added(p, jumps, t.since)
    _judged(jumps, c, shift, variance, max(t.level, 1.0))
    after = _taken_up(corrected(b, shift, variance, 1.0), jumps)
    jumped = jumps[0, SPAN] == 0.0
    return (after if jumped else b), jumped


@compiled
def levelled(level: float, score: float, known: bool) -> float:
    """The innovations' mean square after one of so many standard deviations."""
    level += LEVELLING * (min(score * score, MOST) - level)
    return level if known else max(level, UNEARNED)
