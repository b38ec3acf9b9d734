"""The feed-forward: the voltage that the model says the reference needs, friction, loads, bridge and supply included.

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
        """[V] for a reference [rad/s] that changes by `slope` [rad/s²], against a load [V] beyond the model's."""
        direction = float((reference > 0.0) - (reference < 0.0))
        return float(needed_command(self.vector, reference, slope, load, direction))

    @property
    def fastest(self) -> float:
        """[rad/s] that no voltage of this supply exceeds, whatever the direction."""
        p = self.vector
        push = p[INDEX["max_voltage"]] * max(1.0, p[INDEX["reverse_gain"]]) + abs(p[INDEX["bias_voltage"]])
        return float(push / p[INDEX["kv"]])
