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


def swapped(sample: Sample) -> Sample:
    """Two channels, exchanged: everything runs the other way."""
    return replace(sample, speed=-sample.speed, edge_count=-sample.edge_count)


def not_a_number(sample: Sample) -> Sample:
    """A plant that has gone wrong."""
    return replace(sample, speed=nan)
