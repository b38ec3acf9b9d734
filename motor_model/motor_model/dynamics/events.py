"""Events within a piece: the shaft comes to rest, or takes up its play; the motion up to the first of them."""

from math import atan, atanh, inf, log1p, sqrt

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.linear import Coefficients, first_order, second_order
from motor_model.dynamics.state import State
from motor_model.effects import INDEX

Floats = NDArray[np.float64]

LAG = INDEX["electrical_time_constant"]
AT_ONCE = 1e-12  # of a piece: an extreme so soon hides nothing, and is what rounding makes of a settled current


@compiled
def solve(p: Floats, c: Coefficients, s: State, h: float) -> tuple[float, float, float]:
    """Speed, v and travel after h, whichever order the motor has."""
    if p[LAG] == 0.0:
        speed, travel = first_order(c, s.speed, h)
        return speed, s.drive, travel
    return second_order(c, p[LAG], s.speed, s.drive, h)


@compiled
def time_of_rest(p: Floats, c: Coefficients, s: State, h: float) -> float:
    """[s] until the speed reaches zero, known to happen within h."""
    if p[LAG] == 0.0 and c.gradient == 0.0:
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
        if solve(p, c, s, middle)[0] * s.direction > 0.0:  # times the speed a slow enough one would be 0
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
        speed, _drive_then, done = solve(p, c, s, guess)
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
def until_event(p: Floats, c: Coefficients, s: State, h: float) -> tuple[State, float]:
    """Solve a piece of h, or up to where the shaft comes to rest or the play is taken up."""
    speed, drive, travel = solve(p, c, s, h)
    event = 0
    if p[LAG] > 0.0:
        turned = _time_of_extreme(p, c, s)
        if (
            AT_ONCE * h < turned < h
        ):  # the state after h may hide that it braked through zero, or left its rest, and is back
            then = solve(p, c, s, turned)
            still, onward = s.speed == 0.0, then[0] * s.direction > 0.0
            if (not still and not onward) or (still and onward and speed * s.direction <= 0.0):
                h = turned
                speed, drive, travel = then
    if s.speed == 0.0 and speed * s.direction <= 0.0:  # what let it start is gone before it has moved
        return State(s.angle, 0.0, drive, s.play, s.direction, s.turned), h
    if speed * s.direction <= 0.0:
        event, h = 1, time_of_rest(p, c, s, h)
        speed, drive, travel = solve(p, c, s, h)
    play = s.play
    if play > 0.0:
        if abs(travel) >= play:
            event, h = 2, _time_of_travel(p, c, s, h, s.direction * play)
            speed, drive, travel = solve(p, c, s, h)
            play = 0.0
        else:
            play -= abs(travel)
    if event == 1:
        speed = 0.0
    return State(s.angle + travel, speed, drive, play, s.direction, s.turned), h
