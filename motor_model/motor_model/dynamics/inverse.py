"""The motor's equation solved for the voltage: what command makes it turn so fast and gather speed like that."""

from math import copysign

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.forces import back_emf_constant, drive_of, friction_at
from motor_model.effects import INDEX

KA, BIAS, U_MAX = INDEX["ka"], INDEX["bias_voltage"], INDEX["max_voltage"]
DEAD_ZONE, REVERSE_GAIN = INDEX["dead_zone_voltage"], INDEX["reverse_gain"]

Floats = NDArray[np.float64]


@compiled
def _excess(p: Floats, u: float, speed: float, torque: float) -> float:
    """[V] by which an effective voltage drives more than is needed."""
    source, back_emf = drive_of(p, u)
    return source - back_emf * speed - torque


@compiled
def needed_command(p: Floats, speed: float, acceleration: float, load: float, direction: float) -> float:
    """Return the command [V] for a speed [rad/s] and an acceleration [rad/s²] under a load [V] beyond the model's.

    direction: ±1 or 0, of the friction. Sag and coasting make the drive a curve in u: it is solved by bisection within
    what the supply gives, the bridge (dead zone, asymmetry) after that in closed form.
    """
    torque = friction_at(p, speed, direction) + p[BIAS] + load + p[KA] * acceleration
    low, high = -p[U_MAX], p[U_MAX]
    u = torque + back_emf_constant(p) * speed  # the answer where neither bends it
    if _excess(p, u, speed, torque) != 0.0 or abs(u) > high:
        for _ in range(50):
            u = 0.5 * (low + high)
            if _excess(p, u, speed, torque) < 0.0:
                low = u
            else:
                high = u
    if u == 0.0:
        return 0.0
    return copysign(abs(u) / (1.0 if u > 0.0 else p[REVERSE_GAIN]) + p[DEAD_ZONE], u)
