"""The plant's parameters: names of the effect table, and of physics that no table knows, as one record of floats."""

from collections.abc import Mapping
from math import inf, isfinite
from pathlib import Path
from typing import Any
from zlib import crc32

import numpy as np

from motor_model.errors import ModelError

Values = Mapping[str, float]

# name -> value at which the effect is off; names and units are those of interfaces.md
TABLE: dict[str, float] = {
    "kv": 0.0,
    "ka": 0.0,
    "ks": 0.0,
    "breakaway_voltage": 0.0,
    "stribeck_speed": 0.0,
    "drag": 0.0,
    "bias_voltage": 0.0,
    "step_voltage": 0.0,
    "step_time": 0.0,
    "dead_zone_voltage": 0.0,
    "limit_voltage": inf,
    "reverse_gain": 1.0,
    "coast_share": 0.0,
    "sag": 0.0,
    "electrical_time_constant": 0.0,
    "delay": 0.0,
    "ripple_voltage": 0.0,
    "ripple_cycles": 0.0,
    "ripple_phase": 0.0,
    "eccentricity": 0.0,
    "eccentricity_phase": 0.0,
    "backlash_angle": 0.0,
    "load_fraction": 0.0,
    "resistance_rise": 0.0,
    "warm_up_time": 0.0,
    "miss_rate": 0.0,
    "max_voltage": 12.0,
}

# Physics that the table does not have; no candidate effect should be able to explain one away.
BEYOND_THE_TABLE: dict[str, float] = {
    "angle_friction": 0.0,  # [V] a bent shaft: angle_friction*(1 + sin(angle))/2 more dry friction
    "load_friction": 0.0,  # [-] gear teeth: load_friction*|drive| more dry friction
    "presliding_angle": 0.0,  # [rad] dry friction builds up over this angle after a reversal (Dahl), nothing sticks
    "compliance_fraction": 0.0,  # [-] this share of ka hangs on a torsion spring
    "compliance_stiffness": 0.0,  # [V/rad] of that spring
    "compliance_damping": 0.0,  # [V*s/rad] beside that spring
    "supply_ripple": 0.0,  # [-] u_eff breathes by this share ...
    "supply_ripple_frequency": 0.0,  # [Hz] ... as a sine from the recording's start
    "slew_rate": 0.0,  # [V/s] the bridge follows the command no faster than this; 0: at once
    "speed_wave": 0.0,  # [V] a load speed_wave*sin(speed/speed_wave_scale): resonances, fans, seals
    "speed_wave_scale": 1.0,  # [rad/s]
    "current_limit_voltage": inf,  # [V] the bridge limits the current: |drive| goes no further
    "load_wave": 0.0,  # [V] a load periodic in time ...
    "load_wave_frequency": 0.0,  # [Hz] ... as a sine from the recording's start
}

# A torque that no model can predict; not an effect, but what every real motor has beside its effects.
DISTURBANCE: dict[str, float] = {
    "random_torque": 0.0,  # [V] RMS of an Ornstein-Uhlenbeck load
    "random_torque_time": 0.05,  # [s] its correlation time
    "random_torque_seed": 0.0,
}

# What a current sensor sees of the motor; with a resistance the board measures a current.
ELECTRIC: dict[str, float] = {
    "resistance": 0.0,  # [ohm] of the cold armature; 0: no current is measured
    "torque_constant": 0.0,  # [V*s/rad] back-EMF alone, the rest of kv is viscous friction; 0: all of kv
}

_DEFAULTS = TABLE | BEYOND_THE_TABLE | DISTURBANCE | ELECTRIC
# Numba's cache looks at the file of a function only, not at the files of what it calls: an edited forces.py would
# leave the old forces in motor.py's cache. A field named after its contents gives every version a type of its own.
_VERSION = f"forces_{crc32(Path(__file__).with_name('forces.py').read_bytes()):08x}"
_DTYPE = np.dtype([(name, np.float64) for name in (*_DEFAULTS, _VERSION)])
# name -> (lowest, highest) value that is still physics; signed where it is not here
_RANGES = {
    "max_voltage": (1e-9, inf),
    "coast_share": (0.0, 1.0),
    "load_fraction": (0.0, 0.999),
    "compliance_fraction": (0.0, 0.999),
    "miss_rate": (0.0, 0.999),
    "load_friction": (0.0, 0.9),
    "eccentricity": (-0.5, 0.5),  # beyond 1 the disc would turn backwards
    "resistance_rise": (-0.9, inf),
} | dict.fromkeys(
    (
        *("kv", "ka", "ks", "breakaway_voltage", "stribeck_speed", "drag", "dead_zone_voltage", "limit_voltage"),
        *("reverse_gain", "sag", "electrical_time_constant", "delay", "backlash_angle", "warm_up_time"),
        *("angle_friction", "presliding_angle", "compliance_stiffness", "compliance_damping", "slew_rate"),
        *("resistance", "torque_constant"),
        *("current_limit_voltage", "random_torque", "random_torque_time", "random_torque_seed"),
    ),
    (0.0, inf),
)


def record_of(parameters: Values) -> Any:
    """Every parameter as one NumPy record, those that are absent at the value that switches their effect off.

    Raises:
        ModelError: an unknown name, a value that is not a number, or one that describes no motor.
    """
    unknown = sorted(set(parameters) - set(_DEFAULTS))
    if unknown:
        raise ModelError(f"The plant has no parameter {', '.join(unknown)}; it knows {', '.join(_DEFAULTS)}.")
    values = _DEFAULTS | dict(parameters)
    values["breakaway_voltage"] = parameters.get("breakaway_voltage", values["ks"])
    for name, value in parameters.items():
        low, high = _RANGES.get(name, (-inf, inf))
        if not isfinite(value) or not low <= value <= high:
            raise ModelError(f"{name} is {value}: give the plant a number from {low:g} to {high:g}.")
    if values["ka"] <= 0.0:
        raise ModelError("The plant needs ka > 0: a motor without inertia has no equation of motion.")
    if values["breakaway_voltage"] < values["ks"]:
        raise ModelError("breakaway_voltage is below ks: static friction is at least the sliding one.")
    record = np.zeros(1, dtype=_DTYPE)
    for name, value in values.items():
        record[name] = value
    return record[0]
