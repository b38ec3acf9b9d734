"""The armature's current, which the motion follows from: the drive in amperes."""

import numpy as np
from numpy.typing import NDArray

from motor_model.compiled import compiled
from motor_model.dynamics.forces import drive_of, warmth
from motor_model.dynamics.state import State
from motor_model.effects import INDEX

LAG, RESISTANCE = INDEX["electrical_time_constant"], INDEX["resistance"]


@compiled
def current_at(p: NDArray[np.float64], u: float, s: State, t: float) -> float:
    """Return the current [A] of a state at time t [s], under the effective voltage u [V] that brought it there.

    The mean over the bridge's period, and of a bridge that coasts, too.
    """
    drive = s.drive
    if p[LAG] == 0.0:
        source, back_emf = drive_of(p, u)
        drive = source - back_emf * s.speed
    return float(drive / (p[RESISTANCE] * warmth(p, t)))
