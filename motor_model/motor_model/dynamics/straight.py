"""The motion of a straight motor while one command holds: its equation is linear, and is prepared once for the hold.

Straight is what turns one way with its play taken up, at one load, and has no friction or load that bends; Stribeck
friction does not where it is gone. A motor that warms up is straight for as long as its warmth is that of a step's
middle. Where it comes to rest, turns back or takes up play it is not, and `motor.py` says what happens: nothing here is
another physics.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.bridge import effective_voltage
from motor_model.dynamics.forces import (
    drive_of,
    friction_slope_at,
    sliding_friction,
    sliding_speed,
    steady_load_at,
)
from motor_model.dynamics.linear import Coefficients, Halves, halves_of, relaxed, second_order_by
from motor_model.dynamics.pieces import longest_slide
from motor_model.dynamics.state import State
from motor_model.effects import INDEX

Floats = NDArray[np.float64]

KA, LAG = INDEX["ka"], INDEX["electrical_time_constant"]
DRAG, COARSENESS = INDEX["drag"], INDEX["coarseness"]
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


class Straight(NamedTuple):
    """Where a motor is straight: faster than `least` [rad/s], in steps of at most `longest` [s]."""

    least: float
    longest: float


class Lagging(NamedTuple):
    """Of a motor with inductance: φ of the latest step, of this h [s], this inertia and back-EMF."""

    h: float
    inertia: float
    back_emf: float
    phi: Halves


@compiled
def find_straight(p: Floats) -> Straight:
    """Find where the equation is linear while the shaft turns one way at one voltage and load, its play taken up.

    But for a ripple, see `rippling.py`.
    """
    return Straight(inf if p[DRAG] != 0.0 else sliding_speed(p), longest_slide(p, p[KA]) * p[COARSENESS])


@compiled
def find_torques(p: Floats, t: float) -> Torques:
    """Find what friction and loads take from a time t [s] on, until the load step; without a ripple."""
    loads = steady_load_at(p, t)
    return Torques(sliding_friction(p, 1.0) + loads, sliding_friction(p, -1.0) + loads, friction_slope_at(p, 0.0))


@compiled
def prepare_hold(p: Floats, u: float, torques: Torques) -> Hold:
    """Prepare the equation of a whole hold at a command u [V] once."""
    source, back_emf = drive_of(p, effective_voltage(p, u))
    inertia = p[KA]
    ahead, back = (source - torques.ahead) / inertia, (source - torques.back) / inertia
    return Hold(torques, source, back_emf, ahead, back, (back_emf + torques.slope) / inertia)


@compiled
def turn(p: Floats, hold: Hold, speed: float, h: float, w: float) -> tuple[float, float]:
    """Speed and travel after h [s] of a motor without inductance that turns at a speed, in copper of warmth w."""
    if w == 1.0:
        push = hold.ahead_push if speed > 0.0 else hold.back_push
        return relaxed(hold.rate, push - hold.rate * speed, speed, h)
    inertia = p[KA] * w
    torque = hold.torques.ahead if speed > 0.0 else hold.torques.back
    rate = (hold.back_emf + w * hold.torques.slope) / inertia
    return relaxed(rate, (hold.source - w * torque) / inertia - rate * speed, speed, h)


@compiled
def begin_lag() -> Lagging:
    """Begin without the φ of any step."""
    return Lagging(-1.0, 0.0, 0.0, Halves(0.0, 0.0, 0.0, 0.0, 0.0, 0.0))


@compiled
def turn_lagging(
    p: Floats, hold: Hold, s: State, h: float, w: float, least: float, latest: Lagging
) -> tuple[float, float, float, Lagging]:
    """Speed, v and travel after h [s] of a turning motor with inductance, in copper of warmth w.

    A speed of 0 where it might not keep turning faster than `least` [rad/s]. φ is the same in all steps of a length,
    and is kept for the next.
    """
    torque = (hold.torques.ahead if s.speed > 0.0 else hold.torques.back) + hold.torques.slope * s.speed
    c = Coefficients(p[KA] * w, w * torque, w * hold.torques.slope, hold.source, hold.back_emf, 0.0)
    if not keeps_turning(c, p[LAG], s.speed, s.drive, h, least):
        return 0.0, 0.0, 0.0, latest
    if abs(h - latest.h) > SAME_TIME * h or hold.back_emf != latest.back_emf or c.inertia != latest.inertia:
        latest = Lagging(h, c.inertia, hold.back_emf, halves_of(c, p[LAG], h))
    then, drive, travel = second_order_by(latest.phi, c, p[LAG], s.speed, s.drive, h)
    return then, drive, travel, latest


@compiled
def keeps_turning(c: Coefficients, tau: float, speed: float, drive: float, h: float, least: float) -> bool:
    """Tell whether a motor with inductance surely keeps its direction for h [s], and turns faster than `least` [rad/s].

    Of acceleration x and y = dv/dt, x² + y²·τ/(inertia·back_emf) never grows: no speed changes by more than h·√ of it.
    """
    if not (c.slope >= 0.0 and c.back_emf > 0.0):
        return False
    x, y = (drive - c.torque) / c.inertia, (c.source - c.back_emf * speed - drive) / tau
    above = max(abs(speed) - least, 0.0)
    return bool((x * x + y * y * tau / (c.inertia * c.back_emf)) * h * h < above * above)
