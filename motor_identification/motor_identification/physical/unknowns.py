"""Add a current's unknowns to those of a motion: resistance, torque constant, and the zero of every sensor."""

from dataclasses import dataclass
from math import isnan, nan

import numpy as np

from motor_identification.estimation.parameter_space import Unknowns
from motor_identification.recording import Floats
from motor_model.effect import ParameterSpec
from motor_model.effects import ELECTRICAL, SPEC_BY_NAME
from motor_model.parameters import Parameters

ELECTRICAL_NAMES = tuple(spec.name for spec in ELECTRICAL)
LAG = ELECTRICAL_NAMES.index("current_lag")


@dataclass(frozen=True)
class ElectricalUnknowns(Unknowns):
    """The unknowns of motion and current: of the specs, the last are electrical."""

    known_lag: float = nan  # [s] by which readings are older than their stamps; NaN: that is an unknown too

    @property
    def electrical(self) -> tuple[ParameterSpec, ...]:
        """The electrical specs."""
        return ELECTRICAL if isnan(self.known_lag) else ELECTRICAL[:LAG]

    def parameters(self, theta: Floats, name: str) -> Parameters:
        """The motor at θ (D,), as the first recording has it, with its resistance and torque constant."""
        values = self.values(theta)
        lumped = {name: value for name, value in values.items() if name in SPEC_BY_NAME}
        physical = {name: values[name] for name in ("resistance", "torque_constant")}
        return Parameters(lumped, self.effects, self.max_voltage, name, gear_ratio=self.gear, **physical)

    def lag_of(self, theta: Floats) -> float:
        """[s] by which readings are older than their stamps, at θ (D,)."""
        if not isnan(self.known_lag):
            return self.known_lag
        column = len(self.specs) - len(ELECTRICAL) + LAG
        return float(np.clip(theta[column], self.low[column], self.high[column]))

    def values(self, theta: Floats) -> dict[str, float]:
        """Every named unknown in its own unit, as the first recording has it."""
        columns = theta[: len(self.specs)]
        known = zip(self.specs, columns, strict=True)
        return {spec.name: float(np.exp(value) if spec.logarithmic else value) for spec, value in known}


def add_electrical_unknowns(
    unknowns: Unknowns, kv: float, most_current: float, known_lag: float = nan, samples: int = 0
) -> ElectricalUnknowns:
    """Add the electrical unknowns, in a box scaled by the largest voltage and current [A] and a fitted kv.

    known_lag: [s] by which readings are older than their stamps. samples: where that is not known, whole sample periods
    that it is at least. The voltage changes at whole ones, so that the current jumps there: the search stays between.
    """
    period = unknowns.extent.sample
    sizes = np.array([unknowns.extent.voltage / most_current, kv, most_current, period])
    low, high = (sizes * [getattr(spec, end) for spec in ELECTRICAL] for end in ("low", "high"))
    low[LAG], high[LAG] = low[LAG] + samples * period, high[LAG] + samples * period
    logarithmic = np.array([spec.logarithmic for spec in ELECTRICAL])
    low[logarithmic], high[logarithmic] = np.log(low[logarithmic]), np.log(high[logarithmic])
    count = len(ELECTRICAL) if isnan(known_lag) else LAG
    return ElectricalUnknowns(
        unknowns.effects,
        (*unknowns.specs, *ELECTRICAL[:count]),
        _insert(unknowns, unknowns.low, low[:count]),
        _insert(unknowns, unknowns.high, high[:count]),
        unknowns.extent,
        unknowns.max_voltage,
        unknowns.turning,
        unknowns.gear,
        known_lag,
    )


def _insert(unknowns: Unknowns, theta: Floats, electrical: Floats) -> Floats:
    """Insert electrical values into a θ (or a bound of it): shared ones after the others, then of each recording."""
    count, own = len(unknowns.specs), sum(spec.of_recording for spec in unknowns.specs)
    parts = [theta[:count], electrical]
    offset = electrical[[spec.of_recording for spec in ELECTRICAL[: len(electrical)]]]
    for r in range(len(unknowns.turning) - 1):
        parts += [theta[count + r * own : count + (r + 1) * own], offset]
    return np.concatenate([*parts, theta[count + (len(unknowns.turning) - 1) * own :]])


def join_theta(unknowns: Unknowns, theta: Floats, electrical: ElectricalUnknowns, values: Floats) -> Floats:
    """Join θ (D,) of a motion and resistance [Ω], torque constant [N·m/A], offset [A] and lag [s]."""
    specs = electrical.electrical
    shown = values[: len(specs)]
    inserted = np.where([spec.logarithmic for spec in specs], np.log(np.maximum(shown, 1e-300)), shown)
    return np.clip(_insert(unknowns, theta, inserted), electrical.low, electrical.high)
