"""The paper's identification: a step of 10 V, a swarm on the sampled speed; beside it ours, on the edges' times."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from paper_loop import FREE, HARDWARE, Bench

from motor_identification.estimation.search.swarm import SwarmConfig, minimise
from motor_identification.experiment import make_plan, simulate_plan
from motor_identification.identify import Request, SearchConfig, identify
from motor_identification.recording import Recording, check, recording_of
from motor_model.excitation import profile
from motor_model.parameters import Parameters
from motor_model.sensing.board import BoardConfig, SimulatedBoard
from motor_model.simulate import simulate

Floats = NDArray[np.float64]
STEP, RECORDED, BEFORE = 10.0, 1.0, 0.05  # [V], [s], [s] at rest before it
RATE = 1000.0  # [Hz]
SWARM = SwarmConfig(particles=30, epochs=200, seed=1, neighbours=15, stall=0)  # 15 on each side: one global best
LOW, HIGH = (0.01, 1e-4), (1.0, 0.1)  # of kv [V·s/rad] and ka [V·s²/rad]; the paper gives no bounds


@dataclass(frozen=True)
class Fit:
    """Two coefficients, and the RMS of simulated less sampled speed."""

    what: str
    kv: float
    ka: float
    residual: float  # [rad/s]

    @property
    def model(self) -> Parameters:
        """The first-order motor of the fit."""
        return Parameters({"kv": self.kv, "ka": self.ka}, name=self.what)


def record(bench: Bench, seed: int) -> Recording:
    """0.05 s of rest, then 10 V for a second, at 1 kHz."""
    config = BoardConfig(sample_rate=RATE, slot_irregularity=bench.irregularity, seed=seed)
    board = SimulatedBoard(bench.motor, config)
    commands = [0.0] * round(BEFORE * RATE) + [STEP] * round(RECORDED * RATE)
    return check(recording_of([board.sample(u) for u in commands], config.info(bench.motor), f"step {seed}"))


def by_swarm(recording: Recording) -> Fit:
    """The paper's: 200 epochs of a global-best swarm, squared error of the sampled speed."""
    low, high = np.log(LOW), np.log(HIGH)

    def costs(places: Floats) -> Floats:
        return np.array([_rms(recording, *np.exp(place)) for place in places])

    found = minimise(costs, low, high, SWARM)
    kv, ka = np.exp(found.theta)
    return Fit("the paper's fit", float(kv), float(ka), found.cost)


def by_edges(recording: Recording) -> Fit:
    """Ours: the same two coefficients from the times of the edges."""
    fit = identify([recording], Request(search=SearchConfig(particles=20))).parameters
    kv, ka = fit.value("kv"), fit.value("ka")
    return Fit("ours", kv, ka, _rms(recording, kv, ka))


def _rms(recording: Recording, kv: float, ka: float) -> float:
    """[rad/s] of simulated less sampled speed."""
    motion = simulate(Parameters({"kv": kv, "ka": ka}), recording.time, recording.voltage, recording.time)
    return float(np.sqrt(np.mean((motion.speed - recording.speed) ** 2)))


def errors(bench: Bench, seeds: int) -> tuple[Floats, Floats]:
    """RMS relative errors of kv and ka over starting angles and discs: the paper's fit, ours; both of shape (2,)."""
    true = np.array([bench.motor.value("kv"), bench.motor.value("ka")])
    recordings = [record(bench, seed) for seed in range(seeds)]
    fits = [[(fit.kv, fit.ka) for fit in (by_swarm(r), by_edges(r))] for r in recordings]
    rms = np.sqrt(np.mean((np.array(fits) / true - 1.0) ** 2, axis=0))
    return rms[0], rms[1]


def with_friction(irregularity: float) -> dict[str, float]:
    """Relative errors of every parameter, with friction in the model and an experiment that shows it (`rich`, 28 s)."""
    config = BoardConfig(slot_irregularity=irregularity)
    plan = make_plan(profile("rich"), 10.0, HARDWARE.max_voltage, 1.0 / config.sample_rate)
    samples = [sample for _, sample in simulate_plan(plan, HARDWARE, config)]
    recording = check(recording_of(samples, config.info(HARDWARE), "rich"))
    fit = identify([recording], Request(("static_friction",), SearchConfig(particles=20))).parameters
    return {name: fit.value(name) / value - 1.0 for name, value in HARDWARE.values.items()}


DISCS = {  # what the fits are compared on
    "no friction, perfect disc": Bench(FREE, irregularity=0.0),
    "no friction, 1 % disc": Bench(FREE),
    "hidden friction, 1 % disc": Bench(HARDWARE),
}
