"""The paper's PI around a motor: what it left open, as assumptions, and what a run shows, as numbers."""

from collections.abc import Callable
from dataclasses import astuple, dataclass, replace

import numpy as np
from numpy.typing import NDArray

from motor_control.controller import controller, pi
from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sample import Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard

Floats = NDArray[np.float64]
PAIRS = ((10.0, 1.0), (10.0, 10.0), (100.0, 1.0), (100.0, 10.0))
MAX_VOLTAGE, TOP_SPEED = 12.0, 174.097  # [V], [rad/s] the paper's largest speed
COUNT = MAX_VOLTAGE / 255  # [V] of 8-bit PWM
UNITS = {  # [V] that one unit of output stands for; errors are in rad/s, but for the last
    "8-bit duty counts": COUNT,
    "volts": 1.0,
    "per cent of duty": MAX_VOLTAGE / 100,
    "normalised (duty per share of 174.097 rad/s)": MAX_VOLTAGE / TOP_SPEED,
}
RATES = (1000.0, 200.0, 100.0)  # [Hz]
REFERENCES = (20.0, 50.0, 100.0, 150.0)  # [rad/s]
DURATION, LAST = 1.0, 0.5  # [s] of a run, and of what is judged

FREE = Parameters({"kv": PAPER_KV, "ka": PAPER_KA}, name="the paper's motor")
FRICTION = {"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 4.0}
SLIDING = Parameters({**FREE.values, "ks": FRICTION["ks"]}, ("coulomb_friction",), name="sliding friction")
HARDWARE = Parameters({**FREE.values, **FRICTION}, ("static_friction",), name="hardware")


@dataclass(frozen=True)
class Assumption:
    """What the paper does not say; under the defaults most of its statements hold."""

    unit: str = "8-bit duty counts"
    rate: float = 1000.0  # [Hz]
    reference: float = 100.0  # [rad/s]
    per_sample: bool = False  # the integral sums errors without their time step
    anti_windup: bool = True
    brakes: bool = False  # the output may be negative

    def gains(self, pair: tuple[float, float]) -> pi.Config:
        """The pair in V/(rad/s) and V/rad."""
        unit = UNITS[self.unit]
        limit = MAX_VOLTAGE if self.anti_windup else 1e9
        return pi.Config(pair[0] * unit, pair[1] * unit * (self.rate if self.per_sample else 1.0), limit)


@dataclass(frozen=True)
class Bench:
    """What the loop runs on; `ideal` tells the law the true speed."""

    motor: Parameters
    irregularity: float = 0.01  # share of a slot
    ideal: bool = False
    duty_steps: bool = True  # the voltage comes in 255 steps

    def config(self, assumption: Assumption, seed: int) -> BoardConfig:
        """The board: 96 edges, one channel, a 4 µs timer."""
        return BoardConfig(sample_rate=assumption.rate, slot_irregularity=self.irregularity, seed=seed)


def simulation(model: Parameters) -> Bench:
    """As the paper simulates: a first-order motor, its speed known exactly, any voltage."""
    return Bench(model, irregularity=0.0, ideal=True, duty_steps=False)


@dataclass(frozen=True)
class Run:
    """What happened at each sample; arrays of shape (K,)."""

    time: Floats  # [s]
    speed: Floats  # [rad/s] true
    reported: Floats  # [rad/s] by the period method
    voltage: Floats  # [V] answered


@dataclass(frozen=True)
class Row:
    """A run in numbers, over its last half second but for the rise."""

    oscillation: float  # share, peak to peak over mean, of the true speed
    creep: float  # what of it is one slow drift: the integral has not settled
    reported: float  # oscillation of the reported speed
    rise: float  # [s] from 10 % to 90 % of where it ends
    mean: float  # [rad/s]
    overshoot: float  # share of the reference


def duty(voltage: float) -> float:
    """The nearest voltage [V] that 8-bit PWM has."""
    return round(voltage / COUNT) * COUNT


def law(pair: tuple[float, float], assumption: Assumption) -> Callable[[Sample, float], float]:
    """The paper's PI: from a sample and its time [s] to a voltage [V].

    It is a configuration of our controller, 0 to 12 V as an encoder without direction asks for; without anti-windup it
    is written out here.
    """
    gains, reference = assumption.gains(pair), assumption.reference
    config = controller.Config(gains, MAX_VOLTAGE, 0.1, 0.0, TOP_SPEED, single_channel=not assumption.brakes)
    state, integral = controller.State(), 0.0
    lowest = -MAX_VOLTAGE if assumption.brakes else 0.0

    def ours(sample: Sample, time: float) -> float:
        nonlocal state
        output, state = controller.update(config, state, sample, reference, time)
        return output.terms.voltage

    def plain(sample: Sample, _: float) -> float:
        nonlocal integral
        error = reference - sample.speed
        integral += gains.ki * error / assumption.rate
        return min(max(gains.kp * error + integral, lowest), MAX_VOLTAGE)

    return ours if assumption.anti_windup else plain


def run(pair: tuple[float, float], assumption: Assumption, bench: Bench, seed: int = 0) -> Run:
    """One second from rest with a gain pair; a voltage acts from the sample after the one it answers."""
    board, answer, voltage = SimulatedBoard(bench.motor, bench.config(assumption, seed)), law(pair, assumption), 0.0
    rows = np.empty((round(DURATION * assumption.rate), 4))
    for k in range(len(rows)):
        sample = board.sample(voltage)
        seen = replace(sample, speed=board.speed) if bench.ideal else sample
        voltage = answer(seen, k / assumption.rate)
        voltage = duty(voltage) if bench.duty_steps else voltage
        rows[k] = k / assumption.rate, board.speed, sample.speed, voltage
    return Run(rows[:, 0], rows[:, 1], rows[:, 2], rows[:, 3])


def judge(one: Run, reference: float, ideal: bool = False) -> Row:
    """The numbers of a run; where the speed is known exactly, the reported one is that."""
    last = one.time >= DURATION - LAST - 1e-9
    speed = one.speed[last]
    reported = speed if ideal else one.reported[last]
    mean = float(speed.mean())
    return Row(
        oscillation=_swing(speed),
        creep=abs(float(np.polyfit(one.time[last], speed, 1)[0])) * LAST / mean if mean > 0.0 else float("nan"),
        reported=_swing(reported),
        rise=_rise(one.time, one.speed, mean),
        mean=mean,
        overshoot=max(float(one.speed.max()) / reference - 1.0, 0.0),
    )


def _swing(speed: Floats) -> float:
    mean = float(speed.mean())
    return float(np.ptp(speed)) / mean if mean > 0.0 else float("nan")


def _rise(time: Floats, speed: Floats, final: float) -> float:
    if final <= 0.0:
        return float("nan")
    low, high = (int(np.argmax(speed >= share * final)) for share in (0.1, 0.9))
    return float(time[high] - time[low])


def median_row(pair: tuple[float, float], assumption: Assumption, bench: Bench, seeds: int) -> Row:
    """The median of each number over several discs and starting angles; one run where nothing is random."""
    discs = 1 if bench.ideal and bench.irregularity == 0.0 else seeds
    rows = [judge(run(pair, assumption, bench, seed), assumption.reference, bench.ideal) for seed in range(discs)]
    return Row(*(float(value) for value in np.median([astuple(r) for r in rows], axis=0)))
