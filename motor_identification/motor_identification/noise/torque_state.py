"""Step what is known of a disturbed motor on: estimates of angle, speed and torque, and their covariance.

The state and the equations are those of `error_filter.py`: errors b of the angle and d of the speed, and t = T/ka.
"""

from typing import NamedTuple

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
    TT,
)
from motor_identification.recording import Floats
from motor_model.compiled import compiled


class Means(NamedTuple):
    """Estimates for each of C rows of increments, arrays of shape (C,)."""

    level: Floats  # [rad] sum of the increments of the run
    b: Floats  # [rad]
    d: Floats  # [rad/s]
    t: Floats  # [rad/s²] T/ka


class Covariance(NamedTuple):
    """The covariance of angle b, speed d and torque t = T/ka, the same for every row."""

    bb: float
    bd: float
    bt: float
    dd: float
    dt: float
    tt: float


@compiled
def stationary_covariance(alpha: float, beta: float, strength: float) -> Covariance:
    """Compute the covariance of a motor of which nothing is known: the stationary state's."""
    return Covariance(0.0, 0.0, 0.0, strength / (alpha * (alpha + beta)), strength / (alpha + beta), strength)


@compiled
def move(x: Means, response: Floats) -> None:
    """Move estimates on in time, in place."""
    phi_d, phi_t, by_t = response[LEFT_D], response[LEFT_T], response[BY_T]
    angle_d, angle_t = response[ANGLE_D], response[ANGLE_T]
    for c in range(len(x.b)):
        x.b[c] += angle_d * x.d[c] + angle_t * x.t[c]
        x.d[c], x.t[c] = phi_d * x.d[c] + by_t * x.t[c], phi_t * x.t[c]


@compiled
def propagate(p: Covariance, response: Floats, noise: float) -> Covariance:
    """Propagate the covariance: F P Fᵀ + Q with F = [[1, angle_d, angle_t], [0, phi_d, by_t], [0, 0, phi_t]]."""
    phi_d, phi_t, by_t = response[LEFT_D], response[LEFT_T], response[BY_T]
    angle_d, angle_t = response[ANGLE_D], response[ANGLE_T]
    b_d, b_t = p.bd + angle_d * p.dd + angle_t * p.dt, p.bt + angle_d * p.dt + angle_t * p.tt
    d_d, d_t = phi_d * p.dd + by_t * p.dt, phi_d * p.dt + by_t * p.tt
    return Covariance(
        p.bb + angle_d * (p.bd + b_d) + angle_t * (p.bt + b_t) + noise * response[BB],
        phi_d * b_d + by_t * b_t + noise * response[BD],
        phi_t * b_t + noise * response[BT],
        phi_d * d_d + by_t * d_t + noise * response[DD],
        phi_t * d_t + noise * response[DT],
        phi_t * phi_t * p.tt + noise * response[TT],
    )


@compiled
def pass_pause(p: Covariance, response: Floats, noise: float) -> Covariance:
    """Propagate the covariance of speed and torque over a pause, after which nothing is known of the angle."""
    fd, ft, by = response[LEFT_D], response[LEFT_T], response[BY_T]
    return Covariance(
        p.bb,
        p.bd,
        p.bt,
        fd * fd * p.dd + 2.0 * fd * by * p.dt + by * by * p.tt + noise * response[DD],
        ft * (fd * p.dt + by * p.tt) + noise * response[DT],
        ft * ft * p.tt + noise * response[TT],
    )


@compiled
def _take_out(p: Covariance, taken: float, kb: float, kd: float, kt: float) -> Covariance:
    """Take out of a covariance what gains of angle, speed and torque have learned of an innovation, `taken` of it."""
    return Covariance(
        p.bb - taken * kb * kb,
        p.bd - taken * kb * kd,
        p.bt - taken * kb * kt,
        p.dd - taken * kd * kd,
        p.dt - taken * kd * kt,
        p.tt - taken * kt * kt,
    )


@compiled
def update(
    p: Covariance, off: float, variance: float, trust: float, end: float, jump: float
) -> tuple[Covariance, float, float, float]:
    """Take in an innovation `off` [rad]: the covariance after it, and the gains of angle, speed and torque.

    variance: [rad²] of the innovation. trust: probability that it is regular. end: [rad²] of the sensor alone.
    jump: [rad²/s²] by which the speed may be off, where the angle has jumped.
    """
    if trust == 1.0:
        kb, kd, kt = p.bb / variance, p.bd / variance, p.bt / variance
        return _take_out(p, variance, kb, kd, kt), kb, kd, kt
    if trust < 0.5:  # an uncounted edge, an unseen reversal: the angle is known from here on only
        # And the speed too, as far as it may be off by what was seen: a stop that only one of the two made.
        return Covariance(end, 0.0, 0.0, p.dd + jump, p.dt, p.tt), 1.0, 0.0, 0.0
    # Moments of the mixture of a regular interval and one that says nothing.
    kb, kd, kt = trust * (p.bb / variance), trust * (p.bd / variance), trust * (p.bt / variance)
    taken = variance / trust - (1.0 - trust) * off * off / trust
    return _take_out(p, taken, kb, kd, kt), kb, kd, kt


@compiled
def correct(x: Means, k: int, increments: Floats, root: float, kb: float, kd: float, kt: float, white: Floats) -> None:
    """Correct estimates by the increments of an interval, in place, and fill its white residuals."""
    for c in range(len(x.b)):
        x.level[c] += increments[c, k]
        each = x.level[c] - x.b[c]
        white[c, k] = each * root
        x.b[c] += kb * each
        x.d[c] += kd * each
        x.t[c] += kt * each
