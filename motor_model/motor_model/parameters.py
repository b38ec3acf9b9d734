"""A motor in numbers: which effects it has and the value of each of their parameters."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf, isfinite

import numpy as np
from numpy.typing import NDArray

from motor_model.effects import (
    COARSENESS,
    ELECTRICAL,
    GEAR_RATIO,
    INDEX,
    MAX_VOLTAGE,
    OPEN_PLAY,
    SPEC_BY_NAME,
    SPECS,
    VECTOR_NAMES,
    normalised,
    specs_of,
)
from motor_model.errors import ModelError

PAPER_KV = 12.0 / 174.097  # [V·s/rad] the base paper's coefficient0: 174.097 rad/s at 12 V
PAPER_KA = 0.0055  # [V·s²/rad] its coefficient1 is not published; a time constant of 80 ms is our reference
MOST_BACK_EMF = 1.2  # of kv: a fit may find a torque constant a little above it where there is no viscous friction


@dataclass(frozen=True)
class Parameters:
    """kv, ka and the parameters of `effects`, by name, in the units of the effect table.

    `torque_constant` (in SI units also the back-EMF constant) says which part of kv is back-EMF, the rest is viscous
    friction. With `resistance` the motor has a current. See `physical/`.

    Raises:
        ModelError: an unknown effect, a missing, superfluous or non-physical value.
    """

    values: Mapping[str, float]
    effects: tuple[str, ...] = ()
    max_voltage: float = 12.0
    name: str = field(default="motor", compare=False)
    resistance: float = 0.0  # [Ω] of the cold armature; 0: unknown
    torque_constant: float = 0.0  # [N·m/A]; 0: kv, no viscous friction
    gear_ratio: float = 1.0  # turns of the encoder's shaft per turn of the output, which speed and angle are of

    def __post_init__(self) -> None:
        object.__setattr__(self, "effects", normalised(self.effects))
        names = [spec.name for spec in specs_of(self.effects)]
        missing = [name for name in names if name not in self.values]
        if missing:
            raise ModelError(f"the model lacks {', '.join(missing)}; give each a value.")
        for name in self.values:
            if name not in SPEC_BY_NAME:
                raise ModelError(f"'{name}' is not a parameter of any effect; this model's are {', '.join(names)}.")
            if name not in names:
                raise ModelError(f"'{name}' is given, but its effect is not listed: add the effect or drop the value.")
        object.__setattr__(self, "values", {name: float(self.values[name]) for name in names})
        self._check_physics()

    def _check_physics(self) -> None:
        for name, value in self.values.items():
            spec = SPEC_BY_NAME[name]
            if not isfinite(value):
                raise ModelError(f"{name} = {value:g} {spec.unit} must be a finite number.")
            if not spec.minimum <= value <= spec.maximum:
                limits = (
                    f"{spec.minimum:g} to {spec.maximum:g}" if isfinite(spec.maximum) else f"at least {spec.minimum:g}"
                )
                raise ModelError(f"{name} = {value:g} {spec.unit} is not physical: it must be {limits}.")
            if spec.at_least is not None and value < self.values[spec.at_least]:
                least = f"{self.values[spec.at_least]:g} {spec.unit}"
                raise ModelError(f"{name} must be at least {spec.at_least}: it is {value:g}, and that is {least}.")
        if self.values["kv"] <= 0.0 or self.values["ka"] <= 0.0:
            raise ModelError("kv and ka must be positive: a motor with neither back-EMF nor inertia is none.")
        if not np.isfinite(self.max_voltage) or self.max_voltage <= 0.0:
            raise ModelError(f"max_voltage = {self.max_voltage:g} V must be positive.")
        if not 0.0 <= self.resistance < inf:
            raise ModelError(f"resistance = {self.resistance:g} Ω must be 0 (unknown) or more.")
        most = MOST_BACK_EMF * self.values["kv"]
        if not 0.0 <= self.torque_constant <= most:
            raise ModelError(
                f"torque_constant = {self.torque_constant:g} N·m/A must be 0 (unknown) to kv, the back-EMF with all "
                f"viscous friction: {self.values['kv']:g} V·s/rad."
            )
        if not np.isfinite(self.gear_ratio) or self.gear_ratio <= 0.0:
            raise ModelError(f"gear_ratio = {self.gear_ratio:g} must be positive.")

    def value(self, name: str) -> float:
        """The parameter's value, or the value that makes its effect vanish if this motor does not have it."""
        return self.values.get(name, SPEC_BY_NAME[name].off)

    @property
    def viscous_share(self) -> float:
        """Share of kv that is viscous friction; 0 where it is not known."""
        return 1.0 - self.torque_constant / self.values["kv"] if self.torque_constant > 0.0 else 0.0

    def vector(self) -> NDArray[np.float64]:
        """Every parameter of the table in its order, then max_voltage: what the compiled code takes. Shape (P,)."""
        vector = neutral(self.max_voltage, gear_ratio=self.gear_ratio)
        for name, value in self.values.items():
            vector[INDEX[name]] = value
        for spec in ELECTRICAL:
            vector[INDEX[spec.name]] = getattr(self, spec.name, spec.off)
        return vector

    @property
    def gain(self) -> float:
        """[rad/s/V] steady speed per volt without friction."""
        return 1.0 / self.values["kv"]

    @property
    def time_constant(self) -> float:
        """[s] mechanical time constant ka/kv."""
        return self.values["ka"] / self.values["kv"]


def neutral(max_voltage: float, coarseness: float = 1.0, gear_ratio: float = 1.0) -> NDArray[np.float64]:
    """Return a vector with every effect off; kv and ka are yet to be set. Shape (P,)."""
    vector = np.empty(len(VECTOR_NAMES))
    for spec in (*SPECS, *ELECTRICAL):
        vector[INDEX[spec.name]] = spec.off
    vector[INDEX[MAX_VOLTAGE]], vector[INDEX[COARSENESS]] = max_voltage, coarseness
    vector[INDEX[GEAR_RATIO]], vector[INDEX[OPEN_PLAY]] = gear_ratio, 0.0
    return vector


def paper_motor() -> Parameters:
    """Return the base paper's motor."""
    return Parameters({"kv": PAPER_KV, "ka": PAPER_KA}, name="paper")
