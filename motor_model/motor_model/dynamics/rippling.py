"""The motion of a straight motor beside a ripple that passes so fast that it hardly moves the shaft.

Within a part of a step the ripple's phase then goes with the mean speed, and what that leaves of it, the bend
d(t) = cycles·a·t·(t − h)/2 of an even acceleration a, is small. So the torque is Im(P(t)·e^(i(ψ + f·t))) of
P = −ripple·(1 + i·d), and what a linear equation makes of it has a closed form: with G(σ) the speed per torque of the
motor at the complex frequency σ, and G′, G″ its derivatives at i·f,

    swing(t) = Im((G·P + G′·P′ + G″·P″/2)·e^(i(ψ + f·t))),  G(σ) = 1/(inertia·σ + slope + back_emf/(1 + σ·τ))

its travel that of G(σ)/σ. Beside the swing the shaft turns as if there was no ripple (`straight.py`). What this leaves
out is the ripple's own doing to its phase, of second order in the swing. A piece of `pieces.py` is a small part of a
period; where a step has many periods, as between the rows of a log of a fast motor, this is one piece. Without
inductance fewer are quicker as they are (`rippled_slide.py`).
"""

from math import cos, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.pieces import RIPPLE_BEND, RIPPLE_TURN
from motor_model.dynamics.rippled_slide import slide
from motor_model.dynamics.state import State
from motor_model.dynamics.straight import Hold, Lagging, Torques, turn, turn_lagging
from motor_model.effects import INDEX

Floats = NDArray[np.float64]

KA, LAG = INDEX["ka"], INDEX["electrical_time_constant"]
RIPPLE, CYCLES, PHASE = INDEX["ripple_voltage"], INDEX["ripple_cycles"], INDEX["ripple_phase"]
COARSENESS, GEAR = INDEX["coarseness"], INDEX["gear_ratio"]

# [rad] by which a swing moves a ripple's own phase, at most, before `coarseness`: what that does to the mean torque is
# told, what is left is of the third order. Measured against pieces a hundredth as long: of the travel 6e-9 in the
# median, 6e-7 in one of a hundred; pieces as they are leave as much.
OWN_PHASE = 5e-4
PIECES, SLIDES = 1.2, 3.0  # of `pieces.py`, and of `rippled_slide.py`, that take as long as one of these


class Response(NamedTuple):
    """What a linear motor makes of a torque at a complex frequency: a value with its first two derivatives."""

    value: complex
    first: complex
    second: complex


@compiled
def _times(one: Response, other: Response) -> Response:
    """Multiply two functions of the frequency."""
    return Response(
        one.value * other.value,
        one.first * other.value + one.value * other.first,
        one.second * other.value + 2.0 * one.first * other.first + one.value * other.second,
    )


@compiled
def _inverse(one: Response) -> Response:
    """Invert a function of the frequency."""
    value = 1.0 / one.value
    first = -one.first * value * value
    return Response(value, first, -(one.second * value + 2.0 * one.first * first) * value)


@compiled
def respond(p: Floats, hold: Hold, w: float, frequency: float) -> tuple[Response, Response, Response]:
    """Find speed, v and travel per torque [V], in copper of warmth w, at a frequency [rad/s]."""
    sigma = complex(0.0, frequency)
    lag = _inverse(Response(1.0 + sigma * p[LAG], complex(p[LAG], 0.0), 0.0j))
    inertia, back_emf = w * p[KA], hold.back_emf
    speed = _inverse(
        Response(
            inertia * sigma + w * hold.torques.slope + back_emf * lag.value,
            inertia + back_emf * lag.first,
            back_emf * lag.second,
        )
    )
    follows = _times(speed, lag)
    drive = Response(-back_emf * follows.value, -back_emf * follows.first, -back_emf * follows.second)
    return speed, drive, _times(speed, _inverse(Response(sigma, 1.0 + 0.0j, 0.0j)))


@compiled
def _swing(g: Response, bent: float, way: float, turn: complex) -> float:
    """What a response is at an end of a part, per torque; bent: of the phase [rad/s²], way: ∓h/2 at begin and end."""
    return ((g.value + complex(0.0, bent) * (g.first * way + 0.5 * g.second)) * turn).imag


@compiled
def _simple_response(p: Floats, hold: Hold, w: float, frequency: float) -> complex:
    """Find the speed per torque [V] alone, in copper of warmth w, at a frequency [rad/s]."""
    lag = complex(1.0, frequency * p[LAG])
    return complex(1.0 / (complex(w * hold.torques.slope, frequency * w * p[KA]) + hold.back_emf / lag))


@compiled
def count_parts(p: Floats, hold: Hold, s: State, h: float, w: float) -> int:
    """Count the parts of a step of h [s] in each of which a ripple's phase goes evenly; 0 where pieces are as quick."""
    cycles = p[CYCLES] * p[GEAR]
    frequency = cycles * abs(s.speed)
    most = frequency * h / ((PIECES if p[LAG] > 0.0 else SLIDES) * RIPPLE_TURN * p[COARSENESS])
    if most < 1.0:
        return 0
    swing = abs(w * p[RIPPLE] * _simple_response(p, hold, w, frequency)) / frequency
    if cycles * swing > OWN_PHASE * p[COARSENESS]:
        return 0
    inertia, torque = p[KA] * w, w * (hold.torques.ahead if s.speed > 0.0 else hold.torques.back)
    torque += w * hold.torques.slope * s.speed
    settled = abs(hold.source - hold.back_emf * s.speed - torque)
    acceleration = (max(settled, abs(s.drive - torque)) if p[LAG] > 0.0 else settled) / inertia
    parts = h * sqrt(0.125 * cycles * acceleration / RIPPLE_BEND) / p[COARSENESS]
    return int(parts) + 1 if parts + 1.0 <= most else 0


@compiled
def _retard(p: Floats, hold: Hold, w: float, torque: float) -> Hold:
    """Let a hold's motor turn against one torque [V] more."""
    push, ahead, back, slope = torque / (w * p[KA]), hold.torques.ahead, hold.torques.back, hold.torques.slope
    torques = Torques(ahead + torque / w, back + torque / w, slope)
    return Hold(torques, hold.source, hold.back_emf, hold.ahead_push - push, hold.back_push - push, hold.rate)


@compiled
def _turn_beside(
    p: Floats, hold: Hold, s: State, h: float, w: float, least: float, latest: Lagging
) -> tuple[float, float, float, Lagging]:
    """Speed, v and travel after h [s] of the motion beside the swing."""
    if p[LAG] == 0.0:
        then, travel = turn(p, hold, s.speed, h, w)
        return then, s.drive, travel, latest
    return turn_lagging(p, hold, s, h, w, least, latest)


@compiled
def _turn_part(
    p: Floats, hold: Hold, s: State, h: float, w: float, least: float, latest: Lagging
) -> tuple[float, float, float, Lagging]:
    """Speed, v and travel after h [s], in which the phase goes with the mean speed."""
    cycles, torque = p[CYCLES] * p[GEAR], -w * p[RIPPLE]
    phase = cycles * (s.angle + s.turned) + p[PHASE]
    begin = complex(cos(phase), sin(phase))
    swing = torque * _simple_response(p, hold, w, cycles * s.speed)
    first = s.speed - (swing * begin).imag
    guess = State(s.angle, first, s.drive, 0.0, s.direction, 0.0)
    then, drive, travel, latest = _turn_beside(p, hold, guess, h, w, least, latest)
    if then * s.speed <= 0.0:
        return 0.0, 0.0, 0.0, latest
    end = begin * complex(cos(cycles * travel), sin(cycles * travel))
    mean = (travel + (swing * (end - begin) / complex(0.0, cycles * first)).imag) / h
    bent = cycles * (then - first) / h
    speeds, drives, travels = respond(p, hold, w, cycles * mean)
    end = begin * complex(cos(cycles * mean * h), sin(cycles * mean * h))
    first = s.speed - torque * _swing(speeds, bent, -0.5 * h, begin)
    early = s.drive - torque * _swing(drives, bent, -0.5 * h, begin)
    beside = State(s.angle, first, early, 0.0, s.direction, 0.0)
    own = -0.5 * torque * cycles * torque * travels.value.imag  # mean torque of a phase that the swing moves
    then, drive, travel, latest = _turn_beside(p, _retard(p, hold, w, own), beside, h, w, least, latest)
    then += torque * _swing(speeds, bent, 0.5 * h, end)
    drive += torque * _swing(drives, bent, 0.5 * h, end)
    travel += torque * (_swing(travels, bent, 0.5 * h, end) - _swing(travels, bent, -0.5 * h, begin))
    return then, drive, travel, latest


@compiled
def turn_rippled(
    p: Floats, hold: Hold, s: State, h: float, w: float, least: float, latest: Lagging
) -> tuple[float, float, float, Lagging]:
    """Speed, v and travel after h [s] of a turning motor beside a fast ripple.

    A speed of 0 where the ripple is left to pieces, and where the shaft may not keep turning so fast that this holds,
    or faster than `least` [rad/s].
    """
    travel, fast, parts = 0.0, 0.5 * abs(s.speed), count_parts(p, hold, s, h, w)
    if parts == 0 and p[LAG] == 0.0:
        then, travel = slide(p, hold, s, h, w, least)
        return then, s.drive, travel, latest
    if parts == 0:
        return 0.0, 0.0, 0.0, latest
    for _ in range(parts):
        then, drive, further, latest = _turn_part(p, hold, s, h / parts, w, least, latest)
        if then * s.direction <= max(least, fast):
            return 0.0, 0.0, 0.0, latest
        s = State(s.angle + further, then, drive, 0.0, s.direction, s.turned)
        travel += further
    return s.speed, s.drive, travel, latest


@compiled
def turn_on(
    p: Floats, hold: Hold, s: State, h: float, w: float, least: float, latest: Lagging
) -> tuple[float, float, float, Lagging]:
    """Speed, v and travel after h [s] of a straight motor that turns, with a ripple or not; a speed of 0 as above."""
    if p[RIPPLE] != 0.0:
        return turn_rippled(p, hold, s, h, w, least, latest)
    return _turn_beside(p, hold, s, h, w, least, latest)
