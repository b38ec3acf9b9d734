"""The unknowns of a fit: where a search looks, and how a place in that box becomes a motor and its initial state."""

from dataclasses import dataclass

import numpy as np

from motor_identification.recording import Floats, Recording
from motor_model.effects import INDEX, ParameterSpec, normalised, specs_of
from motor_model.parameters import Parameters, neutral


@dataclass(frozen=True)
class Unknowns:
    """The searched parameters, some by their logarithm, then the initial speed where the motor was already turning."""

    effects: tuple[str, ...]
    specs: tuple[ParameterSpec, ...]
    low: Floats  # (D,) of the box, logarithms where the parameter is searched by it
    high: Floats  # (D,)
    max_voltage: float
    moving_at_start: bool

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the physical parameters, in the order of a place; an initial speed comes after them."""
        return tuple(spec.name for spec in self.specs)

    @property
    def logarithmic(self) -> "np.ndarray[tuple[int], np.dtype[np.bool_]]":
        """Which of the D unknowns are searched by their logarithm."""
        flags = [spec.logarithmic for spec in self.specs] + [False] * self.moving_at_start
        return np.array(flags, dtype=bool)

    def decode(self, places: Floats) -> tuple[Floats, Floats]:
        """Places (S, D) → parameter vectors (S, P) and initial speeds (S,) [rad/s]."""
        values = np.where(self.logarithmic, np.exp(np.where(self.logarithmic, places, 0.0)), places)
        vectors = np.tile(neutral(self.max_voltage), (len(places), 1))
        for column, name in enumerate(self.names):
            vectors[:, INDEX[name]] = values[:, column]
        start = values[:, -1] if self.moving_at_start else np.zeros(len(places))
        return vectors, np.ascontiguousarray(start)

    def parameters(self, place: Floats, name: str) -> Parameters:
        """The motor at one place (D,)."""
        vector = self.decode(place[None])[0][0]
        values = {spec: float(vector[INDEX[spec]]) for spec in self.names}
        return Parameters(values, self.effects, self.max_voltage, name)

    def value_errors(self, place: Floats, place_errors: Floats) -> dict[str, float]:
        """Standard errors of the parameters from those of the place: a logarithm's is a relative one."""
        values = np.exp(place)
        scaled = np.where(self.logarithmic, values * place_errors, place_errors)
        return {name: float(scaled[i]) for i, name in enumerate(self.names)}


def unknowns_of(recording: Recording, effects: tuple[str, ...]) -> Unknowns:
    """The unknowns of these effects, in a box scaled by the recording's largest voltage, largest speed and duration.

    A motor whose first sample reports a speed is already turning, and its initial speed is searched around that.

    Raises:
        ModelError: an effect is not in the table.
    """
    specs = specs_of(effects)
    voltage = float(np.abs(recording.voltage).max())
    speed = float(np.abs(recording.speed).max())
    low, high = [], []
    for spec in specs:
        scale = spec.scale.of(voltage, speed, recording.duration)
        bounds = np.array([spec.low, spec.high]) * scale
        low.append(float(np.log(bounds[0]) if spec.logarithmic else bounds[0]))
        high.append(float(np.log(bounds[1]) if spec.logarithmic else bounds[1]))
    start_speed = float(recording.speed[0])
    if start_speed != 0.0:
        low.append(start_speed - 0.5 * abs(start_speed) - 0.02 * speed)
        high.append(start_speed + 0.5 * abs(start_speed) + 0.02 * speed)
    return Unknowns(
        normalised(effects), specs, np.array(low), np.array(high), recording.info.max_voltage, start_speed != 0.0
    )
