"""The gap of `interfaces.md`, taken from its definition alone: what a simulated motion leaves of a recording's edges.

Each pair of successive edges that samples report (the latest one and, by its period, the one before) gives a measured
mean speed. Left out: pairs between which the simulated motion turns round, and those that are off by whole slots within
4 σ (missed edges). Where no edge comes for long, the simulation may move by one slot and scores what it moves beyond.
Blocks of half a second, every other one, belong to what is estimated on the recording and do not count.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motor_identification.recording import Recording

from .motor import Motion

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
LONG = 0.1  # [s] without an edge: standing
BLOCK = 0.5  # [s]
LEAST = 12  # blocks of a short recording


@dataclass(frozen=True)
class Score:
    """Simulated minus measured mean speed, interval by interval; arrays of shape (I,)."""

    start: Floats  # [s] since the first sample
    end: Floats  # [s]
    slots: Floats  # that were counted; 0 where no edge came
    residual: Floats  # [rad/s]
    counts: Bools  # whether it counts in the gap
    slot: float  # [rad]
    tick: float  # [s]

    def over(self, squares: Floats, where: Bools | None = None) -> float:
        """Root of the time-weighted mean of squares, of what counts (and is `where`)."""
        here = self.counts if where is None else self.counts & where
        return float(np.sqrt(np.average(squares[here], weights=(self.end - self.start)[here])))

    def gap(self, where: Bools | None = None) -> float:
        """[rad/s]"""
        return self.over(self.residual**2, where)

    def floor(self, share: float, where: Bools | None = None) -> float:
        """[rad/s] what the timer and flanks off by `share` of a slot leave in the same intervals, all independent."""
        span = self.end - self.start
        flank = np.where(self.slots > 0.0, share * self.slot, 0.0)
        stamp = self.slots * self.slot / span * self.tick / np.sqrt(12.0)
        return self.over(2.0 * (flank**2 + stamp**2) / span**2, where)


def score(recording: Recording, motion: Motion) -> Score:
    """Score a simulated motion that starts with the recording."""
    slot, tick = 2.0 * np.pi / recording.info.edges_per_revolution, recording.info.edge_resolution
    time, count = reported_edges(recording)
    last = recording.time[-1]
    bounds = np.concatenate([[0.0], time, [last]])
    start, end = bounds[:-1], bounds[1:]
    slots = np.concatenate([[0.0], np.abs(np.diff(count)), [0.0]])[: len(start)]
    angle = angle_at(motion, bounds)
    travel = np.diff(angle)
    turned = _turns(motion, start, end)
    still = ((slots == 0.0) | (turned & (slots <= 1.0))) & (end - start > LONG)
    excess = np.where(still, np.maximum(np.abs(travel) - slot, 0.0), np.abs(travel) - slots * slot)
    between = ~still & ~turned & (slots > 0.0)
    block = np.floor(start / min(BLOCK, last / LEAST))
    counts = (between & ~_miscounted(excess, between, slot)) | still
    slots = np.where(still, 0.0, slots)
    return Score(start, end, slots, excess / (end - start), counts & (block % 2 == 1), slot, tick)


def reported_edges(recording: Recording) -> tuple[Floats, Floats]:
    """Time [s] since the first sample, half a tick after the stamp, and number of every edge that a sample reports."""
    count = recording.edge_count.astype(np.float64)
    fresh = np.flatnonzero(np.diff(count, prepend=count[0]))
    latest = (recording.edge_time[fresh] - recording.sample_time[0]) * 1e-9 + 0.5 * recording.info.edge_resolution
    period = recording.edge_period[fresh]
    second = np.abs(np.diff(count[fresh], prepend=count[0])) >= 2
    second &= period > 0.0
    time = np.concatenate([latest, (latest - period)[second]])
    number = np.concatenate([count[fresh], count[fresh][second] - 1.0])
    order = np.argsort(time, kind="stable")
    return time[order], number[order]


def angle_at(motion: Motion, time: Floats) -> Floats:
    """[rad] of a motion at any times [s], by the cubic through its nodes' angles and speeds."""
    after = np.clip(np.searchsorted(motion.time, time, side="right"), 1, len(motion.time) - 1)
    before = after - 1
    step = motion.time[after] - motion.time[before]
    x = np.divide(time - motion.time[before], step, out=np.zeros_like(time), where=step > 0.0)
    rise = motion.angle[after] - motion.angle[before]
    m0, m1 = motion.speed[before] * step, motion.speed[after] * step
    return np.asarray(motion.angle[before] + x * (m0 + x * (3.0 * rise - 2.0 * m0 - m1 + x * (m0 + m1 - 2.0 * rise))))


def _turns(motion: Motion, start: Floats, end: Floats) -> Bools:
    """In which of the times the motion goes both ways, or other than it did last where it does not move at all."""
    forward = np.concatenate([[0.0], np.cumsum(np.maximum(np.diff(motion.angle), 0.0))])
    backward = np.concatenate([[0.0], np.cumsum(np.maximum(-np.diff(motion.angle), 0.0))])
    ahead, back = (
        np.interp(end, motion.time, part) - np.interp(start, motion.time, part) for part in (forward, backward)
    )
    return np.asarray(np.minimum(ahead, back) > 1e-9)


def _miscounted(excess: Floats, between: Bools, slot: float) -> Bools:
    """Which travels [rad] are off by whole slots within 4 σ of all the others' scatter."""
    middle = np.median(excess[between])
    reach = 4.0 * 1.4826 * float(np.median(np.abs(excess[between] - middle)))
    near = np.abs(excess - np.round(excess / slot) * slot) < max(reach, 1e-3 * slot)
    return np.asarray((np.round(excess / slot) != 0.0) & near & (reach < 0.5 * slot))
