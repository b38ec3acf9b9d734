"""A gearmotor with both channels under the real firmware, driver and controller, in lockstep: recorded, or held."""

import sys
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path

import numpy as np

sys.path.sort(key=lambda folder: Path(folder).name == "benchmarks")  # last: its control.py is not the library
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))

from driver_rig import Rig
from plant import profiles

from motor_board.build import FirmwareConfig
from motor_board.emulation.shaft import EncoderConfig
from motor_control.configuration import config_of
from motor_control.controller import controller
from motor_control.parameters import ROWS
from motor_control.tuning.design import Tuning
from motor_driver.config import Config
from motor_identification.recording import Recording, check, recording_of
from motor_model.parameters import Parameters
from motor_model.sensing.encoder import Lines

GEAR = Fraction("34.014")
TRUTH = Parameters(
    {"kv": 0.9, "ka": 0.06, "ks": 0.7, "backlash_angle": 0.03, "load_fraction": 0.3},
    ("coulomb_friction", "backlash"),
    gear_ratio=float(GEAR),
)
TORQUE, CORRELATION = 0.1, 0.05  # [V] RMS, [s] of the random torque
CONFIG = Config(edges_per_revolution=44, single_channel=False, quadrature=4, gear=GEAR)
SETTLED, HELD = 2.0, 6.0  # [s]
MS = 1e-3


@dataclass(frozen=True)
class Case:
    """A motor, its sensor, and what else turns it."""

    truth: Parameters
    config: Config
    lines: Lines
    irregularity: float  # of the disc, share of a slot
    torque: float  # [V] RMS


HARD = Case(TRUTH, CONFIG, Lines(0.44, 0.21), 0.02, TORQUE)
PAGE_MOTOR = Case(
    Parameters(
        {"kv": 0.5, "ka": 0.03, "ks": 0.5, "breakaway_voltage": 0.7, "stribeck_speed": 0.3}
        | {"backlash_angle": 0.02, "load_fraction": 0.3},
        ("static_friction", "backlash"),
        max_voltage=6.0,
        gear_ratio=float(GEAR),
    ),
    replace(CONFIG, max_voltage=6.0),
    Lines(),
    0.0,
    0.0,
)  # of docs/gearmotor.md


@dataclass
class Bench:
    """Board, driver and a random torque on the shaft, a millisecond at a time."""

    seed: int
    case: Case = HARD

    def __post_init__(self) -> None:
        encoder = EncoderConfig(11, self.case.irregularity, self.seed, lines=self.case.lines, gear=GEAR)
        firmware = FirmwareConfig("tb6612", edges_per_revolution=11, channels=2)
        self.rig = Rig(
            config=self.case.config, parameters=self.case.truth, firmware=firmware, encoder=encoder, step=16_000
        )
        self.random, self.torque = np.random.default_rng(self.seed), 0.0
        self.rig.plug()
        self.rig.voltage = 0.0
        self.run(100)

    def run(self, milliseconds: int) -> None:
        """Let time pass under an Ornstein–Uhlenbeck torque."""
        fade = np.exp(-MS / CORRELATION)
        for _ in range(milliseconds):
            self.torque = fade * self.torque + self.case.torque * np.sqrt(1.0 - fade**2) * self.random.standard_normal()
            self.rig.emulator.shaft.hold(False, self.torque)
            self.rig.run(1)


def record(seed: int) -> Recording:
    """Record half a minute of everything."""
    return drive(Bench(seed), profiles.rich(10.0, seed)[1], f"geared {seed}")


def drive(bench: Bench, voltages: np.ndarray, name: str) -> Recording:
    """Drive a motor through voltages, one a sample, and read what the driver says."""
    bench.rig.readings.clear()
    for volt in voltages:
        bench.rig.voltage = float(volt)
        bench.run(5)
    samples = [reading.sample for reading in bench.rig.readings]
    info = bench.rig.driver.info
    bench.rig.close()
    return check(recording_of(samples, info, name))


def hold(model: Parameters, tuning: Tuning, irregularity: float, reference: float) -> np.ndarray:
    """True speeds [rad/s] at every sample after settling, with observer and feed-forward of a model."""
    bench = Bench(7)
    values = {row.name: row.default for row in ROWS} | {"kp": tuning.gains.kp, "ki": tuning.gains.ki}
    values |= {"speed_source": "observer", "feedforward": True, "slot_irregularity": irregularity}
    config = config_of(values, bench.rig.driver.info, model)  # type: ignore[arg-type]
    state, wanted, speeds = controller.State(), reference, []
    bench.rig.readings.clear()
    for step in range(round((SETTLED + HELD) / (5 * MS))):
        bench.run(5)
        for reading in bench.rig.readings:
            now = reading.sample.sample_time * 1e-9
            output, state = controller.update(config, state, reading.sample, wanted, now)
            wanted, bench.rig.voltage = None, output.terms.voltage  # type: ignore[assignment]
        bench.rig.readings.clear()
        if step * 5 * MS >= SETTLED:
            speeds.append(bench.rig.emulator.shaft.speed)
    stops = bench.rig.stops
    bench.rig.close()
    if stops:
        raise SystemExit(f"the loop was stopped: {stops}")
    return np.array(speeds)
