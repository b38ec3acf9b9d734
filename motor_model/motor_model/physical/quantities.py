"""A motor in ohms, newton-metres and kilograms: what the lumped gains are made of.

    u = R·i + L·di/dt + K·ω,    J·dω/dt = K·i − b·ω − friction − loads,    K = Kt [N·m/A] = Ke [V·s/rad]

so that in the armature voltages of `effects.py`

    kv = K + R·b/K,    ka = R·J/K,    a torque T is R·T/K,    electrical time constant = L/R.

Voltage and motion alone give the left sides; a measured current, or a known R, gives the right ones.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from motor_model.parameters import Parameters


@dataclass(frozen=True, slots=True)
class PhysicalSpec:
    """One physical quantity: its unit, and the lumped parameter that it belongs to (empty: every motor has it)."""

    name: str
    unit: str
    lumped: str = ""


# A lumped voltage is a torque, a voltage per speed squared a torque per speed squared: times K/R.
TORQUES = (
    PhysicalSpec("inertia", "kg·m²", "ka"),
    PhysicalSpec("friction_torque", "N·m", "ks"),
    PhysicalSpec("breakaway_torque", "N·m", "breakaway_voltage"),
    PhysicalSpec("drag_torque", "N·m·s²/rad²", "drag"),
    PhysicalSpec("load_torque", "N·m", "bias_voltage"),
    PhysicalSpec("step_torque", "N·m", "step_voltage"),
    PhysicalSpec("ripple_torque", "N·m", "ripple_voltage"),
)
RESISTANCE = PhysicalSpec("resistance", "Ω")
CONSTANT = PhysicalSpec("torque_constant", "N·m/A")
VISCOUS = PhysicalSpec("viscous_friction", "N·m·s/rad")
INDUCTANCE = PhysicalSpec("inductance", "H", "electrical_time_constant")
WARM = PhysicalSpec("warm_resistance", "Ω", "resistance_rise")
PHYSICAL_SPECS = (RESISTANCE, WARM, INDUCTANCE, CONSTANT, VISCOUS, *TORQUES)
PHYSICAL_BY_NAME = {spec.name: spec for spec in PHYSICAL_SPECS}


def physical_values(values: Mapping[str, float], resistance: float, torque_constant: float) -> dict[str, float]:
    """Convert lumped parameters by name to physical quantities by name, in the order of PHYSICAL_SPECS.

    resistance: [Ω] of the cold armature. torque_constant: [N·m/A] at most kv.
    """
    per_volt = torque_constant / resistance
    found = {
        RESISTANCE.name: resistance,
        CONSTANT.name: torque_constant,
        VISCOUS.name: (values["kv"] - torque_constant) * per_volt,
    }
    if INDUCTANCE.lumped in values:
        found[INDUCTANCE.name] = values[INDUCTANCE.lumped] * resistance
    if WARM.lumped in values:
        found[WARM.name] = resistance * (1.0 + values[WARM.lumped])
    found |= {spec.name: values[spec.lumped] * per_volt for spec in TORQUES if spec.lumped in values}
    return {spec.name: found[spec.name] for spec in PHYSICAL_SPECS if spec.name in found}


def lumped_values(physical: Mapping[str, float]) -> dict[str, float]:
    """Convert physical quantities by name (`resistance`, `torque_constant`, …) to lumped parameters by name."""
    resistance, constant = physical[RESISTANCE.name], physical[CONSTANT.name]
    found = {spec.lumped: physical[spec.name] * resistance / constant for spec in TORQUES if spec.name in physical}
    found["kv"] = constant + resistance * physical.get(VISCOUS.name, 0.0) / constant
    if INDUCTANCE.name in physical:
        found[INDUCTANCE.lumped] = physical[INDUCTANCE.name] / resistance
    if WARM.name in physical:
        found[WARM.lumped] = physical[WARM.name] / resistance - 1.0
    return found


def physical_values_of(parameters: Parameters) -> dict[str, float]:
    """Convert a motor; of one whose resistance is not known, the torque constant where that is."""
    if parameters.resistance == 0.0:
        return {CONSTANT.name: parameters.torque_constant} if parameters.torque_constant > 0.0 else {}
    constant = parameters.torque_constant or parameters.values["kv"]
    return physical_values(parameters.values, parameters.resistance, constant)
