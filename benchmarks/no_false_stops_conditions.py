"""What real benches have and the plain motors of `no_false_stops.py` do not: each is put on one of those motors."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import exp, pi, sin, sqrt

import numpy as np

from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig

SAG = 1.0 / 0.85 - 1.0  # 15 % less at full voltage
EVERY = 0.02  # [s] between two references of a ramp


@dataclass(frozen=True)
class Setup:
    """One random motor with its encoder, loop and references."""

    plant: Parameters
    model: Parameters | None
    board: BoardConfig
    values: dict[str, object]
    references: list[tuple[float, float]]  # [s] from when, [rad/s]
    torque: float = 0.0  # [V] RMS of a random one
    torque_time: float = 0.05  # [s] its correlation time


@dataclass
class RandomTorque:
    """An Ornstein-Uhlenbeck torque, sample by sample."""

    rms: float  # [V]
    share: float  # of itself that is left a sample later
    random: np.random.Generator
    value: float = 0.0  # [V]

    def next(self) -> float:
        """[V] at the next sample."""
        fresh = float(self.random.standard_normal()) if self.rms else 0.0
        self.value = self.share * self.value + self.rms * sqrt(1.0 - self.share**2) * fresh
        return self.value


def random_torque(setup: Setup, seed: int, rate: float) -> RandomTorque:
    """The random torque of a setup."""
    return RandomTorque(setup.torque, exp(-1.0 / (rate * setup.torque_time)), np.random.default_rng([seed, 7]))


Change = Callable[[Setup, np.random.Generator], Setup]


def shake(share: float) -> Change:
    """A random torque of this share of the supply, RMS."""

    def change(setup: Setup, rng: np.random.Generator) -> Setup:
        time = float(np.exp(rng.uniform(np.log(0.01), np.log(0.3))))
        return replace(setup, torque=share * setup.plant.max_voltage, torque_time=time)

    return change


def mistake_model(setup: Setup, rng: np.random.Generator) -> Setup:
    """Kv is 10 % off, ka 20 %, friction 30 %, each up or down."""
    if setup.model is None:
        return setup
    off = {name: 1.0 + by * float(rng.choice([-1.0, 1.0])) for name, by in (("kv", 0.1), ("ka", 0.2), ("ks", 0.3))}
    values = {name: setup.plant.value(name) * factor for name, factor in off.items()}
    return replace(setup, model=Parameters(values, ("coulomb_friction",), setup.plant.max_voltage))


def add_effect(setup: Setup, effect: str, **values: float) -> Setup:
    """Give the plant one more effect."""
    plant = setup.plant
    return replace(
        setup, plant=Parameters(plant.values | values, (*plant.effects, effect), plant.max_voltage, plant.name)
    )


def warm(setup: Setup, rng: np.random.Generator) -> Setup:
    """Its copper warms up by 30 % of its resistance, to the friction and loads that were drawn."""
    cold = {name: setup.plant.value(name) / 1.3 for name in ("ks", "breakaway_voltage", "bias_voltage", "step_voltage")}
    setup = replace(setup, plant=replace(setup.plant, values=setup.plant.values | cold))
    return add_effect(setup, "warm_up", resistance_rise=0.3, warm_up_time=float(rng.uniform(1.0, 20.0)))


def sag(setup: Setup, rng: np.random.Generator) -> Setup:
    """The supply sags by 15 %."""
    return add_effect(setup, "supply_sag", sag=SAG)


def loosen(setup: Setup, rng: np.random.Generator) -> Setup:
    """Backlash of up to ten slots before 30 to 70 % of the inertia."""
    slots = float(rng.uniform(1.0, 10.0))
    angle = slots * 2.0 * pi / setup.board.edges_per_revolution
    return add_effect(setup, "backlash", backlash_angle=angle, load_fraction=float(rng.uniform(0.3, 0.7)))


def spoil_disc(setup: Setup, rng: np.random.Generator) -> Setup:
    """Slots that are irregular by 5 %."""
    return replace(setup, board=replace(setup.board, slot_irregularity=0.05))


def ramp(setup: Setup, rng: np.random.Generator) -> Setup:
    """From reference to reference by a ramp or half a sine, of which every 20 ms are sent."""
    references, before = [], 0.0
    for (begin, speed), (end, _) in zip(setup.references, [*setup.references[1:], (np.inf, 0.0)], strict=True):
        length, smooth = float(rng.uniform(0.1, 2.0)), bool(rng.integers(2))
        for k in range(1, round(min(length, end - begin) / EVERY) + 1):
            share = k * EVERY / length
            share = 0.5 - 0.5 * sin(pi * (0.5 - share)) if smooth else share
            references.append((begin + k * EVERY, before + share * (speed - before)))
        before = references[-1][1] if references else speed
    return replace(setup, references=references or setup.references)


CONDITIONS: dict[str, tuple[Change, ...]] = {
    "none": (),
    "random torque, 1.25 % of the supply RMS": (shake(0.0125),),
    "random torque, 2.5 %": (shake(0.025),),
    "random torque, 5 %": (shake(0.05),),
    "kv 10 %, ka 20 %, friction 30 % off": (mistake_model,),
    "30 % warmer": (warm,),
    "supply sags by 15 %": (sag,),
    "backlash of 1 to 10 slots": (loosen,),
    "slots irregular by 5 %": (spoil_disc,),
    "ramps": (ramp,),
    "all of these, torque 2.5 %": (shake(0.025), mistake_model, warm, sag, loosen, spoil_disc, ramp),
}
NAMES = tuple(CONDITIONS)


def put(name: str, setup: Setup, seed: int) -> Setup:
    """Put a condition on a setup."""
    rng = np.random.default_rng([seed, 11])
    for change in CONDITIONS[name]:
        setup = change(setup, rng)
    return setup
