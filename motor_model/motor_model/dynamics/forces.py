"""The terms of the motor's equation, in V: what drives it, what friction takes, what loads it. See `motor.py`."""

from math import cos, exp, expm1, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.effects import INDEX

Floats = NDArray[np.float64]

KV = INDEX["kv"]
KS, BREAKAWAY, STRIBECK = INDEX["ks"], INDEX["breakaway_voltage"], INDEX["stribeck_speed"]
DRAG, BIAS = INDEX["drag"], INDEX["bias_voltage"]
STEP, STEP_TIME = INDEX["step_voltage"], INDEX["step_time"]
COAST, SAG = INDEX["coast_share"], INDEX["sag"]
RIPPLE, CYCLES, PHASE = INDEX["ripple_voltage"], INDEX["ripple_cycles"], INDEX["ripple_phase"]
RISE, WARM_UP = INDEX["resistance_rise"], INDEX["warm_up_time"]
U_MAX, CONSTANT, GEAR = INDEX["max_voltage"], INDEX["torque_constant"], INDEX["gear_ratio"]

GONE = 40.0  # of (ω/ω_s)²: e^−40 of Stribeck friction is less than the rounding of any number beside it


@compiled
def back_emf_constant(p: Floats) -> float:
    """Return ke [V·s/rad]: the torque constant, or all of kv where that is not known (0)."""
    return p[CONSTANT] if p[CONSTANT] > 0.0 else p[KV]


@compiled
def viscous_part(p: Floats) -> float:
    """Return what kv holds of viscous friction [V·s/rad]."""
    return p[KV] - back_emf_constant(p)


@compiled
def warmth(p: Floats, t: float) -> float:
    """w: how much warm copper raises ka, friction and loads at time t [s]."""
    if p[RISE] == 0.0:
        return 1.0
    return 1.0 - p[RISE] * expm1(-t / p[WARM_UP])


@compiled
def steady_load_at(p: Floats, t: float) -> float:
    """Return the loads at a time [s] that are the same at every angle, in V, cold."""
    return float(p[BIAS] + (p[STEP] if p[STEP] != 0.0 and t >= p[STEP_TIME] else 0.0))


@compiled
def loads_at(p: Floats, angle: float, t: float) -> float:
    """All loads at an angle [rad] of the output and a time [s], in V, cold; ripple has cycles of the encoder's turn."""
    load = steady_load_at(p, t)
    if p[RIPPLE] != 0.0:
        load += p[RIPPLE] * sin(p[CYCLES] * p[GEAR] * angle + p[PHASE])
    return load


@compiled
def load_slope_at(p: Floats, angle: float) -> float:
    """Return the slope of the loads over the angle [rad] of the output, in V/rad, cold."""
    if p[RIPPLE] == 0.0:
        return 0.0
    cycles = p[CYCLES] * p[GEAR]
    return p[RIPPLE] * cycles * cos(cycles * angle + p[PHASE])


@compiled
def sliding_friction(p: Floats, direction: float) -> float:
    """Return the friction in V that is the same at every speed at which a motor slides."""
    return direction * p[KS]


@compiled
def sliding_speed(p: Floats) -> float:
    """Return the speed [rad/s] above which Stribeck friction is gone: there the motor slides."""
    return p[STRIBECK] * sqrt(GONE) if p[BREAKAWAY] > p[KS] else 0.0


@compiled
def friction_at(p: Floats, speed: float, direction: float) -> float:
    """Friction at a speed [rad/s], in V; the direction decides at rest."""
    friction = sliding_friction(p, direction) + viscous_part(p) * speed
    if p[BREAKAWAY] > p[KS]:
        x = speed / p[STRIBECK]
        if x * x < GONE:
            friction += direction * (p[BREAKAWAY] - p[KS]) * exp(-x * x)
    return friction + p[DRAG] * speed * abs(speed)


@compiled
def friction_slope_at(p: Floats, speed: float) -> float:
    """Return the slope of friction over the speed, in V·s/rad."""
    slope = viscous_part(p) + 2.0 * p[DRAG] * abs(speed)
    if p[BREAKAWAY] > p[KS]:
        x = abs(speed) / p[STRIBECK]
        if x * x < GONE:
            slope -= (p[BREAKAWAY] - p[KS]) * exp(-x * x) * 2.0 * x / p[STRIBECK]
    return slope


@compiled
def drag_curvature_at(p: Floats, speed: float) -> float:
    """Return the size of half the second derivative of friction without Stribeck's over the speed, in V·s²/rad²."""
    return p[DRAG]


@compiled
def is_bent(p: Floats) -> bool:
    """Tell whether friction or loads are more than lines while the shaft turns one way, or change with time."""
    return bool(p[BREAKAWAY] > p[KS] or p[DRAG] != 0.0 or p[RISE] != 0.0 or p[RIPPLE] != 0.0)


@compiled
def drive_of(p: Floats, u: float) -> tuple[float, float]:
    """Split the drive, R·current, under an effective voltage u: its constant part, and the back-EMF per speed."""
    if p[SAG] == 0.0 and p[COAST] == 0.0:  # as of most motors: the same without divisions
        return u, back_emf_constant(p)
    share = u / p[U_MAX]
    sag = 1.0 + p[SAG] * share * share
    return u / sag, back_emf_constant(p) * (1.0 - p[COAST] * (1.0 - abs(share))) / sag
