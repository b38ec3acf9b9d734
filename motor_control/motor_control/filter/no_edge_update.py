"""What it says that no edge has come, and which direction needs the smaller load.

Without an edge the shaft is within a slot of the last one. A prediction beyond that is cut back to the mean of the
truncated normal distribution (Simon, "Optimal State Estimation", 2006, section 7.5), again and again; when this has
gone on for a while the motor stands, whatever holds it.
"""

from math import copysign, erfc, exp, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.filter_state import Belief, Noise, Spread, Trail, corrected, mirrored, moved
from motor_model.compiled import compiled
from motor_model.effects import INDEX

KV, BIAS, U_MAX = INDEX["kv"], INDEX["bias_voltage"], INDEX["max_voltage"]
STANDS = 0.1  # [s] for which an edge has to be overdue
PREFERENCE = 1.5  # [V] by which the other direction's load has to be smaller
CERTAINTY = 0.05  # [s] for which it has to be
MOST_LOAD = 3.0  # supplies: a wrong direction needs two, and has to be recognised by it

Floats = NDArray[np.float64]


@compiled
def _truncated(excess: float) -> tuple[float, float]:
    """Shift and share of the variance that goes, in standard deviations, of a normal whose mean is that far outside."""
    if excess > 8.0:
        hazard = excess + 1.0 / excess
    else:
        hazard = exp(-0.5 * excess * excess) / sqrt(2.0 * pi) / (0.5 * erfc(excess / sqrt(2.0)))
    return hazard, hazard * (hazard - excess)


@compiled
def nothing_seen(noise: Noise, b: Belief, dt: float) -> Belief:
    """The belief at a sample of dt [s] after the last one, no edge since the one that angles count from."""
    t = b.trail
    excess = abs(b.motor.angle) - noise.slot * (2.0 if noise.missing else 1.0)  # that edge may have been missed
    if t.still or (excess <= 0.0 and t.overdue == 0.0):
        return b
    if excess > 0.0:
        total = b.spread.aa + noise.flank * noise.flank
        shift, shrink = _truncated(excess / sqrt(total))
        b = corrected(b, -copysign(shift * sqrt(total), b.motor.angle), total, shrink)
    s, overdue = b.motor, t.overdue + dt
    most = 2.0 * noise.slot / max(t.since, 1e-3)
    speed, load, still = min(max(s.speed, -most), most), b.load, overdue > STANDS
    if still:
        speed, load = 0.0, t.load
    trail = Trail(t.side, t.since, overdue, still, t.drift, t.memory, t.missed, t.doubt, t.innovation, t.load, t.level)
    return Belief(moved(s, s.angle, speed, s.direction), load, b.spread, trail, b.elapsed)


@compiled
def turned_round(p: Floats, noise: Noise, b: Belief, u: float, dt: float) -> Belief:
    """The belief in the direction that needs the smaller load: of a single channel the other one fits as well.

    ω and −ω explain the same edges under an effective voltage u [V] with loads that add up to 2u.
    """
    t, s, c = b.trail, b.motor, b.spread
    if not noise.single or s.speed == 0.0:
        return b
    other = 2.0 * (u - p[BIAS]) - b.load
    doubt = t.doubt + dt if abs(b.load) > abs(other) + PREFERENCE else 0.0
    if doubt <= CERTAINTY:
        trail = Trail(
            t.side, t.since, t.overdue, t.still, t.drift, t.memory, t.missed, doubt, t.innovation, t.load, t.level
        )
        return Belief(s, b.load, c, trail, b.elapsed)
    b = mirrored(b, other)
    c = b.spread
    return Belief(b.motor, other, Spread(c.aa, c.as_, c.al, c.ss, c.sl, c.ll + 1.0), b.trail, b.elapsed)


@compiled
def bounded(p: Floats, noise: Noise, b: Belief) -> Belief:
    """The belief within what can be: a load that the supply could overcome, ten times the speed that it gives."""
    c, s = b.spread, b.motor
    fastest, furthest = 10.0 * p[U_MAX] / p[KV], 1e3 * noise.slot
    load = min(max(b.load, -MOST_LOAD * p[U_MAX]), MOST_LOAD * p[U_MAX])
    speed, angle = min(max(s.speed, -fastest), fastest), min(max(s.angle, -furthest), furthest)
    if max(c.ss / (fastest * fastest), c.aa / (furthest * furthest), c.ll / (p[U_MAX] * p[U_MAX])) > 1.0:
        ss, aa, ll = min(c.ss, fastest * fastest), min(c.aa, furthest * furthest), min(c.ll, p[U_MAX] * p[U_MAX])
        c = Spread(aa, 0.0, 0.0, ss, 0.0, ll)
    return Belief(moved(s, angle, speed, s.direction), load, c, b.trail, b.elapsed)
