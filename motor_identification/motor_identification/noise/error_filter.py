"""Filter the error of a simulated angle that a random torque disturbs: a Kalman filter of angle, speed and torque.

A motor with a torque T [V] more against it than its model falls behind the simulation. With b the simulated minus the
true angle and d the same of the speed,

    db/dt = d,   dd/dt = −α d + T/ka,   dT/dt = −T/τ + √(2σ²/τ)·w,   α = kv/ka

T is an Ornstein–Uhlenbeck process with strength σ and correlation time τ, filtered by the motor as any torque is. What
is observed is the angle at the ends of intervals, e = b + n, n ~ R (timer tick, irregular slots, counts); along a run
of intervals e is known up to a constant. The innovations of the filter give the likelihood (Schweppe 1965), and divided
by their standard deviations they are white. With σ = 0 and a growth q [rad²/s] of b this is the filter of
`angle_noise.py`.

An interval may hold an error that no noise makes, so that its density is contaminated (`contaminated_density.py`).
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from motor_identification.noise.contaminated_density import compute_log_density, compute_trust
from motor_identification.noise.torque_response import (
    ANGLE_D,
    ANGLE_T,
    BY_T,
    LEFT_D,
    LEFT_T,
    RESPONSES,
    TERMS,
    fill_response,
    fill_series,
)
from motor_identification.noise.torque_state import (
    Covariance,
    Means,
    correct,
    move,
    pass_pause,
    propagate,
    stationary_covariance,
    update,
)
from motor_identification.recording import Bools, Floats
from motor_model.compiled import compiled

GAINS = 12  # numbers of an interval that the filter of other increments needs
SAME_TIME = 1e-10  # of an interval: what an even sample period is rounded by, far below what any stamp can tell
LONG = 40.0  # time constants after which nothing is remembered


class _Stretches(NamedTuple):
    """The intervals of a recording, in runs, in each of which the angle is known up to a constant; `run_filter`'s."""

    fresh: Bools
    still: Bools
    pause: Floats
    duration: Floats
    start: Floats
    end: Floats


class _Process(NamedTuple):
    """The random process that is filtered; `run_filter`'s."""

    alpha: float
    beta: float
    strength: float
    growth: float


@compiled
def run_filter(
    fresh: Bools,
    still: Bools,
    pause: Floats,
    duration: Floats,
    start: Floats,
    end: Floats,
    alpha: float,
    beta: float,
    strength: float,
    growth: float,
    increments: Floats,
    counted: Bools,
    white: Floats,
    gains: Floats,
    density: Floats,
) -> float:
    """Fill white residuals of C rows of increments [rad], both (C, I), and return the first row's log likelihood.

    The filter is linear: the other rows (derivatives, responses to other torques) pass the same gains as the first.
    Named tuples are made in here: to take them from Python costs a tenth of the time of a short recording.

    fresh: a run begins, `pause` [s] after the last one ended. still: the motor stood; its increment is by how far the
    simulated one left the slot. duration [s], start, end [rad²]: of each interval, and the angle's variance at either
    end.
    alpha, beta [1/s]: kv/ka and 1/τ. strength [rad²/s⁴] (σ/ka)². growth [rad²/s]. counted: whose likelihood is wanted.
    gains: (I, GAINS), filled for `fill_white`; (0, GAINS) where that is not wanted.
    density: (I,) filled with what each interval adds to it.
    """
    stretches = _Stretches(fresh, still, pause, duration, start, end)
    return _filter(stretches, _Process(alpha, beta, strength, growth), increments, counted, white, gains, density)


@compiled
def _filter(
    stretches: _Stretches,
    process: _Process,
    increments: Floats,
    counted: Bools,
    white: Floats,
    gains: Floats,
    density: Floats,
) -> float:
    """Filter as `run_filter`."""
    alpha, beta, strength, growth = process
    rows, disturbed, noise = len(increments), strength > 0.0, 2.0 * beta * strength
    x = Means(np.zeros(rows), np.zeros(rows), np.zeros(rows), np.zeros(rows))
    p = stationary_covariance(alpha, beta, strength)
    speed_variance = p.dd
    series, fastest = np.zeros((TERMS, RESPONSES)), max(alpha, beta)
    fill_series(alpha, beta, series)
    of_interval, of_pause = -1.0, -1.0  # [s] what the responses are known for
    q, over_pause = np.zeros(RESPONSES), np.zeros(RESPONSES)
    value = 0.0
    for k in range(len(stretches.fresh)):
        h = stretches.duration[k]
        if stretches.still[k]:
            variance = stretches.end[k] + speed_variance * h * h
            _whiten_still(k, sqrt(variance), increments, white, gains)
            density[k] = compute_log_density(increments[0, k], variance) if counted[k] else 0.0
            value += density[k]
            continue
        fd = ft = by = 0.0
        if stretches.fresh[k]:
            p, fd, ft, by, of_pause = _begin_run(
                x, p, process, stretches.start[k], stretches.pause[k], series, of_pause, over_pause
            )
        if disturbed:
            of_interval = respond(series, fastest, h, of_interval, q)
            move(x, q)
            p = propagate(p, q, noise)
        p = Covariance(p.bb + growth * h, p.bd, p.bt, p.dd, p.dt, p.tt)
        variance = p.bb + stretches.end[k]
        root = 1.0 / sqrt(variance)
        off = x.level[0] + increments[0, k] - x.b[0]
        density[k] = compute_log_density(off, variance) if counted[k] else 0.0
        value += density[k]
        trust = compute_trust(off, variance)
        p, kb, kd, kt = update(p, off, variance, trust, stretches.end[k], (off / h) ** 2 if disturbed else 0.0)
        correct(x, k, increments, root, kb, kd, kt, white)
        if len(gains):
            left = q[LEFT_D], q[LEFT_T], q[BY_T], q[ANGLE_D], q[ANGLE_T]
            gains[k] = (root * sqrt(trust), kb, kd, kt, *left, fd, ft, by)
    return value


@compiled
def _begin_run(
    x: Means,
    p: Covariance,
    process: _Process,
    start: float,
    pause: float,
    series: Floats,
    known: float,
    response: Floats,
) -> tuple[Covariance, float, float, float, float]:
    """Begin a run after a pause [s], at an angle known to a variance `start` [rad²]: estimates in place, covariance.

    Then what is left of a speed and of a torque, the speed that a torque has made, and what `response` is known for.
    """
    alpha, beta, strength, _growth = process
    disturbed = strength > 0.0
    fd = ft = by = 0.0
    if disturbed and not min(alpha, beta) * pause < LONG:
        p = stationary_covariance(alpha, beta, strength)
        x.d[:] = 0.0
        x.t[:] = 0.0
    elif disturbed and pause == 0.0:
        fd, ft = 1.0, 1.0
    elif disturbed and pause > 0.0:
        known = respond(series, max(alpha, beta), pause, known, response)
        fd, ft, by = response[LEFT_D], response[LEFT_T], response[BY_T]
        move(x, response)
        p = pass_pause(p, response, 2.0 * beta * strength)
    x.b[:] = 0.0
    x.level[:] = 0.0
    return Covariance(start, 0.0, 0.0, p.dd, p.dt, p.tt), fd, ft, by, known


@compiled
def respond(series: Floats, fastest: float, duration: float, known: float, response: Floats) -> float:
    """Fill the response (RESPONSES,) over a duration [s] unless it is known for as long; return what it is for."""
    if abs(duration - known) > SAME_TIME * duration:
        fill_response(series, fastest, duration, response)
        return duration
    return known


@compiled
def _whiten_still(k: int, deviation: float, increments: Floats, white: Floats, gains: Floats) -> None:
    """Fill white residuals and gain of an interval in which the motor stood; deviation [rad]."""
    for c in range(len(increments)):
        white[c, k] = increments[c, k] / deviation
    if len(gains):
        gains[k, 0] = 1.0 / deviation


@compiled
def whiten_next(
    gains: Floats, k: int, fresh: bool, increment: float, level: float, b: float, d: float, t: float
) -> tuple[float, float, float, float, float]:
    """Whiten the next increment [rad] of a sequence with gains (GAINS,) that `run_filter` filled for another one.

    level: [rad] what has passed since the run began; b [rad], d [rad/s], t [rad/s²]: what is expected of it. All of
    them come back as they are then, after the white residual.
    """
    root, kb, kd, kt, phi_d, phi_t, by_t, angle_d, angle_t, fd, ft, by = gains[k]
    if fresh:
        level = b = 0.0
        d, t = fd * d + by * t, ft * t
    b += angle_d * d + angle_t * t
    d, t = phi_d * d + by_t * t, phi_t * t
    level += increment
    off = level - b
    return off * root, level, b + kb * off, d + kd * off, t + kt * off


@compiled
def fill_white(fresh: Bools, still: Bools, gains: Floats, increments: Floats, white: Floats) -> None:
    """Fill white residuals (I,) of increments (I,), with the gains that `run_filter` filled for other increments."""
    level = b = d = t = 0.0
    for k in range(len(fresh)):
        if still[k]:
            white[k] = increments[k] * gains[k, 0]
        else:
            white[k], level, b, d, t = whiten_next(gains, k, fresh[k], increments[k], level, b, d, t)
