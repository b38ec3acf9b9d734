"""Compute the feed-forward: the voltage that the model needs for the reference, with friction, loads and bridge.

    f = ks·sign r + … + kv·r + ka·dr/dt + load, put through the inverse of the bridge

The friction is that at the reference's own speed and sign, so it changes sign where the reference does and not with the
noise of a measurement; at a reference of 0 there is none.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from motor_model.dynamics.inverse import needed_command
from motor_model.effects import INDEX
from motor_model.parameters import Parameters


@dataclass(frozen=True)
class FeedForward:
    """The inverse of one motor."""

    parameters: Parameters
    vector: NDArray[np.float64] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "vector", self.parameters.vector())

    def voltage(self, reference: float, slope: float, load: float) -> float:
        """Compute the voltage [V] for a reference [rad/s], its slope [rad/s²], and a load [V] beyond the model's."""
        direction = float((reference > 0.0) - (reference < 0.0))
        return float(needed_command(self.vector, reference, slope, load, direction))

    @property
    def fastest(self) -> float:
        """[rad/s] that no voltage of this supply exceeds, whatever the direction."""
        p = self.vector
        push = p[INDEX["max_voltage"]] * max(1.0, p[INDEX["reverse_gain"]]) + abs(p[INDEX["bias_voltage"]])
        return float(push / p[INDEX["kv"]])

    @property
    def breakaway(self) -> float:
        """[V] that set the motor in motion in either direction: friction, bias and dead zone."""
        p = self.vector
        friction = max(p[INDEX["ks"]], p[INDEX["breakaway_voltage"]]) + abs(p[INDEX["bias_voltage"]])
        return float(friction + p[INDEX["dead_zone_voltage"]])

    def top_speed(self, voltage: float) -> float:
        """[rad/s] that the model holds with this voltage [V] in its weaker direction."""
        low, high, most = 0.0, self.fastest, 0.999 * min(voltage, float(self.vector[INDEX["limit_voltage"]]))
        for _ in range(40):
            middle = 0.5 * (low + high)
            enough = max(self.voltage(middle, 0.0, 0.0), -self.voltage(-middle, 0.0, 0.0)) <= most
            low, high = (middle, high) if enough else (low, middle)
        return low
