"""Linearise the motor model at its speed: what an error of the estimate becomes.

With the friction's slope f' there, and δd the error of the load, in volts:

    d(δω)/dt = −(kv + f')/ka·δω − δd/ka,   d(δθ)/dt = δω,   δd stays
"""

from math import expm1
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.forces import drive_of, friction_slope_at
from motor_model.effects import INDEX

KA = INDEX["ka"]

Floats = NDArray[np.float64]


class Transition(NamedTuple):
    """F of x' = F x for x = (angle, speed, load): [[1, reach, pull], [0, gain, push], [0, 0, 1]]."""

    gain: float
    reach: float  # [s]
    push: float  # [rad/s/V]
    pull: float  # [rad/V]


@compiled
def linearise_motion(p: Floats, u: float, speed: float, dt: float) -> Transition:
    """Compute the transition matrix over dt [s] at an effective voltage u [V] and about this speed [rad/s]."""
    _source, back_emf = drive_of(p, u)
    a, b = -(back_emf + friction_slope_at(p, speed)) / p[KA], -1.0 / p[KA]
    z = a * dt
    reach = dt * (1.0 + 0.5 * z) if abs(z) < 1e-4 else expm1(z) / a
    pull = b * (0.5 * dt * dt if abs(z) < 1e-4 else (reach - dt) / a)
    return Transition(1.0 + expm1(z), reach, b * reach, pull)
