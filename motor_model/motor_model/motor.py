"""The motor: one compiled step, the only home of its equation.

In armature voltages throughout (symbols and parameters: `effects.py`; gain = 1/kv, time constant = ka/kv):

    ka·w dω/dt = v − w·friction(ω) − w·loads(θ, t),   dθ/dt = ω
    drive      = (u_eff − kv·ω·(1 − share·(1 − |u_eff|/u_max))) / (1 + sag·(u_eff/u_max)²)
    τ dv/dt    = drive − v                            (v = drive where the armature has no inductance)
    friction   = sign ω·(ks + max(breakaway − ks, 0)·exp(−(ω/ω_s)²)) + drag·ω·|ω|
    loads      = bias + step(t) + ripple·sin(cycles·θ + phase)
    w          = 1 + rise·(1 − e^(−t/t_w))            (warm copper)

At rest the motor holds while |v − w·loads| ≤ w·max(ks, breakaway). After a reversal the inertia is ka·(1 − load
fraction) until the play is taken up; the speed has no jump there. u_eff is the command after delay, limit, dead zone
and asymmetry (`bridge.py`).

Between events (a zero of the speed, the end of the play, the load step) the equation is linear but for Stribeck
friction, drag, ripple and warm-up. A piece is solved in closed form (`linear.py`): exact for everything linear. Of the
others, friction becomes its secant through the speeds at the two Gauss nodes of the piece, and loads the line through
theirs, so that what the lines leave out integrates to zero up to the fourth order in the piece's length; the nodes are
found by the exponential Rosenbrock-Euler method (Hochbruck & Ostermann, Acta Numerica 19, 2010). Pieces are as long as
that allows, and `coarseness` times as long where a search wants to be quick.
"""

from math import copysign, exp, inf, log1p, sqrt

import numpy as np
from numpy.typing import NDArray

from motor_model.bridge import effective_voltage
from motor_model.compiled import compiled
from motor_model.effects import INDEX
from motor_model.events import solve, until_event
from motor_model.forces import drive_of, friction_at, friction_slope_at, loads_at, warmth
from motor_model.linear import Coefficients
from motor_model.state import State

Floats = NDArray[np.float64]

KV, KA = INDEX["kv"], INDEX["ka"]
KS, BREAKAWAY, STRIBECK = INDEX["ks"], INDEX["breakaway_voltage"], INDEX["stribeck_speed"]
DRAG, LAG = INDEX["drag"], INDEX["electrical_time_constant"]
STEP, STEP_TIME = INDEX["step_voltage"], INDEX["step_time"]
RIPPLE, CYCLES, RISE, WARM_UP = (
    INDEX["ripple_voltage"],
    INDEX["ripple_cycles"],
    INDEX["resistance_rise"],
    INDEX["warm_up_time"],
)
PLAY, LOAD_FRACTION = INDEX["backlash_angle"], INDEX["load_fraction"]
COARSENESS = INDEX["coarseness"]

MAX_PIECES = 100_000  # between two outputs; a guard against endless chatter, never reached in a physical case
STRIBECK_PIECE, RUNAWAY, DRAG_PIECE, RIPPLE_PIECE = 0.25, 0.5, 1e-3, 0.4
EARLY, LATE = 0.5 - sqrt(1 / 12), 0.5 + sqrt(1 / 12)  # Gauss nodes of a piece


@compiled
def is_straight(p: Floats) -> bool:
    """Whether the equation is linear and the same at any time while the shaft turns one way at one voltage."""
    smooth = p[BREAKAWAY] <= p[KS] and p[DRAG] == 0.0 and p[RIPPLE] == 0.0 and p[RISE] == 0.0
    return smooth and p[LAG] == 0.0 and p[STEP] == 0.0 and (p[PLAY] == 0.0 or p[LOAD_FRACTION] == 0.0)


@compiled
def straight(p: Floats, u: float, direction: float) -> Coefficients:
    """The linear equation of a motor for which `is_straight` holds, at an effective voltage u [V]."""
    source, back_emf = drive_of(p, u)
    return Coefficients(p[KA], friction_at(p, 0.0, direction) + loads_at(p, 0.0, 0.0), 0.0, source, back_emf, 0.0)


@compiled
def _longest_piece(p: Floats, s: State, acceleration: float, inertia: float) -> float:
    """[s] for which a piece's lines hold: unlimited for a linear motor (a quarter period if it oscillates)."""
    longest = inf
    if 4.0 * p[KV] * p[LAG] > inertia:
        longest = 1.5 * sqrt(inertia * p[LAG] / p[KV])
    if p[BREAKAWAY] > p[KS]:
        above = abs(s.speed) - 4.0 * p[STRIBECK]  # up there Stribeck friction is gone
        # A speed that runs away from Stribeck friction must not do so in one piece; its steepest slope is √(2/e).
        steepest = 0.858 * (p[BREAKAWAY] - p[KS]) / p[STRIBECK]
        swift = abs(acceleration) + 1e-9
        near = min(max(STRIBECK_PIECE * p[STRIBECK] / swift, 1e-6), RUNAWAY * inertia / steepest)
        longest = min(longest, max(above / swift, near))
    squared = acceleration * acceleration + 1e-9
    if p[DRAG] != 0.0:
        longest = min(longest, (DRAG_PIECE * inertia / (p[KV] * p[DRAG] * squared)) ** (1.0 / 3.0))
    if p[RIPPLE] != 0.0:
        turn = RIPPLE_PIECE / p[CYCLES]  # [rad] of the shaft
        longest = min(longest, turn / (abs(s.speed) + 1e-9), sqrt(turn / (sqrt(squared) + p[RIPPLE] / inertia)))
    if p[RISE] != 0.0:
        longest = min(longest, 0.01 * p[WARM_UP])
    return longest * p[COARSENESS]


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
def _lines(p: Floats, c: Coefficients, s: State, t: float, h: float) -> Coefficients:
    """A piece's coefficients with friction and loads as the lines through their values at the Gauss nodes.

    c: the linearisation at the start, by which the nodes are found; t: time [s] of the start.
    """
    early, _drive, travel = solve(p, c, s, EARLY * h)
    late, _drive, further = solve(p, c, s, LATE * h)
    early, late = s.direction * max(early * s.direction, 0.0), s.direction * max(late * s.direction, 0.0)
    middle = warmth(p, t + 0.5 * h)
    first, second = friction_at(p, early, s.direction), friction_at(p, late, s.direction)
    if abs(late - early) > 1e-6 * abs(late + early):
        slope = (second - first) / (late - early)
    else:
        slope = friction_slope_at(p, 0.5 * (early + late))
    angle = s.angle + s.turned
    load, after = loads_at(p, angle + travel, t), loads_at(p, angle + further, t)
    gradient = (after - load) / ((LATE - EARLY) * h)
    torque = 0.5 * (first + second) + slope * (s.speed - 0.5 * (early + late)) + 0.5 * (load + after - gradient * h)
    inertia = c.inertia / warmth(p, t) * middle
    return Coefficients(inertia, middle * torque, middle * slope, c.source, c.back_emf, middle * gradient)


@compiled
def piece(p: Floats, u: float, s: State, t: float, h: float) -> tuple[State, float]:
    """The motion until the next event, at most h [s] long, in which the shaft does not reverse.

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
        held, drive, started = _hold(p, s, source, load, w * max(p[KS], p[BREAKAWAY]), h)
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
    c = Coefficients(inertia, torque, slope, source, back_emf, 0.0)
    acceleration = (s.drive - torque) / inertia
    settled = (source - back_emf * s.speed - torque) / inertia  # the acceleration once the current has followed
    h = min(h, _longest_piece(p, s, max(abs(acceleration), abs(settled)), inertia))
    if p[BREAKAWAY] > p[KS] or p[DRAG] != 0.0 or p[RISE] != 0.0 or p[RIPPLE] != 0.0:
        c = _lines(p, c, s, t, h)
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
