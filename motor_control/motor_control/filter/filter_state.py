"""What the filter believes of the motor, and how certain it is: plain numbers that compiled code takes and returns."""

from typing import NamedTuple

from motor_model.compiled import compiled
from motor_model.dynamics.state import State


class Noise(NamedTuple):
    """What the filter takes for granted about the encoder and about what no model knows."""

    slot: float  # [rad] between two flanks that are seen turning one way
    flank: float  # [rad] standard deviation of where a flank is
    turn: float  # [rad] the same for the first flank that is seen after a reversal: how wide the hole is nobody says
    tick: float  # [s] of the timer that stamps edges
    walk: float  # [V²/s] the load's random walk
    shake: float  # [V²·s] white torque noise
    missing: bool  # the encoder misses edges
    single: bool  # the encoder has one channel and counts up whichever way it turns


class Spread(NamedTuple):
    """Covariance of angle [rad], speed [rad/s] and load [V]."""

    aa: float
    as_: float
    al: float
    ss: float
    sl: float
    ll: float


class Trail(NamedTuple):
    """What has been seen so far, beyond the three numbers of the state."""

    side: float  # direction in which the latest edge was passed; 0: none seen yet, or not known
    since: float  # [s] since the latest edge, or since it last stood
    overdue: float  # [s] for which the next edge has been overdue
    still: bool  # it stands though the model would have it move; until the next edge
    drift: float  # innovations in standard deviations, summed up with a short memory
    memory: float  # [s] over which that is
    missed: float  # edges that were taken for missed, less what is forgiven since
    doubt: float  # [s] for which the other direction would have needed the smaller load
    innovation: float  # [rad] angle at the latest edge less its prediction
    load: float  # [V] as it was believed to be at the latest edge
    level: float  # mean square of the last innovations, in their standard deviations; 1 where the model is right


class Belief(NamedTuple):
    """The filter's state; the motor's angle counts from the flank of the latest edge, so it stays small."""

    motor: State
    load: float  # [V] beyond the model's own
    spread: Spread
    trail: Trail
    elapsed: float  # [s] since it began


@compiled
def moved(s: State, angle: float, speed: float, direction: float) -> State:
    """The same motor, elsewhere."""
    return State(angle, speed, s.drive, s.play, direction, 0.0)


@compiled
def widened(c: Spread, a: float, s: float, load: float) -> Spread:
    """The covariance once the state may also be off by any multiple of (angle, speed, load)."""
    return Spread(c.aa + a * a, c.as_ + a * s, c.al + a * load, c.ss + s * s, c.sl + s * load, c.ll + load * load)


@compiled
def corrected(b: Belief, shift: float, variance: float, shrink: float) -> Belief:
    """The belief after its angle was found to be off by `shift` [rad], which had this variance [rad²].

    The gains are the covariances over the variance; `shrink` is the share of the explained variance that goes (1 for a
    measurement).
    """
    c = b.spread
    ga, gs, gl = c.aa / variance, c.as_ / variance, c.al / variance
    spread = Spread(
        max(c.aa - shrink * ga * c.aa, 1e-14),
        c.as_ - shrink * ga * c.as_,
        c.al - shrink * ga * c.al,
        max(c.ss - shrink * gs * c.as_, 1e-12),
        c.sl - shrink * gs * c.al,
        max(c.ll - shrink * gl * c.al, 1e-12),
    )
    s = b.motor
    motor = moved(s, s.angle + ga * shift, s.speed + gs * shift, s.direction)
    return Belief(motor, b.load + gl * shift, spread, b.trail, b.elapsed)


@compiled
def mirrored(b: Belief, load: float) -> Belief:
    """The same edges passed the other way, under a load [V]."""
    s, c, t = b.motor, b.spread, b.trail
    spread = Spread(c.aa, c.as_, -c.al, c.ss, -c.sl, c.ll)
    trail = Trail(-t.side, t.since, t.overdue, t.still, 0.0, 0.0, t.missed, 0.0, t.innovation, load, t.level)
    return Belief(moved(s, -s.angle, -s.speed, -s.direction), load, spread, trail, b.elapsed)
