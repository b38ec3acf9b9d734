"""The unknowns of a fit: where a search looks, and how a place in that box becomes a motor and its initial state."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from motor_identification.recording import Floats, Recording
from motor_model.effect import ParameterSpec
from motor_model.effects import INDEX, normalised, specs_of
from motor_model.parameters import Parameters, neutral

BREAKAWAY, KS = INDEX["breakaway_voltage"], INDEX["ks"]


@dataclass(frozen=True)
class Extent:
    """How far recordings reach: what the search box is scaled by."""

    voltage: float  # [V]
    speed: float  # [rad/s]
    duration: float  # [s]

    def of(self, spec: ParameterSpec) -> float:
        """The size of a parameter's scale here."""
        return spec.scale.of(self.voltage, self.speed, self.duration)


@dataclass(frozen=True)
class Unknowns:
    """The searched parameters, some by their logarithm, then initial speeds of recordings that start turning."""

    effects: tuple[str, ...]
    specs: tuple[ParameterSpec, ...]
    low: Floats  # (D,) of the box, logarithms where the parameter is searched by it
    high: Floats  # (D,)
    extent: Extent
    max_voltage: float
    turning: NDArray[np.bool_]  # (R,) which recordings start on a moving motor

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the physical parameters, in the order of a place; initial speeds come after them."""
        return tuple(spec.name for spec in self.specs)

    @cached_property
    def logarithmic(self) -> NDArray[np.bool_]:
        """Which of the D unknowns are searched by their logarithm."""
        flags = [spec.logarithmic for spec in self.specs] + [False] * int(self.turning.sum())
        return np.array(flags, dtype=bool)

    def decode(self, places: Floats) -> tuple[Floats, Floats]:
        """Places (S, D) → parameter vectors (S, P) and initial speeds (S, R) [rad/s]."""
        values = np.where(self.logarithmic, np.exp(np.where(self.logarithmic, places, 0.0)), places)
        vectors = np.tile(neutral(self.max_voltage), (len(places), 1))
        for column, name in enumerate(self.names):
            vectors[:, INDEX[name]] = values[:, column]
        if "static_friction" in self.effects:  # a motor does not hold less than it slides
            vectors[:, BREAKAWAY] = np.maximum(vectors[:, BREAKAWAY], vectors[:, KS])
        starts = np.zeros((len(places), len(self.turning)))
        starts[:, self.turning] = values[:, len(self.specs) :]
        return vectors, starts

    def parameters(self, place: Floats, name: str) -> Parameters:
        """The motor at one place (D,)."""
        vector = self.decode(place[None])[0][0]
        values = {spec: float(vector[INDEX[spec]]) for spec in self.names}
        return Parameters(values, self.effects, self.max_voltage, name)

    def value_errors(self, place: Floats, place_errors: Floats) -> dict[str, float]:
        """Standard errors of the parameters from those of the place: a logarithm's is a relative one."""
        values = np.exp(np.where(self.logarithmic, place, 0.0))
        scaled = np.where(self.logarithmic, values * place_errors, place_errors)
        return {name: float(scaled[i]) for i, name in enumerate(self.names)}


def _reach(speed: Floats) -> float:
    """[rad/s] largest speed that two samples in a row report, so that one false edge does not move the search box."""
    size = np.abs(speed)
    return float(np.minimum(size[1:], size[:-1]).max()) or float(size.max())


def unknowns_of(recordings: Sequence[Recording], effects: tuple[str, ...]) -> Unknowns:
    """The unknowns of these effects, in a box scaled by the largest voltage, the largest speed and the duration.

    A motor whose first sample reports a speed is already turning, and its initial speed is searched around that.

    Raises:
        ModelError: an effect is not in the table.
    """
    extent = Extent(
        max(float(np.abs(recording.voltage).max()) for recording in recordings),
        max(_reach(recording.speed) for recording in recordings),
        max(recording.duration for recording in recordings),
    )
    specs = specs_of(effects)
    low, high = [], []
    for spec in specs:
        bounds = np.array([spec.low, spec.high]) * extent.of(spec)
        low.append(float(np.log(bounds[0]) if spec.logarithmic else bounds[0]))
        high.append(float(np.log(bounds[1]) if spec.logarithmic else bounds[1]))
    starts = np.array([float(recording.speed[0]) for recording in recordings])
    for start in starts[starts != 0.0]:
        margin = 0.5 * abs(start) + 0.02 * extent.speed
        low.append(float(start - margin))
        high.append(float(start + margin))
    most = max(extent.voltage, *(recording.info.max_voltage for recording in recordings))
    return Unknowns(normalised(effects), specs, np.array(low), np.array(high), extent, most, starts != 0.0)
