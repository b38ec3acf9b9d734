"""Filter the error of a simulated angle that a random torque disturbs: a Kalman filter of angle, speed and torque.

A motor with a torque T [V] more against it than its model falls behind the simulation. With b the simulated minus the
true angle and d the same of the speed,

    db/dt = d,   dd/dt = −α d + T/ka,   dT/dt = −T/τ + √(2σ²/τ)·w,   α = kv/ka

T is an Ornstein–Uhlenbeck process with strength σ and correlation time τ, filtered by the motor as any torque is. What
is observed is the angle at the ends of intervals, e = b + n, n ~ R (timer tick, irregular slots, counts); along a run
of intervals e is known up to a constant. The innovations of the filter give the likelihood (Schweppe 1965), and divided
by their standard deviations they are white. With σ = 0 and a growth q [rad²/s] of b this is the filter of
`angle_noise.py`.

An interval may hold an error that no noise makes (a wrong stamp, an unseen reversal), so that its density is
contaminated: with a probability of ε the innovation comes from a Cauchy density. It is a density, so that likelihood
ratios mean what they say; a clipped square is none.
"""

from math import exp, log, pi, sqrt

import numpy as np

from motor_identification.noise.torque_response import (
    ANGLE_D,
    ANGLE_T,
    BB,
    BD,
    BT,
    BY_T,
    DD,
    DT,
    LEFT_D,
    LEFT_T,
    RESPONSES,
    TERMS,
    TT,
    fill_response,
    fill_series,
)
from motor_identification.recording import Bools, Floats
from motor_model.compiled import compiled

OUTLIERS = 1e-4  # ε: share of intervals whose error is none of the noise
WIDTH = 10.0  # scale of their density, in standard deviations of the others
GAINS = 12  # numbers of an interval that the filter of other increments needs
SAME_TIME = 1e-10  # of an interval: what an even sample period is rounded by, far below what any stamp can tell
_LONG = 40.0  # time constants after which nothing is remembered


@compiled
def run_filter(  # noqa: C901, PLR0915
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

    fresh: a run begins, `pause` [s] after the last one ended. still: the motor stood; its increment is by how far the
    simulated one left the slot. duration [s], start, end [rad²]: of each interval, and the angle's variance at either
    end.
    density: (I,) filled with what each interval adds to it.
    gains: (I, GAINS), filled for `fill_white`; (0, GAINS) where that is not wanted.
    alpha, beta [1/s]: kv/ka and 1/τ. strength [rad²/s⁴] (σ/ka)². growth [rad²/s]. counted: whose likelihood is wanted.
    """
    rows = len(increments)
    # State (b, d, T/ka) of every row and its covariance; a motor of which nothing is known is in the stationary state.
    b, d, t, level = np.zeros(rows), np.zeros(rows), np.zeros(rows), np.zeros(rows)
    bb = bd = bt = 0.0
    dd, dt, tt = strength / (alpha * (alpha + beta)), strength / (alpha + beta), strength
    speed_variance = dd
    of_interval, of_pause = -1.0, -1.0
    q, p, series, fastest = np.zeros(RESPONSES), np.zeros(RESPONSES), np.zeros((TERMS, RESPONSES)), max(alpha, beta)
    fill_series(alpha, beta, series)
    phi_d = phi_t = by_t = angle_d = angle_t = 0.0
    noise = 2.0 * beta * strength
    value = 0.0
    for k in range(len(fresh)):
        h = duration[k]
        if still[k]:
            variance = end[k] + speed_variance * h * h
            for c in range(rows):
                white[c, k] = increments[c, k] / sqrt(variance)
            if len(gains):
                gains[k, 0] = 1.0 / sqrt(variance)
            density[k] = _density(increments[0, k], variance) if counted[k] else 0.0
            value += density[k]
            continue
        fd = ft = by = 0.0
        if fresh[k]:
            if strength > 0.0:
                if not min(alpha, beta) * pause[k] < _LONG:
                    d[:] = 0.0
                    t[:] = 0.0
                    dd, dt, tt = speed_variance, strength / (alpha + beta), strength
                elif pause[k] == 0.0:
                    fd, ft = 1.0, 1.0
                elif pause[k] > 0.0:
                    if abs(pause[k] - of_pause) > SAME_TIME * pause[k]:
                        of_pause = pause[k]
                        fill_response(series, fastest, of_pause, p)
                    fd, ft, by = p[LEFT_D], p[LEFT_T], p[BY_T]
                    for c in range(rows):
                        d[c], t[c] = fd * d[c] + by * t[c], ft * t[c]
                    dd, dt, tt = (
                        fd * fd * dd + 2.0 * fd * by * dt + by * by * tt + noise * p[DD],
                        ft * (fd * dt + by * tt) + noise * p[DT],
                        ft * ft * tt + noise * p[TT],
                    )
            b[:] = 0.0
            level[:] = 0.0
            bb, bd, bt = start[k], 0.0, 0.0
        if strength > 0.0:
            if abs(h - of_interval) > SAME_TIME * h:
                of_interval = h
                fill_response(series, fastest, h, q)
                phi_d, phi_t, by_t, angle_d, angle_t = q[LEFT_D], q[LEFT_T], q[BY_T], q[ANGLE_D], q[ANGLE_T]
            for c in range(rows):
                b[c] += angle_d * d[c] + angle_t * t[c]
                d[c], t[c] = phi_d * d[c] + by_t * t[c], phi_t * t[c]
            # F P Fᵀ + Q with F = [[1, angle_d, angle_t], [0, phi_d, by_t], [0, 0, phi_t]].
            b_d, b_t = bd + angle_d * dd + angle_t * dt, bt + angle_d * dt + angle_t * tt
            d_d, d_t = phi_d * dd + by_t * dt, phi_d * dt + by_t * tt
            bb = bb + angle_d * (bd + b_d) + angle_t * (bt + b_t) + noise * q[BB]
            bd, bt = phi_d * b_d + by_t * b_t + noise * q[BD], phi_t * b_t + noise * q[BT]
            dd, dt, tt = (
                phi_d * d_d + by_t * d_t + noise * q[DD],
                phi_t * d_t + noise * q[DT],
                phi_t * phi_t * tt + noise * q[TT],
            )
        bb += growth * h
        variance = bb + end[k]
        root = 1.0 / sqrt(variance)
        kb, kd, kt = bb / variance, bd / variance, bt / variance
        off = level[0] + increments[0, k] - b[0]
        density[k] = _density(off, variance) if counted[k] else 0.0
        value += density[k]
        trust = _trust(off, variance)
        lost = trust < 0.5  # the angle has jumped (an uncounted edge, an unseen reversal): known from here on only
        if lost:
            kb, kd, kt = 1.0, 0.0, 0.0
        else:  # moments of the mixture of a regular interval and one that says nothing
            kb, kd, kt = trust * kb, trust * kd, trust * kt
        for c in range(rows):
            level[c] += increments[c, k]
            each = level[c] - b[c]
            white[c, k] = each * root
            b[c] += kb * each
            d[c] += kd * each
            t[c] += kt * each
        if len(gains):
            gains[k] = (root * sqrt(trust), kb, kd, kt, phi_d, phi_t, by_t, angle_d, angle_t, fd, ft, by)
        if lost:  # and the speed too, as far as it may be off by what was seen: a stop that only one of the two made
            bb, bd, bt = end[k], 0.0, 0.0
            if strength > 0.0:
                dd += (off / h) ** 2
        else:
            taken = variance / trust - (1.0 - trust) * off * off / trust
            bb, bd, bt = bb - taken * kb * kb, bd - taken * kb * kd, bt - taken * kb * kt
            dd, dt, tt = dd - taken * kd * kd, dt - taken * kd * kt, tt - taken * kt * kt
    return value


@compiled
def fill_white(fresh: Bools, still: Bools, gains: Floats, increments: Floats, white: Floats) -> None:
    """Fill white residuals (I,) of increments (I,), with the gains that `run_filter` filled for other increments."""
    level = b = d = t = 0.0
    for k in range(len(fresh)):
        root, kb, kd, kt, phi_d, phi_t, by_t, angle_d, angle_t, fd, ft, by = gains[k]
        if still[k]:
            white[k] = increments[k] * root
            continue
        if fresh[k]:
            level = b = 0.0
            d, t = fd * d + by * t, ft * t
        b += angle_d * d + angle_t * t
        d, t = phi_d * d + by_t * t, phi_t * t
        level += increments[k]
        off = level - b
        white[k] = off * root
        b, d, t = b + kb * off, d + kd * off, t + kt * off


@compiled
def _density(off: float, variance: float) -> float:
    """Logarithm of the contaminated density of an innovation [rad] of a variance [rad²]."""
    square = off * off / variance
    regular = -0.5 * (square + log(2.0 * pi * variance))
    if square < 9.0:  # there the other part is below 1e-4 of it
        return regular + log(1.0 - OUTLIERS)
    wide = log(OUTLIERS / (pi * WIDTH)) - 0.5 * log(variance) - log(1.0 + square / (WIDTH * WIDTH))
    regular += log(1.0 - OUTLIERS)
    top = max(regular, wide)
    return top + log(exp(regular - top) + exp(wide - top))


@compiled
def _trust(off: float, variance: float) -> float:
    """Probability that an innovation is regular."""
    square = off * off / variance
    if square < 9.0:
        return 1.0
    regular = (1.0 - OUTLIERS) * exp(-0.5 * square) / sqrt(2.0 * pi)
    wide = OUTLIERS / (pi * WIDTH * (1.0 + square / (WIDTH * WIDTH)))
    return regular / (regular + wide)
