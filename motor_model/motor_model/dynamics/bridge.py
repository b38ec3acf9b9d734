"""The H-bridge: what the motor gets of a delayed command (limit, dead zone, asymmetry, in that order)."""

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.effects import INDEX

LIMIT, U_MAX = INDEX["limit_voltage"], INDEX["max_voltage"]
DEAD_ZONE, REVERSE_GAIN = INDEX["dead_zone_voltage"], INDEX["reverse_gain"]


@compiled
def effective_voltage(p: NDArray[np.float64], command: float) -> float:
    """u_eff [V] of a command [V]; p is the parameter vector. Delay is a matter of time, see `simulate.py`."""
    limit = min(p[LIMIT], p[U_MAX])
    u = min(max(command, -limit), limit)
    dead = p[DEAD_ZONE]
    if u > dead:
        return u - dead
    if u < -dead:
        return p[REVERSE_GAIN] * (u + dead)
    return 0.0
