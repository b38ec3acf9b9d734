"""Predict the filter's state: the mean by the motor model's own step, the covariance by its linearisation.

To what that makes of it, the load's random walk q and the torque noise n add, in volts: d(δd)/dt = q, d(δω)/dt = −n/ka.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_control.filter.filter_state import (
    Covariance,
    Estimate,
    FilterState,
    History,
    LatestEdge,
    Noise,
)
from motor_control.filter.linearisation import linearise_motion
from motor_model.compiled import compiled
from motor_model.dynamics.bridge import effective_voltage
from motor_model.dynamics.motor import advance
from motor_model.effects import INDEX

KA, BIAS, DELAY = INDEX["ka"], INDEX["bias_voltage"], INDEX["delay"]

Floats = NDArray[np.float64]


class Commands(NamedTuple):
    """The latest commands, the newest first; arrays of shape (M,)."""

    times: Floats  # [s] at which each was latched, before the sample
    voltages: Floats  # [V]


@compiled
def add_load(p: Floats, load: float) -> Floats:
    """Give a copy of the model with this load [V] beside its own."""
    loaded = p.copy()
    loaded[BIAS] += load
    return loaded


@compiled
def predict_covariance(p: Floats, noise: Noise, c: Covariance, u: float, speed: float, dt: float) -> Covariance:
    """Predict the covariance over dt [s] at an effective voltage u [V] and about this speed [rad/s]."""
    gain, reach, push, pull = linearise_motion(p, u, speed, dt)
    b = -1.0 / p[KA]
    as1 = c.as_ + reach * c.ss + pull * c.sl
    al1 = c.al + reach * c.sl + pull * c.ll
    aa1 = c.aa + reach * c.as_ + pull * c.al + reach * as1 + pull * al1
    sl1 = gain * c.sl + push * c.ll
    ss1 = gain * (gain * c.ss + push * c.sl) + push * sl1
    q, n = noise.walk * dt, noise.shake * b * b * dt
    return Covariance(
        aa1 + dt * dt * (n / 3.0 + q * b * b * dt * dt / 20.0),
        gain * as1 + push * al1 + dt * (0.5 * n + q * b * b * dt * dt / 8.0),
        al1 + q * b * dt * dt / 6.0,
        ss1 + n + q * b * b * dt * dt / 3.0,
        sl1 + 0.5 * q * b * dt,
        c.ll + q,
    )


@compiled
def _predict_estimate(
    p: Floats, noise: Noise, x: Estimate, loaded: Floats, command: float, elapsed: float, dt: float
) -> Estimate:
    """Predict mean and covariance over dt [s] of one command [V]; `loaded` is the model p under the estimated load."""
    s, c = x.motor, x.covariance
    after = advance(loaded, command, s, elapsed, dt)
    c = predict_covariance(p, noise, c, effective_voltage(p, command), 0.5 * (s.speed + after.speed), dt)
    if after.speed == 0.0:  # friction holds it, and how fast it is no load can tell
        c = Covariance(c.aa, 0.0, c.al, 0.0, 0.0, c.ll)
    return Estimate(after, x.load, c)


@compiled
def _predict_held(p: Floats, noise: Noise, x: FilterState, loaded: Floats, command: float, dt: float) -> FilterState:
    """Predict the state over dt [s] of one command [V] that has passed the delay."""
    e, h = x.estimate, x.history
    edge = h.edge
    since = 0.0 if e.motor.speed == 0.0 and not h.silence.stands else edge.since + dt
    edge = LatestEdge(edge.side, since, edge.innovation, edge.load)
    history = History(edge, h.silence, h.consistency, h.missed, h.doubt)
    if h.silence.stands:
        c = e.covariance
        e = Estimate(e.motor, e.load, Covariance(c.aa, 0.0, c.al, 0.0, 0.0, c.ll + noise.walk * dt))
    else:
        e = _predict_estimate(p, noise, e, loaded, command, x.elapsed, dt)
    return FilterState(e, history, x.elapsed + dt)


@compiled
def predict_state(
    p: Floats, noise: Noise, x: FilterState, commands: Commands, start: float, stop: float
) -> FilterState:
    """Predict the state from `start` to `stop` [s] after the sample that the commands' times count from."""
    if start >= stop:
        return x
    loaded, delay, t = add_load(p, x.estimate.load), p[DELAY], start
    times = commands.times
    while t < stop:
        row, until = 0, stop
        while row < len(times) - 1 and times[row] + delay > t + 1e-9:
            until = min(until, times[row] + delay)
            row += 1
        x = _predict_held(p, noise, x, loaded, commands.voltages[row], until - t)
        t = until
    return x


@compiled
def find_acting_voltage(p: Floats, commands: Commands, t: float) -> float:
    """Find the effective voltage [V] that acts at a time [s]."""
    row = 0
    while row < len(commands.times) - 1 and commands.times[row] + p[DELAY] > t + 1e-9:
        row += 1
    return effective_voltage(p, commands.voltages[row])
