"""Where a motor is: its state, at the start and while it moves."""

from math import copysign
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.forces import drive_of
from motor_model.effects import INDEX

Floats = NDArray[np.float64]

PLAY, OPEN_PLAY = INDEX["backlash_angle"], INDEX["open_play"]


class State(NamedTuple):
    """Where the motor is: all a step needs to know of the past."""

    angle: float  # [rad] shaft angle θ
    speed: float  # [rad/s] ω
    drive: float  # [V] v, where the armature has inductance; see `current.py` for the current
    play: float  # [rad] travel left until the load is taken along again
    direction: float  # −1, 0, +1: of the latest motion
    turned: float  # [rad] added to θ in the ripple's argument (an angle taken from measured edges)


@compiled
def at_rest(angle: float) -> State:
    """Return a motor that stands at this angle [rad] and has not moved yet."""
    return State(angle, 0.0, 0.0, 0.0, 0.0, 0.0)


@compiled
def standing(p: Floats) -> State:
    """Return a motor that stands at angle 0 and has not moved yet, with as much of its play open as p says."""
    return State(0.0, 0.0, 0.0, p[OPEN_PLAY] * p[PLAY], 0.0, 0.0)


@compiled
def turning(p: Floats, speed: float, u: float) -> State:
    """Start a motor that passes angle 0 at a speed [rad/s], not 0, its current settled under u [V], effective."""
    source, back_emf = drive_of(p, u)
    return State(0.0, speed, source - back_emf * speed, 0.0, copysign(1.0, speed), 0.0)
