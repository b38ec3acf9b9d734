"""The motion of a straight motor without inductance beside a ripple, in pieces that are prepared once for a step.

A piece is what it is in `motor.py`: the ripple becomes the line through its values at the two Gauss nodes, which are
found from the ripple's slope at the piece's start. As friction is constant here and all pieces of a step are as long,
what a linear equation makes of a constant and of a line is had once, and a piece asks for three sines.
"""

from math import cos, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.linear import phi_triple
from motor_model.dynamics.pieces import EARLY, LATE, ripple_piece
from motor_model.dynamics.state import State
from motor_model.dynamics.straight import Hold
from motor_model.effects import INDEX

Floats = NDArray[np.float64]

KA = INDEX["ka"]
RIPPLE, CYCLES, PHASE = INDEX["ripple_voltage"], INDEX["ripple_cycles"], INDEX["ripple_phase"]
COARSENESS, GEAR = INDEX["coarseness"], INDEX["gear_ratio"]


class Relaxing(NamedTuple):
    """What a linear motor makes of an acceleration within a time, and of one that grows with it: speed and travel."""

    time: float  # [s]
    speed: float  # [s] per rad/s²
    travel: float  # [s²] per rad/s²; and speed per rad/s³ of growth
    further: float  # [s³] travel of that


@compiled
def relax(rate: float, time: float) -> Relaxing:
    """Prepare a time [s] of dω/dt = acceleration + growth·t − rate·(ω − ω0)."""
    first, second, third = phi_triple(-rate * time)
    square = time * time
    return Relaxing(time, time * first, square * second, square * time * third)


@compiled
def slide(p: Floats, hold: Hold, s: State, h: float, w: float, least: float) -> tuple[float, float]:
    """Speed and travel after h [s] of a turning motor beside a ripple, in copper of warmth w.

    A speed of 0 where it may not keep turning half as fast as at first, or faster than `least` [rad/s].
    """
    torque = hold.torques.ahead if s.speed > 0.0 else hold.torques.back
    inertia = w * p[KA]
    rate, push = (hold.back_emf + w * hold.torques.slope) / inertia, (hold.source - w * torque) / inertia
    jolt, cycles = p[RIPPLE] / p[KA], p[CYCLES] * p[GEAR]
    swift = abs(push - rate * s.speed)
    fastest = abs(s.speed) + (swift + abs(jolt)) * h / (1.0 + 0.5 * rate * h)
    count = int(h / (ripple_piece(p, fastest, swift, p[KA]) * p[COARSENESS])) + 1
    step = h / count
    early, late, whole = relax(rate, EARLY * step), relax(rate, LATE * step), relax(rate, step)
    way, slow = (1.0 if s.speed > 0.0 else -1.0), max(least, 0.5 * abs(s.speed))
    phase, speed, travel = cycles * (s.angle + s.turned) + p[PHASE], s.speed, 0.0
    for _ in range(count):
        here = phase + cycles * travel
        net = push - rate * speed
        start, growth = net - jolt * sin(here), -jolt * cycles * speed * cos(here)
        first = cycles * (early.time * speed + early.travel * start + early.further * growth)
        second = cycles * (late.time * speed + late.travel * start + late.further * growth)
        begin, end = -jolt * sin(here + first), -jolt * sin(here + second)
        growth = (end - begin) / ((LATE - EARLY) * step)
        start = net + 0.5 * (begin + end - growth * step)
        travel += step * speed + whole.travel * start + whole.further * growth
        speed += whole.speed * start + whole.travel * growth
        if speed * way <= slow:
            return 0.0, 0.0
    return speed, travel
