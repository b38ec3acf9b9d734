"""A motor with a single-channel encoder in small fixed steps, written apart from `motor_model` to judge control by.

ka dω/dt = u - kv ω - ks sign ω, sticking at rest while |u| <= ks. Forward motion counts an edge where the angle passes
the start of a slot, backward motion where it passes the other flank, half a slot away. The report follows `MotorSpeed`
in the interface: a voltage is latched at the sample after the one it answers.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise
from math import floor, pi

from motor_model.sample import Sample

SLOT = 2.0 * pi / 96
STEP_NS = 20_000
STEP = STEP_NS * 1e-9  # [s]
TICK = 4000  # [ns]
STANDSTILL = 0.1  # [s] without an edge


@dataclass
class Plant:
    """The motor, its disc and the board that reads it; `direction` of the report is a guess, `speed` the truth."""

    kv: float = 12.0 / 174.097  # [V s/rad]
    ka: float = 0.0055  # [V s²/rad]
    ks: float = 0.4  # [V]
    load: float = 0.0  # [V] pushes forward
    irregularity: float = 0.01  # share of a slot
    single_channel: bool = True
    sign_of_voltage: bool = False  # a careless board: the direction is the voltage's
    clearly: float = 0.8  # a period that falls to this share of its maximum under opposing voltage: it has turned round
    sample_period: float = 0.005  # [s]
    seed: int = 0
    angle: float = 0.3 * SLOT  # [rad]
    speed: float = 0.0  # [rad/s] true
    voltage: float = 0.0  # [V] latched
    steps: int = 0
    count: int = 0
    edge_time: int = 0  # [ns]
    period: float = 0.0  # [s]
    direction: int = 0
    longest: float = 0.0  # [s] period since the voltage opposes the motion
    flanks: list[float] = field(default_factory=list)

    def __post_init__(self) -> None:
        dice = random.Random(self.seed)
        self.flanks = [SLOT * self.irregularity * dice.uniform(-0.5, 0.5) for _ in range(192)]

    def run(self, duration: float) -> None:
        """Advance by `duration` [s] with the latched voltage."""
        for _ in range(round(duration / STEP)):
            self._step()

    def report(self) -> Sample:
        """What the board says now."""
        now = self._now()
        age = (now - self.edge_time) * 1e-9
        moving = self.period > 0.0 and age < STANDSTILL
        magnitude = SLOT / max(self.period, age) if moving else 0.0
        return Sample(now, self.direction * magnitude, self.voltage, self.count, self.edge_time, self.period)

    def _now(self) -> int:
        return self.steps * STEP_NS

    def _step(self) -> None:
        before, angle = self.speed, self.angle
        push = self.voltage + self.load - self.kv * before
        if before == 0.0:
            speed = (push - self.ks * (1 if push > 0 else -1)) / self.ka * STEP if abs(push) > self.ks else 0.0
        else:
            speed = before + (push - self.ks * (1 if before > 0 else -1)) / self.ka * STEP
            if speed * before < 0.0 and abs(push) <= self.ks:
                speed = 0.0
        self.speed = speed
        self.angle = angle + 0.5 * (before + speed) * STEP
        self.steps += 1
        self._edges(angle, self.angle)

    def _edges(self, start: float, stop: float) -> None:
        """Count the flank that was passed on the way, with its time between the two."""
        forward = stop > start
        shift = 0.0 if forward else 0.5
        near = floor(0.5 * (start + stop) / SLOT - shift + 0.5)
        flank = (near + shift) * SLOT + self.flanks[2 * (near % 96) + (0 if forward else 1)]
        if (start < flank <= stop) if forward else (stop <= flank < start):
            moment = self._now() - round((stop - flank) / (stop - start) * STEP * 1e9)
            self._edge(max(moment // TICK * TICK, self.edge_time + TICK), 1 if forward else -1)

    def _edge(self, moment: int, truth: int) -> None:
        period = (moment - self.edge_time) * 1e-9 if self.count or self.edge_time else 0.0
        self._guess_direction(period, truth)
        self.period, self.edge_time = period, moment
        self.count += truth if not self.single_channel else 1

    def _guess_direction(self, period: float, truth: int) -> None:
        """A second channel knows; a single one decides at a standstill, or where a period falls after its maximum."""
        pushed = (self.voltage > 0) - (self.voltage < 0)
        if not self.single_channel:
            self.direction = truth
        elif self.sign_of_voltage:
            self.direction = pushed or self.direction
        elif self.direction == 0 or period == 0.0 or period >= STANDSTILL:
            self.direction, self.longest = pushed or self.direction or 1, 0.0
        elif pushed == self.direction:
            self.longest = 0.0
        elif pushed == -self.direction:
            self.longest = max(self.longest, self.period, period)
            if period < self.clearly * self.longest:
                self.direction, self.longest = -self.direction, 0.0


@dataclass(frozen=True)
class Trace:
    """What happened at each sample of a run."""

    time: list[float]  # [s]
    true_speed: list[float]  # [rad/s]
    samples: list[Sample]
    voltages: list[float]  # [V] what the controller answered

    def since(self, start: float) -> Trace:
        """The part from `start` [s] on."""
        first = next(k for k, time in enumerate(self.time) if time >= start)
        return Trace(self.time[first:], self.true_speed[first:], self.samples[first:], self.voltages[first:])

    def voltage_flips(self) -> int:
        """How often the voltage changes its sign."""
        signs = [voltage > 0 for voltage in self.voltages if voltage != 0.0]
        return sum(a != b for a, b in pairwise(signs))

    def wrong_signs(self, above: float = 0.0) -> list[float]:
        """The times [s] at which the reported direction contradicts the true one, faster than `above` [rad/s]."""
        pairs = zip(self.time, self.true_speed, self.samples, strict=True)
        return [time for time, speed, sample in pairs if abs(speed) > above and sample.speed * speed < 0.0]


def close_loop(plant: Plant, answer: Callable[[Sample, float], float], duration: float) -> Trace:
    """Let `answer(sample, time)` command the plant for `duration` [s]; a command is latched at the next sample."""
    trace = Trace([], [], [], [])
    begin = plant.steps
    command = plant.voltage
    while (time := (plant.steps - begin) * STEP) < duration - 1e-9:
        plant.voltage = command
        sample = plant.report()
        command = answer(sample, time)
        for values, value in zip(
            (trace.time, trace.true_speed, trace.samples, trace.voltages),
            (time, plant.speed, sample, command),
            strict=True,
        ):
            values.append(value)
        plant.run(plant.sample_period)
    return trace
