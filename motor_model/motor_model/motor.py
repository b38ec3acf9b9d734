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
friction, drag and ripple. A piece is solved by the exponential Rosenbrock-Euler method (Hochbruck & Ostermann, Acta
Numerica 19, 2010): exact for everything linear, second order for those three, for which pieces are kept short.
"""

from math import atan, atanh, copysign, exp, inf, log1p, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_model.bridge import effective_voltage
from motor_model.compiled import compiled
from motor_model.effects import INDEX
from motor_model.forces import drive_of, friction_at, loads_at, warmth
from motor_model.linear import Coefficients, first_order, second_order

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

MAX_PIECES = 100_000  # between two outputs; a guard against endless chatter, never reached in a physical case


class State(NamedTuple):
    """Where the motor is: all a step needs to know of the past."""

    angle: float  # [rad] shaft angle θ
    speed: float  # [rad/s] ω
    drive: float  # [V] v, where the armature has inductance
    play: float  # [rad] travel left until the load is taken along again
    direction: float  # −1, 0, +1: of the latest motion
    turned: float  # [rad] added to θ in the ripple's argument (an angle taken from measured edges)


@compiled
def at_rest(angle: float) -> State:
    """A motor that stands at this angle [rad] and has not moved yet."""
    return State(angle, 0.0, 0.0, 0.0, 0.0, 0.0)


@compiled
def turning(p: Floats, speed: float, u: float) -> State:
    """A motor that passes angle 0 at a speed [rad/s], not 0, its current settled under an effective voltage u [V]."""
    source, back_emf = drive_of(p, u)
    return State(0.0, speed, source - back_emf * speed, 0.0, copysign(1.0, speed), 0.0)


@compiled
def _longest_piece(p: Floats, s: State, acceleration: float, inertia: float, slope: float) -> float:
    """[s] for which a piece's linearisation holds: unlimited for a linear motor (a quarter period if it oscillates)."""
    longest = inf
    if 4.0 * p[KV] * p[LAG] > inertia:
        longest = 1.5 * sqrt(inertia * p[LAG] / p[KV])
    if p[BREAKAWAY] > p[KS]:
        above = abs(s.speed) - 4.0 * p[STRIBECK]  # up there Stribeck friction is gone
        if above > 0.0:
            longest = min(longest, max(above / (abs(acceleration) + 1e-9), 1e-4))
        else:
            longest = min(longest, max(min(0.05 * p[STRIBECK] / (abs(acceleration) + 1e-9), 1e-3), 1e-6))
    if slope < 0.0:  # a speed that runs away from Stribeck friction must not do so in one piece
        longest = min(longest, -0.5 * inertia / slope)
    if p[DRAG] != 0.0:
        longest = min(longest, 1e-3)
    if p[RIPPLE] != 0.0:
        turning = abs(s.speed) + 1e-3 * abs(acceleration)
        longest = min(longest, 0.2 / (p[CYCLES] * turning + 1e-9), 1e-3)
    if p[RISE] != 0.0:
        longest = min(longest, 0.01 * p[WARM_UP])
    return longest


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
def _solve(p: Floats, c: Coefficients, s: State, h: float) -> tuple[float, float, float]:
    """Speed, v and travel after h, whichever order the motor has."""
    if p[LAG] == 0.0:
        speed, travel = first_order(c, s.speed, h)
        return speed, s.drive, travel
    return second_order(c, p[LAG], s.speed, s.drive, h)


@compiled
def _time_of_rest(p: Floats, c: Coefficients, s: State, h: float) -> float:
    """[s] until the speed reaches zero, known to happen within h."""
    if p[LAG] == 0.0:
        total = c.source - c.torque + c.slope * s.speed
        damping = c.back_emf + c.slope
        x = -damping * s.speed / total if total != 0.0 else inf
        if abs(x) < 1e-9:
            return min(h, -c.inertia * s.speed / total)
        if x > -1.0 and x < inf:
            return min(h, c.inertia / damping * log1p(x))
    low, high = 0.0, h
    for _ in range(60):
        middle = 0.5 * (low + high)
        if _solve(p, c, s, middle)[0] * s.speed > 0.0:
            low = middle
        else:
            high = middle
        if high - low < 1e-15 * h:
            break
    return high


@compiled
def _time_of_extreme(p: Floats, c: Coefficients, s: State) -> float:
    """[s] until the acceleration of a motor with inductance is zero for the first time; inf if it never is.

    The acceleration is e^(mt)·(α·cosh(gt) + β/g·sinh(gt)) with the eigenvalues m ± g, α its value and α' its slope now,
    β = α' − m·α; so that tanh(gt) = −g·α/β.
    """
    a, e = -c.slope / c.inertia, -1.0 / p[LAG]
    now = (s.drive - c.torque) / c.inertia
    slope = a * now + (c.source - c.back_emf * s.speed - s.drive) / p[LAG] / c.inertia
    rest = slope - 0.5 * (a + e) * now
    if now * rest >= 0.0:
        return inf
    square = 0.25 * (a - e) * (a - e) - c.back_emf / p[LAG] / c.inertia
    gap = sqrt(abs(square))
    x = -gap * now / rest
    if square <= 0.0 or x < 1e-6:
        return atan(x) / gap if gap > 0.0 else -now / rest
    return atanh(x) / gap if x < 1.0 else inf


@compiled
def _time_of_travel(p: Floats, c: Coefficients, s: State, h: float, travel: float) -> float:
    """[s] until the shaft has travelled that far, known to happen within h (Newton, kept inside by bisection)."""
    low, high, guess = 0.0, h, 0.5 * h
    for _ in range(60):
        speed, _drive_then, done = _solve(p, c, s, guess)
        error = done - travel
        if error * travel > 0.0:
            high = guess
        else:
            low = guess
        step = error / speed if speed != 0.0 else inf
        if abs(step) <= 1e-14 * h:
            break
        guess -= step
        if not low < guess < high:
            guess = 0.5 * (low + high)
    return guess


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

    friction, slope = friction_at(p, s.speed, direction)
    engaged = p[KA] * w * (1.0 - (p[LOAD_FRACTION] if play > 0.0 else 0.0))
    torque = w * (friction + loads_at(p, s.angle + s.turned, t))
    acceleration = (s.drive - torque) / engaged
    settled = (source - back_emf * s.speed - torque) / engaged  # the acceleration once the current has followed
    h = min(h, _longest_piece(p, s, max(abs(acceleration), abs(settled)), engaged, w * slope))
    if p[RISE] != 0.0 or p[RIPPLE] != 0.0:  # what changes with time and angle is taken in the middle
        middle = s.angle + s.turned + 0.5 * h * (s.speed + 0.25 * h * acceleration)
        w = warmth(p, t + 0.5 * h)
        engaged = p[KA] * w * (1.0 - (p[LOAD_FRACTION] if play > 0.0 else 0.0))
        torque = w * (friction + loads_at(p, middle, t))
    c = Coefficients(engaged, torque, w * slope, source, back_emf)
    return _until_event(p, c, s, h)


@compiled
def _until_event(p: Floats, c: Coefficients, s: State, h: float) -> tuple[State, float]:
    """Solve a piece of h, or up to where the shaft comes to rest or the play is taken up."""
    speed, drive, travel = _solve(p, c, s, h)
    event = 0
    if p[LAG] > 0.0:
        turned = _time_of_extreme(p, c, s)
        if turned < h:  # the state after h may hide that it braked through zero, or left its rest, and is back
            then = _solve(p, c, s, turned)
            still, onward = s.speed == 0.0, then[0] * s.direction > 0.0
            if (not still and not onward) or (still and onward and speed * s.direction <= 0.0):
                h = turned
                speed, drive, travel = then
    if s.speed == 0.0 and speed * s.direction <= 0.0:  # what let it start is gone before it has moved
        return State(s.angle, 0.0, drive, s.play, s.direction, s.turned), h
    if speed * s.direction <= 0.0:
        event, h = 1, _time_of_rest(p, c, s, h)
        speed, drive, travel = _solve(p, c, s, h)
    play = s.play
    if play > 0.0:
        if abs(travel) >= play:
            event, h = 2, _time_of_travel(p, c, s, h, s.direction * play)
            speed, drive, travel = _solve(p, c, s, h)
            play = 0.0
        else:
            play -= abs(travel)
    if event == 1:
        speed = 0.0
    return State(s.angle + travel, speed, drive, play, s.direction, s.turned), h


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
