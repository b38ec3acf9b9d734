"""Add a current's unknowns to those of a motion: resistance, torque constant, and the zero of every sensor."""

import numpy as np

from motor_identification.estimation.parameter_space import Unknowns
from motor_identification.recording import Floats
from motor_model.effects import ELECTRICAL, SPEC_BY_NAME
from motor_model.parameters import Parameters

ELECTRICAL_NAMES = tuple(spec.name for spec in ELECTRICAL)


class ElectricalUnknowns(Unknowns):
    """The unknowns of motion and current: of the specs, the last are electrical."""

    def parameters(self, theta: Floats, name: str) -> Parameters:
        """The motor at θ (D,), as the first recording has it, with its resistance and torque constant."""
        values = self.values(theta)
        lumped = {name: value for name, value in values.items() if name in SPEC_BY_NAME}
        physical = {name: values[name] for name in ("resistance", "torque_constant")}
        return Parameters(lumped, self.effects, self.max_voltage, name, **physical)

    def values(self, theta: Floats) -> dict[str, float]:
        """Every named unknown in its own unit, as the first recording has it."""
        columns = theta[: len(self.specs)]
        known = zip(self.specs, columns, strict=True)
        return {spec.name: float(np.exp(value) if spec.logarithmic else value) for spec, value in known}


def add_electrical_unknowns(unknowns: Unknowns, kv: float, most_current: float) -> ElectricalUnknowns:
    """Add the electrical unknowns, in a box scaled by the largest voltage and current [A] and a fitted kv."""
    sizes = (unknowns.extent.voltage / most_current, kv, most_current)
    low = np.array([spec.low * size for spec, size in zip(ELECTRICAL, sizes, strict=True)])
    high = np.array([spec.high * size for spec, size in zip(ELECTRICAL, sizes, strict=True)])
    logarithmic = np.array([spec.logarithmic for spec in ELECTRICAL])
    low[logarithmic], high[logarithmic] = np.log(low[logarithmic]), np.log(high[logarithmic])
    specs = (*unknowns.specs, *ELECTRICAL)
    return ElectricalUnknowns(
        unknowns.effects,
        specs,
        _insert(unknowns, unknowns.low, low),
        _insert(unknowns, unknowns.high, high),
        unknowns.extent,
        unknowns.max_voltage,
        unknowns.turning,
    )


def _insert(unknowns: Unknowns, theta: Floats, electrical: Floats) -> Floats:
    """Insert electrical values into a θ (or a bound of it): shared ones after the others, then of each recording."""
    count, own = len(unknowns.specs), sum(spec.of_recording for spec in unknowns.specs)
    parts = [theta[:count], electrical]
    offset = electrical[[spec.of_recording for spec in ELECTRICAL]]
    for r in range(len(unknowns.turning) - 1):
        parts += [theta[count + r * own : count + (r + 1) * own], offset]
    return np.concatenate([*parts, theta[count + (len(unknowns.turning) - 1) * own :]])


def join_theta(unknowns: Unknowns, theta: Floats, electrical: ElectricalUnknowns, values: Floats) -> Floats:
    """Join θ (D,) of a motion and resistance [Ω], torque constant [N·m/A] and offset [A] of all sensors."""
    inserted = np.where([spec.logarithmic for spec in ELECTRICAL], np.log(np.maximum(values, 1e-300)), values)
    return np.clip(_insert(unknowns, theta, inserted), electrical.low, electrical.high)
