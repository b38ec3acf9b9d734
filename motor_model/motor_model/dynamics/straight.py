"""The motion of a straight motor while one command holds: its equation is linear, and is prepared once for the hold.

Straight is what turns one way with its play taken up, at one load, and has no friction or load that bends. Where it
comes to rest, turns back or takes up play it is not, and `motor.py` says what happens: nothing here is another physics.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.bridge import effective_voltage
from motor_model.dynamics.forces import drive_of, friction_at, friction_slope_at, is_bent, loads_at
from motor_model.dynamics.linear import Coefficients, Halves, halves_of, second_order_by
from motor_model.dynamics.pieces import longest_piece
from motor_model.dynamics.state import State, at_rest
from motor_model.effects import INDEX

Floats = NDArray[np.float64]

KA, LAG = INDEX["ka"], INDEX["electrical_time_constant"]
SAME_TIME = 1e-10  # of a step: what an even sample period is rounded by, far below what any stamp can tell


class Torques(NamedTuple):
    """What friction and loads take [V], turning either way."""

    ahead: float
    back: float
    slope: float  # [V·s/rad] of friction over the speed


class Hold(NamedTuple):
    """The equation while one command holds; without inductance dω/dt = push − rate·ω."""

    torques: Torques
    source: float  # [V] of the drive, and its back-EMF [V·s/rad]
    back_emf: float
    ahead_push: float  # [rad/s²]
    back_push: float
    rate: float  # [1/s]


class Lagging(NamedTuple):
    """Of a motor with inductance: how long [s] a step may be, and φ of the latest one, of this h [s] and back-EMF."""

    longest: float
    h: float
    back_emf: float
    phi: Halves


@compiled
def is_straight(p: Floats) -> bool:
    """Tell if the equation is linear while the shaft turns one way at one voltage, its play taken up, at one load."""
    return not is_bent(p)


@compiled
def find_torques(p: Floats, t: float) -> Torques:
    """Find what friction and loads take from a time t [s] on, until the load step."""
    loads = loads_at(p, 0.0, t)
    return Torques(friction_at(p, 0.0, 1.0) + loads, friction_at(p, 0.0, -1.0) + loads, friction_slope_at(p, 0.0))


@compiled
def prepare_hold(p: Floats, u: float, torques: Torques) -> Hold:
    """Prepare the equation of a whole hold at a command u [V] once."""
    source, back_emf = drive_of(p, effective_voltage(p, u))
    inertia = p[KA]
    ahead, back = (source - torques.ahead) / inertia, (source - torques.back) / inertia
    return Hold(torques, source, back_emf, ahead, back, (back_emf + torques.slope) / inertia)


@compiled
def prepare_lag(p: Floats) -> Lagging:
    """Prepare the steps of a motor with inductance; of one without, or one that is not straight, none is allowed."""
    longest = longest_piece(p, at_rest(0.0), 0.0, p[KA]) if p[LAG] > 0.0 and is_straight(p) else 0.0
    return Lagging(longest, -1.0, 0.0, Halves(0.0, 0.0, 0.0, 0.0, 0.0, 0.0))


@compiled
def turn_lagging(p: Floats, hold: Hold, s: State, h: float, latest: Lagging) -> tuple[float, float, float, Lagging]:
    """Speed, v and travel after h [s] of a turning motor with inductance; a speed of 0 where it might not keep turning.

    φ is the same in all steps of a length, and is kept for the next.
    """
    torque = (hold.torques.ahead if s.speed > 0.0 else hold.torques.back) + hold.torques.slope * s.speed
    c = Coefficients(p[KA], torque, hold.torques.slope, hold.source, hold.back_emf, 0.0)
    if not keeps_turning(c, p[LAG], s.speed, s.drive, h):
        return 0.0, 0.0, 0.0, latest
    if abs(h - latest.h) > SAME_TIME * h or hold.back_emf != latest.back_emf:
        latest = Lagging(latest.longest, h, hold.back_emf, halves_of(c, p[LAG], h))
    then, drive, travel = second_order_by(latest.phi, c, p[LAG], s.speed, s.drive, h)
    return then, drive, travel, latest


@compiled
def keeps_turning(c: Coefficients, tau: float, speed: float, drive: float, h: float) -> bool:
    """Tell whether a motor with inductance surely keeps its direction for h [s].

    Of acceleration x and y = dv/dt, x² + y²·τ/(inertia·back_emf) never grows: no speed changes by more than h·√ of it.
    """
    if not (c.slope >= 0.0 and c.back_emf > 0.0):
        return False
    x, y = (drive - c.torque) / c.inertia, (c.source - c.back_emf * speed - drive) / tau
    return bool((x * x + y * y * tau / (c.inertia * c.back_emf)) * h * h < speed * speed)
