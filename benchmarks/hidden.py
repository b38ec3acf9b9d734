"""Motors in which something is hidden, and what the diagnosis makes of them.

Random gain, time constant, disc (0 to 1 % irregular) and size of the effect, run by the tests' independent plant; the
training recording is the plant's `rich`, the validation another start, other random voltages and another load-step
time.
"""

import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter, process_time
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy: small matrices
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))

import numpy as np
from plant import profiles, record

from motor_identification.diagnose import diagnose
from motor_identification.recording import Recording, check
from motor_model.effects import normalised
from motor_model.parameters import PAPER_KA, PAPER_KV

# Sizes that are drawn from, in the units of the table.
SIZES: dict[str, dict[str, tuple[float, float]]] = {
    "coulomb_friction": {"ks": (0.1, 0.8)},
    "static_friction": {"ks": (0.2, 0.5), "breakaway_voltage": (0.7, 1.2), "stribeck_speed": (2.0, 8.0)},
    "quadratic_drag": {"drag": (2e-5, 1e-4)},
    "load_bias": {"bias_voltage": (0.1, 0.6)},
    "load_step": {"step_voltage": (0.2, 0.6), "step_time": (8.0, 25.0)},
    "dead_zone": {"dead_zone_voltage": (0.2, 0.8)},
    "voltage_limit": {"limit_voltage": (8.0, 11.0)},
    "direction_asymmetry": {"reverse_gain": (0.88, 0.96)},
    "coast_drive": {"coast_share": (0.2, 0.8)},
    "supply_sag": {"sag": (0.04, 0.2)},
    "armature_inductance": {"electrical_time_constant": (0.001, 0.006)},
    "transport_delay": {"delay": (0.002, 0.015)},
    "torque_ripple": {"ripple_voltage": (0.15, 0.4), "ripple_cycles": (3.0, 12.0), "ripple_phase": (-3.0, 3.0)},
    "encoder_eccentricity": {"eccentricity": (0.01, 0.05), "eccentricity_phase": (-3.0, 3.0)},
    "backlash": {"backlash_angle": (0.1, 0.5), "load_fraction": (0.3, 0.7)},
    "warm_up": {"resistance_rise": (0.1, 0.3), "warm_up_time": (6.0, 20.0)},
    "missed_edges": {"miss_rate": (0.001, 0.01)},
}
OUTSIDE: dict[str, dict[str, tuple[float, float]]] = {
    "angle_friction": {"ks": (0.3, 0.5), "angle_friction": (0.4, 0.8)},
    "load_friction": {"load_friction": (0.08, 0.15)},
    "presliding": {"ks": (0.3, 0.6), "presliding_angle": (0.2, 0.5)},
    "compliance": {
        "compliance_fraction": (0.3, 0.5),
        "compliance_stiffness": (1.0, 2.0),
        "compliance_damping": (0.005, 0.02),
    },
    "supply_ripple": {"supply_ripple": (0.04, 0.08), "supply_ripple_frequency": (1.0, 4.0)},
    "slew_rate": {"slew_rate": (100.0, 250.0)},
}
FRICTION = "coulomb_friction"
PAIRS = [
    *((FRICTION, other) for other in (
        "transport_delay", "quadratic_drag", "torque_ripple", "voltage_limit", "load_bias", "direction_asymmetry",
        "supply_sag", "dead_zone",
    )),
    ("dead_zone", "armature_inductance"),
    ("transport_delay", "quadratic_drag"),
]  # fmt: skip
BESIDE = [("transport_delay", "compliance"), ("load_bias", "slew_rate"), ("dead_zone", "supply_ripple")]


@dataclass(frozen=True)
class Hidden:
    """A motor in which something is hidden, and what was recorded of it."""

    values: dict[str, float]
    training: Recording  # 28 s
    validation: Recording  # 14 s


@dataclass(frozen=True)
class Outcome:
    """One diagnosis of a hidden truth."""

    verdict: str
    named: tuple[str, ...]
    errors: tuple[float, ...]  # relative, of named parameters
    trusted: tuple[bool, ...]  # within 5 % or 3 standard errors
    gap: float  # after, times the noise floor
    seconds: float


@dataclass(frozen=True)
class Found:
    """What one diagnosis made of a motor beside a torque."""

    verdict: str
    named: tuple[str, ...]
    gap: float  # after, times the noise floor
    strength: float  # of the torque, found over true; NaN where there or found is none
    seconds: float  # of CPU time
    variable: str = ""  # over which most of what is left can be predicted


@dataclass(frozen=True)
class Torque:
    """A random torque beside the motor, another course of it in every recording."""

    rms: float  # [V]
    time: float  # [s] over which it is correlated

    def values(self, seed: int) -> dict[str, float]:
        """As the plant has them."""
        return {"random_torque": self.rms, "random_torque_time": self.time, "random_torque_seed": float(seed)}


QUIET = Torque(0.0, 1.0)


def generator(hidden: tuple[str, ...], seed: int) -> np.random.Generator:
    """Make the generator that a motor with this in it is drawn by."""
    return np.random.default_rng([seed, len(hidden), *map(ord, "".join(hidden))])


def drawn(hidden: tuple[str, ...], random: np.random.Generator) -> dict[str, float]:
    """Draw a motor and the sizes of what is hidden in it."""
    values = {"kv": PAPER_KV * random.uniform(0.7, 1.4), "ka": PAPER_KA * random.uniform(0.6, 1.5)}
    for name in hidden:
        for parameter, bounds in (SIZES | OUTSIDE)[name].items():
            values[parameter] = float(random.uniform(*bounds))
    return values


def recorded(
    hidden: tuple[str, ...], seed: int, sizes: dict[str, float] | None = None, torque: Torque = QUIET
) -> Hidden:
    """Hide it in a random motor; `sizes` are given, all others drawn."""
    random = generator(hidden, seed)
    values = drawn(hidden, random) | (sizes or {})
    share, disc = float(random.uniform(0.0, 0.01)), int(random.integers(1000))
    later = values | ({"step_time": float(random.uniform(3.0, 8.0))} if "step_time" in values else {})
    drives = profiles.rich(12.0, seed), profiles.random(12.0, 14.0, seed + 500)
    pair = record_pair((values, later), drives, seed, torque, irregularity=share, disc_seed=disc)
    return Hidden(values, *pair)


def record_pair(
    motors: Sequence[dict[str, float]], drives: Sequence[profiles.Profile], seed: int, torque: Torque, **how: Any
) -> tuple[Recording, Recording]:
    """Record a motor for training and, another time and beside another course of the torque, for validation."""
    first, second = (
        check(record(values | torque.values(start), *drive, seed=start, **how)[0])
        for values, drive, start in zip(motors, drives, (seed, seed + 77), strict=True)
    )
    return first, second


def find(training: Recording, validation: Recording, torque: float) -> Found:
    """Diagnose a motor beside a torque of so many volts RMS."""
    begun = process_time()
    found = diagnose([training], [validation])
    return Found(
        verdict=found.verdict.value,
        named=tuple(finding.effect for finding in found.findings),
        gap=found.gap_after / found.noise_floor if found.noise_floor > 0.0 else float("nan"),
        strength=found.disturbance.rms_voltage / torque if found.disturbance and torque else float("nan"),
        seconds=process_time() - begun,
        variable=found.structure[0].variable if found.structure else "",
    )


def one(hidden: tuple[str, ...], seed: int, sizes: dict[str, float] | None = None, torque: Torque = QUIET) -> Outcome:
    """Hide it in a random motor and diagnose; `sizes` are given, all others drawn."""
    made = recorded(hidden, seed, sizes, torque)
    values = made.values
    begun = perf_counter()
    found = diagnose([made.training], [made.validation])
    seconds = perf_counter() - begun
    errors, trusted = [], []
    for finding in found.findings:
        for parameter, (value, sigma) in finding.parameters.items():
            if parameter in values and not parameter.endswith(("_phase", "step_time")):
                errors.append(value / values[parameter] - 1.0)
                trusted.append(abs(errors[-1]) < 0.05 or abs(value - values[parameter]) < 3.0 * sigma)
    return Outcome(
        found.verdict.value,
        tuple(finding.effect for finding in found.findings),
        tuple(errors),
        tuple(trusted),
        found.gap_after / found.noise_floor if found.noise_floor > 0.0 else float("nan"),
        seconds,
    )


def right(hidden: tuple[str, ...], outcome: Outcome | Found) -> bool:
    """Whether an outcome is what the truth deserves: the right names and no other.

    What is outside the table counts if the verdict is "unexplained" and no name is wrong.
    """
    table = {name for name in hidden if name in SIZES}
    outside = [name for name in hidden if name in OUTSIDE]
    expected = set(normalised(tuple(table)))
    if not outside:
        return set(outcome.named) == expected and outcome.verdict in ("explained", "nothing_missing")
    if any("ks" in OUTSIDE[name] for name in outside):
        expected |= {FRICTION}
    return outcome.verdict == "unexplained" and set(outcome.named) <= expected


def wrong(hidden: tuple[str, ...], named: Sequence[str]) -> bool:
    """Whether a name is not there; friction is the even part of what is outside the table."""
    return bool(set(named) - set(hidden) - {FRICTION})
