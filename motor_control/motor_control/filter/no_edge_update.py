"""Update the state where no edge has come, and test which direction needs the smaller load.

Without an edge the shaft is within a slot of the last one. A prediction beyond that is cut back to the mean of the
truncated normal distribution (Simon, "Optimal State Estimation", 2006, section 7.5), again and again; when this has
gone on for a while the motor stands, whatever holds it.
"""

from math import copysign, erfc, exp, pi, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.filter_state import (
    Covariance,
    Estimate,
    FilterState,
    History,
    Noise,
    Silence,
    correct_angle,
    mirror_motion,
    place_motor,
)
from motor_model.compiled import compiled
from motor_model.effects import INDEX

KV, BIAS, U_MAX = INDEX["kv"], INDEX["bias_voltage"], INDEX["max_voltage"]
STANDS = 0.1  # [s] for which an edge has to be overdue
PREFERENCE = 1.5 / 12.0  # of the supply, by which the other direction's load has to be smaller
CERTAINTY = 0.05  # [s] for which it has to be
TURNED = 1.0 / 12.0  # of the supply: standard deviation of the load after such a turn
MOST_LOAD = 3.0  # supplies: a wrong direction needs two, and has to be recognised by it

Floats = NDArray[np.float64]


class Truncation(NamedTuple):
    """What cutting a normal distribution off does, in its standard deviations."""

    shift: float  # of the mean
    shrink: float  # share of the variance that goes


@compiled
def truncate_normal(excess: float) -> Truncation:
    """Truncate a normal distribution at `excess` standard deviations below its mean."""
    if excess > 8.0:
        hazard = excess + 1.0 / excess - 2.0 / excess**3
        return Truncation(hazard, 1.0 - 1.0 / excess**2)  # the product below would cancel, and exceed 1 from 9,079 on
    hazard = exp(-0.5 * excess * excess) / sqrt(2.0 * pi) / (0.5 * erfc(excess / sqrt(2.0)))
    return Truncation(hazard, hazard * (hazard - excess))


@compiled
def update_without_edge(noise: Noise, x: FilterState, dt: float) -> FilterState:
    """Update the state at a sample dt [s] after the last one, with no edge since the one that angles count from."""
    e, h = x.estimate, x.history
    excess = abs(e.motor.angle) - noise.slot * (2.0 if noise.missing else 1.0)  # that edge may have been missed
    if h.silence.stands or (excess <= 0.0 and h.silence.overdue == 0.0):
        return x
    if excess > 0.0:
        total = e.covariance.aa + noise.flank * noise.flank
        cut = truncate_normal(excess / sqrt(total))
        e = correct_angle(e, -copysign(cut.shift * sqrt(total), e.motor.angle), total, cut.shrink)
    s, overdue = e.motor, h.silence.overdue + dt
    most = 2.0 * noise.slot / max(h.edge.since, 1e-3)
    speed, load, stands = min(max(s.speed, -most), most), e.load, overdue > STANDS
    if stands:
        speed, load = 0.0, h.edge.load
    e = Estimate(place_motor(s, s.angle, speed, s.direction), load, e.covariance)
    return FilterState(e, History(h.edge, Silence(overdue, stands), h.consistency, h.missed, h.doubt), x.elapsed)


@compiled
def turn_by_load(p: Floats, noise: Noise, x: FilterState, u: float, dt: float) -> FilterState:
    """Turn the motion round where the other direction has needed the smaller load for long enough.

    ω and −ω explain the same edges of a single channel under an effective voltage u [V] with loads that add up to 2u.
    """
    e, h = x.estimate, x.history
    if not noise.single or e.motor.speed == 0.0:
        return x
    other = 2.0 * (u - p[BIAS]) - e.load
    doubt = h.doubt + dt if abs(e.load) > abs(other) + PREFERENCE * p[U_MAX] else 0.0
    if doubt <= CERTAINTY:
        return FilterState(e, History(h.edge, h.silence, h.consistency, h.missed, doubt), x.elapsed)
    x = mirror_motion(x, other)
    c = x.estimate.covariance
    c = Covariance(c.aa, c.as_, c.al, c.ss, c.sl, c.ll + (TURNED * p[U_MAX]) ** 2)
    return FilterState(Estimate(x.estimate.motor, other, c), x.history, x.elapsed)


@compiled
def clamp_state(p: Floats, noise: Noise, x: FilterState) -> FilterState:
    """Clamp the state to what can be: a load that the supply could overcome, ten times the speed that it gives."""
    e = x.estimate
    c, s = e.covariance, e.motor
    fastest, furthest = 10.0 * p[U_MAX] / p[KV], 1e3 * noise.slot
    load = min(max(e.load, -MOST_LOAD * p[U_MAX]), MOST_LOAD * p[U_MAX])
    speed, angle = min(max(s.speed, -fastest), fastest), min(max(s.angle, -furthest), furthest)
    if max(c.ss / (fastest * fastest), c.aa / (furthest * furthest), c.ll / (p[U_MAX] * p[U_MAX])) > 1.0:
        ss, aa, ll = min(c.ss, fastest * fastest), min(c.aa, furthest * furthest), min(c.ll, p[U_MAX] * p[U_MAX])
        c = Covariance(aa, 0.0, 0.0, ss, 0.0, ll)
    return FilterState(Estimate(place_motor(s, angle, speed, s.direction), load, c), x.history, x.elapsed)
