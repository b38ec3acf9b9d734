"""Draw motors of any size with something hidden in them, and record them on boards of any kind."""

from dataclasses import dataclass

import numpy as np
from hidden import OUTSIDE, PAIRS, QUIET, SIZES, Torque, record_pair
from numpy.typing import NDArray
from plant import profiles
from plant.recording import RECORDED_STEP

from motor_identification.recording import Recording

RATES = (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)  # [Hz]
EDGES = (6, 8, 12, 20, 48, 96, 200, 500, 1000, 2048, 2880, 8192)
USUAL = np.array([12.0, 174.0, 0.1])  # [V], [rad/s], [s] of the motor that the confusion table's sizes are made for
FASTEST = 40_000.0  # [1/s] edges that a timer's capture keeps up with
MOST_EDGES = 5_000.0  # in a time constant at top speed: half a million of a recording
SAMPLES = 100.0  # of a time constant at most: 28,000 of a recording
COARSE_STEP = 1e-3  # [s] of the plant, at most; where edges come so fast the recorded motor's,
FAST_EDGES = 1e4  # [rad/s] top speed times edges: one in 0.6 ms
# How a size grows with [V], [rad/s] and [s] of the motor; what is not here is a share.
GROWTH: dict[str, tuple[float, float, float]] = {
    **dict.fromkeys(
        ("ks", "breakaway_voltage", "bias_voltage", "step_voltage", "dead_zone_voltage", "limit_voltage",
         "ripple_voltage", "angle_friction"),
        (1.0, 0.0, 0.0),
    ),
    **dict.fromkeys(("stribeck_speed",), (0.0, 1.0, 0.0)),
    "drag": (1.0, -2.0, 0.0),
    **dict.fromkeys(("step_time", "electrical_time_constant", "delay", "warm_up_time"), (0.0, 0.0, 1.0)),
    **dict.fromkeys(("backlash_angle", "presliding_angle"), (0.0, 1.0, 1.0)),
    "ripple_cycles": (0.0, -1.0, -1.0),
    "compliance_stiffness": (1.0, -1.0, -1.0),
    "compliance_damping": (1.0, -1.0, 0.0),
    "supply_ripple_frequency": (0.0, 0.0, -1.0),
    "slew_rate": (1.0, 0.0, -1.0),
}  # fmt: skip


@dataclass(frozen=True)
class Case:
    """A motor, what is in it, and its board."""

    seed: int
    hidden: tuple[str, ...]
    values: dict[str, float]  # of the plant, without the torque
    supply: float  # [V]
    top: float  # [rad/s]
    lag: float  # [s] the time constant
    edges: int
    single_channel: bool
    rate: float  # [Hz]
    irregularity: float  # of the disc, a share of a slot
    torque: float  # RMS, a share of the supply
    correlation: float  # [s] of the torque

    def describe(self) -> str:
        """Say what it is in half a line."""
        motor = f"{self.supply:.3g} V, {self.top:.3g} rad/s, {1e3 * self.lag:.3g} ms"
        board = f"{self.edges} edges{'' if self.single_channel else ' both ways'}, {self.rate:g} Hz"
        return f"{motor}; {board}; torque {100.0 * self.torque:.1f} %"


def _between(random: np.random.Generator, low: float, high: float) -> float:
    """Uniform in the logarithm."""
    return float(low * (high / low) ** random.uniform())


def _hidden(random: np.random.Generator) -> tuple[str, ...]:
    """Nothing in one of eight, outside the table in one of eight, a pair in two, one effect in four."""
    match random.integers(8):
        case 0:
            return ()
        case 1:
            return (str(random.choice(list(OUTSIDE))),)
        case 2 | 3:
            return PAIRS[random.integers(len(PAIRS))]
        case _:
            return (str(random.choice(list(SIZES))),)


def _sizes(random: np.random.Generator, hidden: tuple[str, ...], ratio: NDArray[np.float64]) -> dict[str, float]:
    """Draw the sizes of effects for a motor of so many times the usual [V], [rad/s] and [s]."""
    return {
        parameter: float(random.uniform(*bounds) * np.prod(ratio ** np.array(GROWTH.get(parameter, (0.0, 0.0, 0.0)))))
        for name in hidden
        for parameter, bounds in (SIZES | OUTSIDE)[name].items()
    }


def draw(seed: int) -> Case:
    """Draw a case; the board reads the motor 3 to 100 times a time constant and sees ten edges in one at top speed."""
    random = np.random.default_rng([19, seed])
    supply, lag = _between(random, 1.2, 48.0), _between(random, 0.005, 2.0)
    rate = float(random.choice([rate for rate in RATES if min(3.0, RATES[-1] * lag) <= rate * lag <= SAMPLES]))
    while True:
        top, edges = _between(random, 3.0, 6000.0), int(random.choice(EDGES))
        turns = top * lag / (2.0 * np.pi)  # in a time constant at top speed
        if 10.0 <= turns * edges <= MOST_EDGES and turns * edges <= FASTEST * lag:
            break
    kv = supply / top
    values = {"kv": kv, "ka": kv * lag * random.uniform(0.8, 1.2), "max_voltage": supply}
    while True:
        hidden = _hidden(random)
        sizes = _sizes(random, hidden, np.array([supply, top, lag]) / USUAL)
        if 1.0 <= sizes.get("ripple_cycles", 1.0) <= edges / 3.0:  # a wave that motors have, and that the encoder sees
            break
    values |= sizes
    torque = float(random.choice([0.0, 0.0025, 0.008, 0.015]))
    correlation = lag * _between(random, 0.05, 2.0) if torque else QUIET.time
    return Case(
        seed=seed,
        hidden=hidden,
        values=values,
        supply=supply,
        top=top,
        lag=lag,
        edges=edges,
        single_channel=bool(random.integers(2)),
        rate=rate,
        irregularity=float(random.uniform(0.0, 0.01)),
        torque=torque,
        correlation=correlation,
    )


def recorded(case: Case) -> tuple[Recording, Recording]:
    """Record a motor twice, with commands as slow as it is."""
    slower = case.lag / USUAL[2]
    drives = profiles.rich(case.supply, case.seed), profiles.random(case.supply, 14.0, case.seed + 500)
    longest = RECORDED_STEP if case.edges * case.top > FAST_EDGES else COARSE_STEP
    return record_pair(
        (case.values, case.values | _later(case, slower)),
        [(time * slower, volts) for time, volts in drives],
        case.seed,
        Torque(case.torque * case.supply, case.correlation),
        sample_rate=case.rate,
        edges=case.edges,
        irregularity=case.irregularity,
        disc_seed=case.seed,
        single_channel=case.single_channel,
        step=min(RECORDED_STEP * slower, longest),
    )


def _later(case: Case, slower: float) -> dict[str, float]:
    """What differs in validation: a load comes at another time."""
    return {"step_time": (3.0 + case.seed % 6) * slower} if "step_time" in case.values else {}


def group(case: Case) -> str:
    """Which of the four kinds of hidden things it has."""
    if not case.hidden:
        return "nothing"
    return "pair" if len(case.hidden) > 1 else "outside the table" if case.hidden[0] in OUTSIDE else "single"
