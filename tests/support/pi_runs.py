"""The paper's own case: its motor with hidden static friction under its low-gain PI law, and the same loop simulated.

The law is `motor_control.controller.pi` with the paper's gains [10, 1] read as 8-bit duty counts per rad/s, one way
only. What is hidden is the tests' independent plant, which also stands in for the model in the simulated loop, with the
parameters that were found: the library's own simulation has no say in what is compared here.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from plant import Truth, profiles, record
from plant.encoder import Disc
from plant.loop import START, Law, answered, close_loop
from plant.motor import move
from plant.score import BLOCK, Score, angle_at, reported_edges, score

from motor_control.controller import pi
from motor_identification.recording import Floats, Recording, check
from motor_model.parameters import PAPER_KA, PAPER_KV
from motor_model.sample import Sample

BASE = {"kv": PAPER_KV, "ka": PAPER_KA}
HIDDEN = BASE | {"ks": 0.4, "breakaway_voltage": 0.9, "stribeck_speed": 4.0}
EFFECTS = ["coulomb_friction", "static_friction"]
COUNT = 12.0 / 255.0  # [V]
KP, KI = 10.0 * COUNT, 1.0 * COUNT  # [V/(rad/s)], [V/rad]
EDGES, IRREGULAR = 96, 0.01
SLOT = 2.0 * np.pi / EDGES


@dataclass(frozen=True)
class Reference:
    """Speeds [rad/s] that are wanted one after the other, each for `hold` [s], after a rest."""

    levels: Sequence[float]
    hold: float = 1.0
    rest: float = 0.3  # [s]

    @property
    def duration(self) -> float:
        return self.rest + self.hold * len(self.levels)

    def at(self, time: float) -> float:
        if time < self.rest:
            return 0.0
        return self.levels[min(int((time - self.rest) / self.hold + 1e-9), len(self.levels) - 1)]


# Slow enough to stick and hunt, where static friction matters most: what is diagnosed, and judged.
HUNTING = Reference((1.5, 6.0, 3.0, 10.0, 2.0, 20.0, 4.0, 40.0, 3.0, 8.0), 1.5)
JUDGE = Reference((3.0, 12.0, 2.0, 5.0, 30.0, 4.0, 1.5, 9.0), 1.5)
STARTS = Reference((10.0, 0.0, 20.0, 0.0, 40.0, 0.0, 15.0, 0.0))  # from rest and back: another reference


def law(reference: Reference) -> Law:
    """A fresh PI law that follows the reference; its answers are whole duty counts."""
    config, state, before = pi.Config(KP, KI, 12.0), pi.State(), START

    def answer(sample: Sample) -> float:
        nonlocal state, before
        error = reference.at((sample.sample_time - START) * 1e-9) - sample.speed
        terms, state = pi.update(config, state, error, 0.0, (sample.sample_time - before) * 1e-9, 0.0, 12.0)
        before = sample.sample_time
        return round(terms.voltage / COUNT) * COUNT

    return answer


@dataclass(frozen=True)
class Run:
    """A closed-loop run of the hidden motor."""

    reference: Reference
    recording: Recording
    truth: Truth

    @property
    def floor(self) -> float:
        """[rad/s] what timer and slots of this irregularity leave."""
        return score(self.recording, self.truth.motion).floor(IRREGULAR)

    def scored(self, values: dict[str, float], voltage: Floats) -> Score:
        """A motor of these values under other voltages than the recorded ones, against what was recorded."""
        return score(self.recording, move(values, self.recording.time, voltage))


@cache
def hidden_run(reference: Reference, seed: int, rate: float, begin: int = 0, irregularity: float = IRREGULAR) -> Run:
    """The hidden motor under the law; the disc belongs to the seed, where it stands also to `begin`."""
    angle = float(np.random.default_rng([seed, begin]).uniform(0.0, 2.0 * np.pi))
    recording, truth = close_loop(
        HIDDEN, law(reference), reference.duration, sample_rate=rate, irregularity=irregularity, disc_seed=seed,
        start_angle=angle, name=f"pi_{begin}.bag",
    )  # fmt: skip
    return Run(reference, check(recording), truth)


def ramps(seed: int, rate: float = 200.0) -> Recording:
    """Slow ramps from rest to full voltage and back, both ways, on the same hidden motor."""
    how = {"irregularity": IRREGULAR, "disc_seed": seed, "sample_rate": rate, "name": "ramps.bag"}
    return check(record(HIDDEN, *profiles.ramps(12.0, 1.5), seed=seed + 5, **how)[0])  # type: ignore[arg-type]


def offsets(recording: Recording, values: dict[str, float]) -> tuple[Floats, Floats, Floats]:
    """Times [s] and numbers of the reported edges, and how far [rad] each is from its place on a regular disc.

    By the motor's angle under the recorded voltages, for a motor that turns forward only.
    """
    time, number = reported_edges(recording)
    return time, number, angle_at(move(values, recording.time, recording.voltage), time) - number * SLOT


def disc_seen(recording: Recording, values: dict[str, float]) -> Floats:
    """[rad] how far every hole is from its place, by the median over the turns; shape (96,), NaN: never passed."""
    _, number, off = offsets(recording, values)
    holes = number.astype(np.int64) % EDGES
    return np.array([np.median(off[holes == hole]) if np.any(holes == hole) else np.nan for hole in range(EDGES)])


def standing(recording: Recording, values: dict[str, float], table: Floats | None) -> tuple[Disc, float]:
    """The disc and its angle [rad] at the start of a recording, by the blocks of it that do not count in the gap.

    Without a table of the holes the disc is regular and only its angle within a slot is estimated.
    """
    time, number, off = offsets(recording, values)
    own = np.floor(time / BLOCK) % 2.0 == 0.0
    holes = number[own].astype(np.int64)
    known = np.zeros(EDGES) if table is None else np.where(np.isnan(table), np.nanmedian(table), table)
    misfits = [off[own] - known[(holes + turn) % EDGES] for turn in range(1 if table is None else EDGES)]
    turn = int(np.argmin([np.var(misfit) for misfit in misfits]))
    place = known[(np.arange(EDGES) + turn) % EDGES] + np.median(misfits[turn])
    start = -float(np.mean(place))
    return Disc((place + start) / SLOT, np.full(EDGES, 0.5)), start


def loop_simulated(run: Run, values: dict[str, float], disc: Disc, start: float) -> Floats:
    """[V] of the same law on a motor of these values, which never sees what was recorded."""
    rate = 1.0 / run.recording.info.sample_period
    return answered(values, law(run.reference), run.reference.duration, disc, start, rate)


def as_before(run: Run) -> tuple[Disc, float]:
    """The true disc where it truly stood."""
    return run.truth.disc, run.truth.start_angle
