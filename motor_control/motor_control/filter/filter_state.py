"""The filter's state: estimate and history as plain named tuples that compiled code takes and returns."""

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


class Covariance(NamedTuple):
    """Covariance of angle [rad], speed [rad/s] and load [V]."""

    aa: float
    as_: float
    al: float
    ss: float
    sl: float
    ll: float


class Estimate(NamedTuple):
    """Mean and covariance; the motor's angle counts from the flank of the latest edge, so it stays small."""

    motor: State
    load: float  # [V] beyond the model's own
    covariance: Covariance


class LatestEdge(NamedTuple):
    """The latest edge, and what was known at it."""

    side: float  # direction in which it was passed; 0: none seen yet, or not known
    since: float  # [s] since it, or since the motor last stood
    innovation: float  # [rad] its angle less the prediction
    load: float  # [V] as it was believed to be


class Silence(NamedTuple):
    """That no edge comes."""

    overdue: float  # [s] for which the next one has been overdue
    stands: bool  # it stands though the model would have it move; until the next edge


class Consistency(NamedTuple):
    """How well the latest edges agreed with their predictions."""

    drift: float  # innovations in standard deviations, summed up with a short memory
    memory: float  # [s] over which that is
    level: float  # mean square of the last innovations, in their standard deviations; 1 where the model is right


class History(NamedTuple):
    """What the edges so far have said beyond the estimate."""

    edge: LatestEdge
    silence: Silence
    consistency: Consistency
    missed: float  # edges that were taken for missed, less what is forgiven since
    doubt: float  # [s] for which the other direction would have needed the smaller load


class FilterState(NamedTuple):
    """Estimate, history, and the time since it began."""

    estimate: Estimate
    history: History
    elapsed: float  # [s]


@compiled
def place_motor(s: State, angle: float, speed: float, direction: float) -> State:
    """Put the same motor at another angle [rad], speed [rad/s] and direction."""
    return State(angle, speed, s.drive, s.play, direction, 0.0)


@compiled
def inflate_covariance(c: Covariance, angle: float, speed: float, load: float) -> Covariance:
    """Add the doubt that the state is off by a multiple (σ = 1) of this angle [rad], speed [rad/s] and load [V]."""
    return Covariance(
        c.aa + angle * angle,
        c.as_ + angle * speed,
        c.al + angle * load,
        c.ss + speed * speed,
        c.sl + speed * load,
        c.ll + load * load,
    )


@compiled
def correct_angle(x: Estimate, shift: float, variance: float, shrink: float) -> Estimate:
    """Correct the estimate by an angle innovation `shift` [rad] of this variance [rad²].

    The gains are the covariances over the variance; `shrink` is the share of the explained variance that goes (1 for a
    measurement).
    """
    c = x.covariance
    ga, gs, gl = c.aa / variance, c.as_ / variance, c.al / variance
    covariance = Covariance(
        max(c.aa - shrink * ga * c.aa, 1e-14),
        c.as_ - shrink * ga * c.as_,
        c.al - shrink * ga * c.al,
        max(c.ss - shrink * gs * c.as_, 1e-12),
        c.sl - shrink * gs * c.al,
        max(c.ll - shrink * gl * c.al, 1e-12),
    )
    s = x.motor
    motor = place_motor(s, s.angle + ga * shift, s.speed + gs * shift, s.direction)
    return Estimate(motor, x.load + gl * shift, covariance)


@compiled
def mirror_motion(x: FilterState, load: float) -> FilterState:
    """Take the same edges as passed the other way, under a load [V]."""
    s, c, h = x.estimate.motor, x.estimate.covariance, x.history
    covariance = Covariance(c.aa, c.as_, -c.al, c.ss, -c.sl, c.ll)
    motor = place_motor(s, -s.angle, -s.speed, -s.direction)
    edge = LatestEdge(-h.edge.side, h.edge.since, h.edge.innovation, load)
    history = History(edge, h.silence, Consistency(0.0, 0.0, h.consistency.level), h.missed, 0.0)
    return FilterState(Estimate(motor, load, covariance), history, x.elapsed)
