"""Pieces of the motion: how long one may be, and the lines that stand in it for what is not linear.

Friction becomes its secant through the speeds at the two Gauss nodes of the piece, and loads the line through theirs,
so that what the lines leave out integrates to zero up to the fourth order in the piece's length. The nodes are found by
the exponential Rosenbrock method of the linearisation at the piece's start (Hochbruck & Ostermann, Acta Numerica 19,
2010), with the loads' change over time in it, and a piece ends where the shaft comes to rest in that: cut there later,
its lines would not be those of what is left of it.
"""

from math import inf, sqrt

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.events import solve, time_of_rest
from motor_model.dynamics.forces import drag_curvature_at, friction_at, friction_slope_at, loads_at, warmth
from motor_model.dynamics.linear import Coefficients
from motor_model.dynamics.state import State
from motor_model.effects import INDEX

Floats = NDArray[np.float64]

KV, KS, BREAKAWAY, STRIBECK = INDEX["kv"], INDEX["ks"], INDEX["breakaway_voltage"], INDEX["stribeck_speed"]
LAG = INDEX["electrical_time_constant"]
RIPPLE, CYCLES, RISE, WARM_UP = (
    INDEX["ripple_voltage"],
    INDEX["ripple_cycles"],
    INDEX["resistance_rise"],
    INDEX["warm_up_time"],
)
COARSENESS, GEAR = INDEX["coarseness"], INDEX["gear_ratio"]

STRIBECK_PIECE, RUNAWAY, DRAG_PIECE = 0.25, 0.5, 1e-3
WARM_PIECE = 0.01  # of the time in which a motor warms up
RIPPLE_ANGLE = 2e-8  # [rad] error of the swing that a ripple makes of a fast shaft
RIPPLE_TURN, RIPPLE_BEND = 1.5, 0.05  # [rad] of a ripple's phase: all of it, and what is not at the piece's first speed
EARLY, LATE = 0.5 - sqrt(1 / 12), 0.5 + sqrt(1 / 12)  # Gauss nodes of a piece


@compiled
def ripple_piece(p: Floats, speed: float, acceleration: float, inertia: float) -> float:
    """[s] for which a ripple is a line.

    Where it passes with a frequency f = cycles·ω, two Gauss nodes miss a share (f·h)⁴/4320 of its acceleration r, and
    the angle swings by r/f²: the faster, the less. Near a standstill the bend of its phase, cycles·(a + r)·h², counts.
    """
    jolt, cycles = abs(p[RIPPLE]) / inertia, p[CYCLES] * p[GEAR]
    frequency = cycles * speed + 1e-9
    turned = RIPPLE_TURN / frequency
    swing = sqrt(4320.0 * RIPPLE_ANGLE / p[GEAR] / jolt) / frequency
    bend = RIPPLE_BEND / (cycles * (acceleration + jolt))
    return sqrt(min(turned * turned, min(swing, bend)))


@compiled
def longest_slide(p: Floats, inertia: float) -> float:
    """[s] for which the lines of a motor hold that slides without drag or ripple, before `coarseness`.

    Unlimited for a linear motor (a quarter period if it oscillates).
    """
    longest = inf
    if 4.0 * p[KV] * p[LAG] > inertia:
        longest = 1.5 * sqrt(inertia * p[LAG] / p[KV])
    if p[RISE] != 0.0:
        longest = min(longest, WARM_PIECE * p[WARM_UP])
    return longest


@compiled
def longest_piece(p: Floats, s: State, acceleration: float, inertia: float, wanted: float) -> float:
    """[s] for which a piece's lines hold; not less than is `wanted`, where they hold for longer than that."""
    longest, wanted = longest_slide(p, inertia), wanted / p[COARSENESS]
    if p[BREAKAWAY] > p[KS]:
        above = abs(s.speed) - 4.0 * p[STRIBECK]  # up there Stribeck friction is gone
        # A speed that runs away from Stribeck friction must not do so in one piece; its steepest slope is √(2/e).
        steepest = 0.858 * (p[BREAKAWAY] - p[KS]) / p[STRIBECK]
        swift = abs(acceleration) + 1e-9
        near = min(max(STRIBECK_PIECE * p[STRIBECK] / swift, 1e-6), RUNAWAY * inertia / steepest)
        longest = min(longest, max(above / swift, near))
    curvature = drag_curvature_at(p, s.speed)
    if curvature != 0.0:
        squared = acceleration * acceleration + 1e-9
        cube = DRAG_PIECE * inertia / (p[KV] * curvature * squared)
        if cube < wanted * wanted * wanted:  # a root takes a quarter of all that a piece takes
            longest = min(longest, cube ** (1.0 / 3.0))
    if p[RIPPLE] != 0.0:
        longest = min(longest, ripple_piece(p, abs(s.speed), acceleration, inertia))
    return float(longest * p[COARSENESS])


@compiled
def lines(p: Floats, c: Coefficients, s: State, t: float, h: float) -> tuple[Coefficients, float]:
    """Replace friction and loads by lines through their values at the Gauss nodes: a piece's coefficients, its length.

    c: the linearisation at the start, by which the nodes are found; t: time [s] of the start.
    """
    early, _drive, travel = solve(p, c, s, EARLY * h)
    late, _drive, further = solve(p, c, s, LATE * h)
    if s.speed != 0.0 and (late + (late - early) * EARLY / (LATE - EARLY)) * s.direction < 0.0:
        h = max(time_of_rest(p, c, s, h), 1e-9 * h)
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
    return Coefficients(inertia, middle * torque, middle * slope, c.source, c.back_emf, middle * gradient), h
