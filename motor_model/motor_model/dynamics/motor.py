"""The motor: one compiled step, the only home of its equation.

In armature voltages throughout (symbols and parameters: `effects.py`; gain = 1/kv, time constant = ka/kv):

    ka·w dω/dt = v − w·friction(ω) − w·loads(θ, t),   dθ/dt = ω
    drive      = (u_eff − ke·ω·(1 − share·(1 − |u_eff|/u_max))) / (1 + sag·(u_eff/u_max)²)
    τ dv/dt    = drive − v                            (v = drive where the armature has no inductance)
    friction   = sign ω·(ks + max(breakaway − ks, 0)·exp(−(ω/ω_s)²)) + (kv − ke)·ω + drag·ω·|ω|
    loads      = bias + step(t) + ripple·sin(cycles·gear·θ + phase)
    w          = 1 + rise·(1 − e^(−t/t_w))            (warm copper)

ke is kv less its viscous part: back-EMF alone. Without a measured current the two are one (ke = kv). v is w·R·current.

At rest the motor holds while |v − w·loads| ≤ w·max(ks, breakaway). After a reversal the inertia is ka·(1 − load
fraction) until the play is taken up; the speed has no jump there. u_eff is the command after delay, limit, dead zone
and asymmetry (`bridge.py`).

Between events (a zero of the speed, the end of the play, the load step) the equation is linear but for Stribeck
friction, drag, ripple and warm-up. A piece is solved in closed form (`linear.py`): exact for everything linear; lines
stand for the others (`pieces.py`). Pieces are as long as that allows, and `coarseness` times as long where a search
wants to be quick.
"""

from math import copysign, exp, inf, log1p

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.bridge import effective_voltage
from motor_model.dynamics.events import until_event
from motor_model.dynamics.forces import (
    drive_of,
    friction_at,
    friction_slope_at,
    is_bent,
    load_slope_at,
    loads_at,
    warmth,
)
from motor_model.dynamics.linear import Coefficients
from motor_model.dynamics.pieces import lines, longest_piece
from motor_model.dynamics.state import State
from motor_model.effects import INDEX

Floats = NDArray[np.float64]

KA, KS, BREAKAWAY = INDEX["ka"], INDEX["ks"], INDEX["breakaway_voltage"]
LAG = INDEX["electrical_time_constant"]
STEP, STEP_TIME = INDEX["step_voltage"], INDEX["step_time"]
PLAY, LOAD_FRACTION, U_MAX = INDEX["backlash_angle"], INDEX["load_fraction"], INDEX["max_voltage"]

# Of the supply's voltage: what holds a motor without friction at rest. Else an inductance lets it swing on for ever, by
# less than a rounding error, in pieces as short as that.
LEAST_LEVEL = 1e-12
MAX_PIECES = 100_000  # between two outputs; a guard against endless chatter, never reached in a physical case


@compiled
def holding_level(p: Floats, w: float) -> float:
    """Return the net voltage [V] up to which a motor at rest holds, in copper of warmth w."""
    return max(w * max(p[KS], p[BREAKAWAY]), LEAST_LEVEL * p[U_MAX])


@compiled
def _hold(p: Floats, s: State, source: float, load: float, level: float, h: float) -> tuple[float, float, float]:
    """A motor at rest: how long it holds (up to h), v at the end of that, and the direction it starts in (0: holds)."""
    tau = p[LAG]
    if tau == 0.0:
        net = source - load
        return (h, source, 0.0) if abs(net) <= level else (0.0, source, copysign(1.0, net))
    net = s.drive - load
    if abs(net) > level * (1.0 + 1e-12):
        return 0.0, s.drive, copysign(1.0, net)
    final = source - load
    if abs(final) > level:
        limit = copysign(level, final)
        released = tau * log1p((limit - net) / (final - limit))
        if released < h:
            return released, limit + load + copysign(1e-12 + 2e-12 * level, final), copysign(1.0, final)
    return h, source + (s.drive - source) * exp(-h / tau), 0.0


@compiled
def piece(p: Floats, u: float, s: State, t: float, h: float) -> tuple[State, float]:
    """Return the motion until the next event, at most h [s] long, in which the shaft does not reverse.

    p: parameter vector, u: effective voltage [V], s: state, t: time [s]. Returns the state and the time it took.
    """
    if p[STEP] != 0.0 and t < p[STEP_TIME] < t + h:
        h = p[STEP_TIME] - t
    w = warmth(p, t)
    source, back_emf = drive_of(p, u)
    direction, drive, play = s.direction, s.drive, s.play
    if p[LAG] == 0.0:
        drive = source - back_emf * s.speed
    if s.speed == 0.0:
        load = w * loads_at(p, s.angle + s.turned, t)
        held, drive, started = _hold(p, s, source, load, holding_level(p, w), h)
        if held > 0.0:
            return State(s.angle, 0.0, drive, play, direction, s.turned), held
        if started * direction < 0.0:
            play = p[PLAY] - play
        direction = started
    else:
        direction = copysign(1.0, s.speed)
    s = State(s.angle, s.speed, drive, play, direction, s.turned)

    inertia = p[KA] * w * (1.0 - (p[LOAD_FRACTION] if play > 0.0 else 0.0))
    torque = w * (friction_at(p, s.speed, direction) + loads_at(p, s.angle + s.turned, t))
    slope = w * friction_slope_at(p, s.speed)
    c = Coefficients(inertia, torque, slope, source, back_emf, w * load_slope_at(p, s.angle + s.turned) * s.speed)
    acceleration = (s.drive - torque) / inertia
    settled = (source - back_emf * s.speed - torque) / inertia  # the acceleration once the current has followed
    h = min(h, longest_piece(p, s, max(abs(acceleration), abs(settled)), inertia, h))
    if is_bent(p):
        c, h = lines(p, c, s, t, h)
    return until_event(p, c, s, h)


@compiled
def advance(p: Floats, command: float, s: State, t: float, dt: float) -> State:
    """THE step: the state after dt [s] of a command [V] that has passed the delay.

    p: parameter vector (see `Parameters.vector`), s: state, t: time [s] since the recording's start.
    """
    u = effective_voltage(p, command)
    end = t + dt
    for _ in range(MAX_PIECES):
        left = end - t
        if left <= 0.0:
            break
        s, taken = piece(p, u, s, t, left)
        t = end if taken >= left else t + taken
    return s


@compiled
def time_in_piece(p: Floats, u: float, s: State, t: float, h: float, angle: float) -> float:
    """[s] after t at which the shaft passes an angle [rad] that it is known to reach within a piece of h.

    Newton's method on the same solution that `piece` returns, kept inside by bisection; exact to 1e-13 s.
    """
    low, high, guess = 0.0, h, 0.5 * h
    for _ in range(80):
        then, taken = piece(p, u, s, t, guess)
        error = then.angle - angle
        if error * then.direction > 0.0:
            high = guess
        else:
            low = guess
        step = error / then.speed if then.speed != 0.0 else inf
        if abs(step) < 1e-13 or high - low < 1e-13:
            break
        guess -= step
        if not low < guess < high:
            guess = 0.5 * (low + high)
    return guess
