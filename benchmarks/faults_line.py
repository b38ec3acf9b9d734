"""What a broken encoder line makes of a board's samples: no edges, stray ones, a direction that is the wrong one."""

from dataclasses import dataclass, field, replace
from math import copysign, nan, tau

import numpy as np

from motor_model.sample import Sample

STANDSTILL = 0.1  # [s] without an edge


@dataclass
class CableOff:
    """From the first sample on no edge comes but stray ones, at random times."""

    stray: float = 0.0  # [1/s]
    seed: int = 5
    slot: float = tau / 96  # [rad]
    before: Sample | None = None
    next: float = 0.0  # [ns] the next stray edge
    random: np.random.Generator = field(init=False)

    def __post_init__(self) -> None:
        self.random = np.random.default_rng(self.seed)

    def __call__(self, sample: Sample) -> Sample:
        """What the board says instead."""
        if self.before is None:
            self.before, self.next = sample, sample.sample_time + self._wait()
        known = self.before
        while self.stray and self.next <= sample.sample_time:
            at = round(self.next)
            period = (at - known.edge_time) * 1e-9
            known = replace(known, edge_count=known.edge_count + 1, edge_time=at, edge_period=period)
            self.next += self._wait()
        self.before = known
        age = (sample.sample_time - known.edge_time) * 1e-9
        moving = known.edge_period > 0.0 and age < STANDSTILL
        speed = copysign(self.slot / max(known.edge_period, age), sample.voltage) if moving else 0.0
        return replace(known, sample_time=sample.sample_time, voltage=sample.voltage, speed=speed)

    def _wait(self) -> float:
        return float(self.random.exponential(1e9 / self.stray)) if self.stray else float("inf")


@dataclass
class Hum:
    """From the first sample on the line picks up the mains: edges at a rate, whose crossings tremble."""

    rate: float  # [1/s]
    slot: float = tau / 96  # [rad]
    tremble: float = 0.0  # share of a period, 1 σ
    before: Sample | None = None

    def __call__(self, sample: Sample) -> Sample:
        """What the board says instead."""
        if self.before is None:
            self.before = sample
        passed = int((sample.sample_time - self.before.sample_time) * 1e-9 * self.rate - 3.0 * self.tremble)
        at, latest = (self._time(k) for k in (passed, passed - 1))
        period = (at - latest) * 1e-9 if passed > 1 else 1.0 / self.rate
        return replace(
            sample,
            speed=copysign(self.slot / period, sample.voltage),
            edge_count=self.before.edge_count + passed,
            edge_time=at if passed else self.before.edge_time,
            edge_period=period,
        )

    def _time(self, passed: int) -> int:
        """[ns] of an edge, by its number."""
        assert self.before is not None
        off = self.tremble * np.random.default_rng(max(passed, 0)).standard_normal() if self.tremble else 0.0
        return self.before.sample_time + round((passed + min(max(off, -0.4), 0.4)) / self.rate * 1e9)


@dataclass
class LooseContact:
    """Edges reach the board for a part of every period of time only; the count leaves the others out."""

    period: float = 0.1  # [s]
    there: float = 0.02  # [s]
    slot: float = tau / 96  # [rad]
    begun: int = 0  # [ns]
    true: Sample | None = None  # the latest one
    told: Sample | None = None

    def __call__(self, sample: Sample) -> Sample:
        """What the board says instead."""
        if self.true is None or self.told is None:
            self.begun, self.true, self.told = sample.sample_time, sample, sample
        passed, self.true = sample.edge_count - self.true.edge_count, sample
        if (sample.sample_time - self.begun) * 1e-9 % self.period < self.there:
            self.told = replace(sample, edge_count=self.told.edge_count + passed)
            return self.told
        age = (sample.sample_time - self.told.edge_time) * 1e-9
        moving = self.told.edge_period > 0.0 and age < STANDSTILL
        speed = copysign(self.slot / max(self.told.edge_period, age), sample.voltage) if moving else 0.0
        self.told = replace(self.told, sample_time=sample.sample_time, voltage=sample.voltage, speed=speed)
        return self.told


@dataclass
class Stuck:
    """A driver that repeats its latest sample for ever, with times that go on."""

    latest: Sample | None = None

    def __call__(self, sample: Sample) -> Sample:
        """What the board says instead."""
        self.latest = self.latest or sample
        return replace(self.latest, sample_time=sample.sample_time)


@dataclass
class NowAndThen:
    """A plant that has gone wrong at every other sample."""

    odd: bool = False

    def __call__(self, sample: Sample) -> Sample:
        """What the board says instead."""
        self.odd = not self.odd
        return not_a_number(sample) if self.odd else sample


@dataclass
class Swapped:
    """Two channels, exchanged: everything runs the other way, from the count that there is."""

    count: int | None = None  # when they were exchanged

    def __call__(self, sample: Sample) -> Sample:
        """What the board says instead."""
        if self.count is None:
            self.count = sample.edge_count
        return replace(sample, speed=-sample.speed, edge_count=2 * self.count - sample.edge_count)


def not_a_number(sample: Sample) -> Sample:
    """A plant that has gone wrong."""
    return replace(sample, speed=nan)
