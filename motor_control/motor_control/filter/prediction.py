"""Prediction: the mean by the motor model's own step, the covariance by the line through it (`transition.py`).

To what that makes of it, the load's random walk q and the torque noise n add, in volts: d(δd)/dt = q, d(δω)/dt = −n/ka.
"""

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.filter_state import Belief, Noise, Spread, Trail
from motor_control.filter.linearisation import transition
from motor_model.compiled import compiled
from motor_model.dynamics.bridge import effective_voltage
from motor_model.dynamics.motor import advance
from motor_model.effects import INDEX

KA, BIAS, DELAY = INDEX["ka"], INDEX["bias_voltage"], INDEX["delay"]

Floats = NDArray[np.float64]


@compiled
def _spread(p: Floats, noise: Noise, c: Spread, u: float, speed: float, dt: float) -> Spread:
    """The covariance after dt [s] at an effective voltage u [V] and about this speed [rad/s]."""
    gain, reach, push, pull = transition(p, u, speed, dt)
    b = -1.0 / p[KA]
    as1 = c.as_ + reach * c.ss + pull * c.sl
    al1 = c.al + reach * c.sl + pull * c.ll
    aa1 = c.aa + reach * c.as_ + pull * c.al + reach * as1 + pull * al1
    sl1 = gain * c.sl + push * c.ll
    ss1 = gain * (gain * c.ss + push * c.sl) + push * sl1
    q, n = noise.walk * dt, noise.shake * b * b * dt
    return Spread(
        aa1 + dt * dt * (n / 3.0 + q * b * b * dt * dt / 20.0),
        gain * as1 + push * al1 + dt * (0.5 * n + q * b * b * dt * dt / 8.0),
        al1 + q * b * dt * dt / 6.0,
        ss1 + n + q * b * b * dt * dt / 3.0,
        sl1 + 0.5 * q * b * dt,
        c.ll + q,
    )


@compiled
def _held(p: Floats, noise: Noise, b: Belief, command: float, dt: float) -> Belief:
    """The belief after dt [s] of one command [V] that has passed the delay; p[BIAS] already holds the load."""
    t, s, c = b.trail, b.motor, b.spread
    since = 0.0 if s.speed == 0.0 and not t.still else t.since + dt
    trail = Trail(
        t.side, since, t.overdue, t.still, t.drift, t.memory, t.missed, t.doubt, t.innovation, t.load, t.level
    )
    if t.still:
        spread = Spread(c.aa, 0.0, c.al, 0.0, 0.0, c.ll + noise.walk * dt)
        return Belief(s, b.load, spread, trail, b.elapsed + dt)
    after = advance(p, command, s, b.elapsed, dt)
    spread = _spread(p, noise, c, effective_voltage(p, command), 0.5 * (s.speed + after.speed), dt)
    if after.speed == 0.0:  # friction holds it, and how fast it is no load can tell
        spread = Spread(spread.aa, 0.0, spread.al, 0.0, 0.0, spread.ll)
    return Belief(after, b.load, spread, trail, b.elapsed + dt)


@compiled
def carried(p: Floats, noise: Noise, b: Belief, latched: Floats, start: float, stop: float) -> Belief:
    """The belief at `stop` if b is that at `start` [s]; latched: rows of (time [s], command [V]), the newest first.

    p is a copy of the model's own that is written to: its bias holds the load beside the model's.
    """
    bias, delay = p[BIAS], p[DELAY]
    p[BIAS] = bias + b.load
    t = start
    while t < stop:
        row, until = 0, stop
        while row < len(latched) - 1 and latched[row, 0] + delay > t + 1e-9:
            until = min(until, latched[row, 0] + delay)
            row += 1
        b = _held(p, noise, b, latched[row, 1], until - t)
        t = until
    p[BIAS] = bias
    return b


@compiled
def acting(p: Floats, latched: Floats, t: float) -> float:
    """[V] the effective voltage at a time [s]."""
    row = 0
    while row < len(latched) - 1 and latched[row, 0] + p[DELAY] > t + 1e-9:
        row += 1
    return effective_voltage(p, latched[row, 1])
