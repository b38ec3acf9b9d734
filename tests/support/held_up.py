"""A loop whose controller is not scheduled all the time, as beside busy programs: pauses, and what each one does."""

from __future__ import annotations

from collections.abc import Sequence
from copy import deepcopy
from dataclasses import dataclass
from functools import cache

import numpy as np
from bench_board import DEFAULTS, Floats, motor, settings

from motor_control.controller import controller
from motor_control.controller.controller import Config
from motor_model.parameters import Parameters
from motor_model.sample import Sample
from motor_model.sensing.board import BoardConfig, SimulatedBoard

HOLD = 0.1  # [s] `command_timeout`: a plant holds a voltage for so long
REFERENCE = 50.0  # [rad/s]
STEADY = 1.5  # [s] after which the motor turns at it


@dataclass(frozen=True)
class Pause:
    """A time in which the controller does nothing."""

    begin: float  # [s]
    end: float  # [s]
    old: float | None = None  # share of the pause after which the sample came that is answered first; None: the newest
    unpublished: bool = False  # it begins between an answer and its publication


@dataclass(frozen=True)
class Load:
    """How a process is held up; the times [s] are quantiles at `QUANTILES`."""

    pauses: tuple[float, ...]
    runs: tuple[float, ...]
    old: float  # share of the pauses after which the first sample answered is one from within
    unpublished: float  # share of the pauses that begin between an answer and its publication


QUANTILES = (0.0, 0.25, 0.5, 0.75, 0.9, 0.99, 1.0)
# Recorded beside seven endless loops on the controller's core, one of two that others shared, in 8 and 12 s.
BUSY_1_KHZ = Load(
    (0.01, 0.014, 0.019, 0.035, 0.065, 0.163, 0.245), (0.0, 0.0, 0.001, 0.007, 0.015, 0.05, 0.07), 0.3, 0.16
)
BUSY_200_HZ = Load(
    (0.013, 0.014, 0.015, 0.016, 0.018, 0.048, 0.075), (0.0, 0.012, 0.025, 0.056, 0.093, 0.2, 0.243), 0.01, 0.01
)


def draw_pauses(load: Load, seconds: float, seed: int) -> list[Pause]:
    """Draw what a load does to a controller in so many seconds."""
    rng, time, found = np.random.default_rng(seed), 0.0, []
    while time < seconds:
        end = time + float(np.interp(rng.random(), QUANTILES, load.pauses))
        old = float(rng.random()) if rng.random() < load.old else None
        found.append(Pause(time, end, old, bool(rng.random() < load.unpublished)))
        time = end + float(np.interp(rng.random(), QUANTILES, load.runs))
    return found


@dataclass
class Loop:
    """A plant and its controller, at a time."""

    rate: float  # [Hz]
    board: SimulatedBoard
    config: Config
    state: controller.State = controller.State()
    command: float = 0.0  # [V] the latest that the plant has heard
    heard: float = 0.0  # [s] when
    steps: int = 0
    reason: str = ""

    def answer(self, sample: Sample, time: float, reference: float | None = None) -> float:
        """Answer a sample with a voltage [V]."""
        output, self.state = controller.update(self.config, self.state, sample, reference, time)
        self.reason = output.reason
        return output.terms.voltage

    def step(self, pause: Pause | None, pending: list[float], old: list[Sample], reference: float | None) -> Sample:
        """Go on by a sample; pending: an answer that waits for its publication; old: a sample that waits for one."""
        time = self.steps / self.rate
        self.steps += 1
        sample = self.board.sample(self.command if time - self.heard <= HOLD else 0.0)
        if pause is None:
            if pending:
                self.command, self.heard = pending.pop(), time
            self.command, self.heard = self.answer(old.pop() if old else sample, time, reference), time
        elif pause.unpublished and not pending and time - pause.begin < 1.0 / self.rate:
            pending.append(self.answer(sample, time, reference))
        elif pause.old is not None and not old and time >= pause.begin + pause.old * (pause.end - pause.begin):
            old.append(sample)
        return sample


@dataclass(frozen=True)
class Seen:
    """What happened at each sample; arrays of shape (K,)."""

    speeds: Floats  # [rad/s] true
    voltages: Floats  # [V] that the motor got
    reasons: list[str]  # of the latest answer

    def unexplained(self, rate: float, within: float = 0.05, after: float = 0.5) -> Floats:
        """The speeds against the reference [1] that are too fast, or too slow and no 0 V was `after` [s] before."""
        share = self.speeds / REFERENCE - 1.0
        zero = np.convolve(self.voltages == 0.0, np.ones(round(after * rate)))[: len(share)] > 0.0
        return share[(share > within) | ((share < -within) & ~zero)]


def run(loop: Loop, pauses: Sequence[Pause], seconds: float, reference: float | None = None) -> Seen:
    """Run a loop for so long, held up in the pauses, whose times count from now."""
    begin, coming, rows, reasons = loop.steps / loop.rate, list(pauses), [], []
    pending: list[float] = []
    old: list[Sample] = []
    for k in range(round(seconds * loop.rate)):
        time = loop.steps / loop.rate - begin
        while coming and coming[0].end <= time:
            coming.pop(0)
        pause = coming[0] if coming and coming[0].begin <= time else None
        sample = loop.step(pause, pending, old, reference if k == 0 else None)
        rows.append((loop.board.speed, sample.voltage))
        reasons.append(loop.reason)
    speeds, voltages = np.array(rows).T
    return Seen(speeds, voltages, reasons)


@cache
def _steady(rate: float, observed: bool, quick: float) -> Loop:
    plant = motor()
    plant = Parameters(plant.values | {"ka": plant.value("ka") / quick}, plant.effects)
    board = BoardConfig(sample_rate=rate, slot_irregularity=0.0)
    info = board.info(plant)
    gains = {"kp": DEFAULTS["kp"], "ki": DEFAULTS["ki"] * quick, "speed_source": "measured", "feedforward": False}
    config = settings(plant, info) if observed else settings(None, info, **gains)
    loop = Loop(rate, SimulatedBoard(plant, board), config)
    run(loop, [], STEADY, REFERENCE)
    return loop


def steady(rate: float, observed: bool = False, quick: float = 1.0) -> Loop:
    """A loop that has held its reference for a while; quick: times as quick a motor."""
    return deepcopy(_steady(rate, observed, quick))
