"""What an effect is: its name, what it does, its parameters with their units and where a search looks for them."""

from dataclasses import dataclass
from enum import Enum
from math import inf


class Scale(Enum):
    """What a search bound is a multiple of: powers of a recording's largest voltage, largest speed and duration."""

    ABSOLUTE = (0, 0, 0)
    VOLTAGE = (1, 0, 0)  # V
    SPEED = (0, 1, 0)  # rad/s
    GAIN = (1, -1, 0)  # V·s/rad
    DRAG = (1, -2, 0)  # V·s²/rad²
    DURATION = (0, 0, 1)  # s

    def of(self, voltage: float, speed: float, duration: float) -> float:
        """The scale's size for a recording that reaches `voltage` [V] and `speed` [rad/s] in `duration` [s]."""
        powers = self.value
        return float(voltage ** powers[0] * speed ** powers[1] * duration ** powers[2])


@dataclass(frozen=True, slots=True)
class ParameterSpec:
    """One parameter: `off` makes its effect vanish, `low`..`high` (times `scale`) is where a search looks.

    `minimum` and `maximum` are what physics allows at all; `logarithmic` parameters are searched by their logarithm.
    What is `of_recording` has a value for every recording of a motor, such as a phase: there is no index pulse.
    """

    name: str
    unit: str
    off: float
    low: float
    high: float
    scale: Scale = Scale.ABSOLUTE
    logarithmic: bool = False
    minimum: float = 0.0
    maximum: float = inf
    of_recording: bool = False


@dataclass(frozen=True, slots=True)
class Effect:
    """A named physical effect: what it does, its parameters, and the effect it cannot be without.

    `shown_by` is the excitation profile (`excitation.py`) that makes it visible. A `periodic` effect repeats with the
    shaft angle.
    """

    name: str
    summary: str
    shown_by: str
    parameters: tuple[ParameterSpec, ...]
    implies: str | None = None
    periodic: bool = False
